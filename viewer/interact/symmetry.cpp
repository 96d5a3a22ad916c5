#include "viewer/interact/symmetry.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "lattice/core/box.h"

namespace espalier::viewer {
namespace {

constexpr double kSame = 1e-6;  // of the box's radius

}  // namespace

std::vector<std::int32_t> mirror_images(std::span<const glm::dvec3> rest, int axis) {
  const Box box = box_of(rest);
  const double reach = kSame * box.radius();
  const auto place = [&](std::int32_t i) { return rest[static_cast<std::size_t>(i)][axis]; };
  std::vector<std::int32_t> order(rest.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return place(a) < place(b); });
  std::vector<std::int32_t> images(rest.size(), -1);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    glm::dvec3 image = rest[i];
    image[axis] = 2 * box.center()[axis] - image[axis];
    auto candidate =
        std::lower_bound(order.begin(), order.end(), image[axis] - reach,
                         [&](std::int32_t other, double value) { return place(other) < value; });
    for (; candidate != order.end() && place(*candidate) <= image[axis] + reach; ++candidate) {
      if (glm::distance(rest[static_cast<std::size_t>(*candidate)], image) <= reach) {
        images[i] = *candidate;
        break;
      }
    }
  }
  return images;
}

void mirror_motion(std::span<const glm::dvec3> start, std::span<const std::int32_t> images,
                   int axis, std::vector<glm::dvec3>& to) {
  const std::vector<glm::dvec3> asked = to;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (asked[i] == start[i] || images[i] < 0) {
      continue;
    }
    const auto image = static_cast<std::size_t>(images[i]);
    glm::dvec3 way = asked[i] - start[i];
    if (image == i) {
      to[i][axis] = start[i][axis];
    } else if (asked[image] == start[image]) {
      way[axis] = -way[axis];
      to[image] = start[image] + way;
    }
  }
}

}  // namespace espalier::viewer
