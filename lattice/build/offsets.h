#pragma once

/// Offsets of a surface along its normals.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier {

/// How far each point moves when every face moves by `distance` along its normal: along the mean of
/// the normals at the point, weighted by the faces' angles there [TW98], so far that flat faces
/// keep their distance, but at most four times as far. Zero at points that no face uses.
/// points: model units; faces: loops of points, all counter-clockwise seen from the side the
/// normals point to. Throws LatticeError where the normals at a point cancel.
[[nodiscard]] std::vector<glm::dvec3> offsets_along_normals(
    std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces, double distance);

/// Twice the area vector of a loop of points.
[[nodiscard]] glm::dvec3 area_vector(std::span<const glm::dvec3> points,
                                     std::span<const std::int32_t> loop);

/// `vector` with length 1, or zero; squares of tiny or huge lengths do no harm.
[[nodiscard]] glm::dvec3 unit_vector(const glm::dvec3& vector);

}  // namespace espalier
