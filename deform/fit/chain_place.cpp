#include "deform/fit/chain_place.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace espalier {

ChainPlace nearest_place(const glm::dvec3& point, std::span<const glm::dvec3> joints,
                         bool is_closed) {
  ChainPlace best;
  const std::size_t n_bones = joints.size() - (is_closed ? 0 : 1);
  for (std::size_t i = 0; i < n_bones; ++i) {
    const glm::dvec3 bone = joints[(i + 1) % joints.size()] - joints[i];
    const double length = glm::length(bone);
    const double s = glm::dot(point - joints[i], bone / length) / length;
    const double t = std::clamp(s, 0.0, 1.0);
    const double distance = glm::distance(point, joints[i] + t * bone);
    if (distance < best.distance) {
      const double before = i == 0 && !is_closed ? -s * length : -1;
      const double after = i + 1 == n_bones && !is_closed ? (s - 1) * length : -1;
      best = {i, t, distance, std::max(before, after)};
    }
  }
  return best;
}

glm::dvec3 foot_of(const ChainPlace& place, std::span<const glm::dvec3> joints) {
  return joints[place.bone] * (1 - place.t) + joints[(place.bone + 1) % joints.size()] * place.t;
}

}  // namespace espalier
