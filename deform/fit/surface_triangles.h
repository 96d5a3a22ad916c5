#pragma once

/// A model's surface as triangles, and which boxes they meet.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {

/// The triangles of all faces, in their order, wound like them; then every point that no face uses,
/// as a triangle of three equal corners. points: model units; faces: loops of points, in range.
[[nodiscard]] std::vector<Triangle> surface_triangles(std::span<const glm::dvec3> points,
                                                      const CompressedRows<std::int32_t>& faces);

/// Whether a triangle has a point in common with a closed box. Triangles may be degenerate.
[[nodiscard]] bool overlaps(const Triangle& triangle, const glm::dvec3& low,
                            const glm::dvec3& high);

}  // namespace espalier
