#pragma once

/// Polygons in space, nearly flat, and cuts of them.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

/// Whether the mean of the points sees every edge from inside.
[[nodiscard]] bool is_seen_from_middle(std::span<const glm::dvec3> loop);

/// Triangles that the polygon consists of, as indices of its points: ears cut off, the first of the
/// best shaped ones first. Where it crosses itself the triangles do, too. loop: three points or
/// more. O(n³) at worst.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> ear_triangles(
    std::span<const glm::dvec3> loop);

}  // namespace espalier
