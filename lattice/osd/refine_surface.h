#pragma once

/// Catmull-Clark surfaces, refined by OpenSubdiv.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier::osd {

/// A refined polygon mesh.
struct RefinedSurface {
  std::vector<glm::dvec3> points;
  CompressedRows<std::int32_t> faces;  ///< quadrilaterals from the first level on
};

/// Refines a polygon mesh `levels` times in double; boundary edges are sharp, corners too. Points
/// that no face uses are left out. points: model units; faces: loops of any size. Throws
/// ParameterError if a face repeats a vertex, an edge has faces that OpenSubdiv cannot order, or
/// the result would have more than 50 million faces.
[[nodiscard]] RefinedSurface refine_surface(std::span<const glm::dvec3> points,
                                            const CompressedRows<std::int32_t>& faces, int levels);

}  // namespace espalier::osd
