#pragma once

/// An order in which neighbours in space are near each other.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

/// The indices of points, sorted along a Morton curve through 32 cells an axis of their box, in a
/// cell ascending: what is worked through in this order finds in the cache what its neighbours
/// needed. Points that are not finite stand somewhere. O(#points).
[[nodiscard]] std::vector<std::uint32_t> spatial_order(std::span<const glm::dvec3> points);

}  // namespace espalier
