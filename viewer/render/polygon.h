#pragma once

/// Polygons in space, flat or nearly so.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier::viewer {

/// The sum of the cross products around the loop: the normal times twice the area, independent of
/// where the loop starts. Zero for fewer than three corners.
[[nodiscard]] glm::dvec3 area_vector(std::span<const glm::dvec3> loop);

/// Appends the triangles of a simple polygon, convex or concave, as corner numbers 0 … #loop - 1,
/// three a triangle, turning as the loop does. A loop of n corners always gives n - 2 triangles,
/// also one that crosses itself or has no area. O(n) if convex, else by ear clipping, O(n²) for
/// shapes met in practice.
void triangulate(std::span<const glm::dvec3> loop, std::vector<std::uint32_t>& triangles);

}  // namespace espalier::viewer
