#include "deform/model/same_place.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace espalier {

std::vector<std::int32_t> first_in_place(std::span<const glm::dvec3> points) {
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t i) {
    const glm::dvec3& p = points[static_cast<std::size_t>(i)];
    return std::array<double, 3>{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto ka = key(a);
    const auto kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::int32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] =
        is_same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

}  // namespace espalier
