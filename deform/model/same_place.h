#pragma once

/// Points that files list more than once.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

/// #points: the lowest index of a point in the same place. O(n log n).
[[nodiscard]] std::vector<std::int32_t> first_in_place(std::span<const glm::dvec3> points);

}  // namespace espalier
