#pragma once

/// Where a chain of bones is nearest to a point.

#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace espalier {

struct ChainPlace {
  std::size_t bone = 0;
  double t = 0;  ///< along the bone, from 0 to 1
  double distance = std::numeric_limits<double>::infinity();
  double beyond = 0;  ///< how far past the plane at an end of an open chain, if positive
};

/// joints: two or more, neighbours apart; of a closed chain a last bone leads back to the first.
[[nodiscard]] ChainPlace nearest_place(const glm::dvec3& point, std::span<const glm::dvec3> joints,
                                       bool is_closed = false);

/// That place on the chain.
[[nodiscard]] glm::dvec3 foot_of(const ChainPlace& place, std::span<const glm::dvec3> joints);

}  // namespace espalier
