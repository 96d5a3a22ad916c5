#pragma once

/// The convex hull of few points.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/build/prism.h"

namespace espalier {

/// The faces of the convex hull of some of the points, whole polygons, counter-clockwise seen from
/// outside; points inside a face or an edge of the hull are left out. Empty if the points lie in a
/// plane. Lengths below 1e-9 of the points' extent count as zero. chosen: distinct.
/// O(n⁴) for n chosen points.
[[nodiscard]] std::vector<VertexLoop> convex_hull(std::span<const glm::dvec3> points,
                                                  std::span<const std::int32_t> chosen);

}  // namespace espalier
