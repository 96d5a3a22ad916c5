#include "lattice/core/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace espalier {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) {
    build(0, static_cast<std::uint32_t>(boxes_.size()));
  }
}

void BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kLeafSize = 4;
  const std::size_t at = nodes_.size();
  nodes_.push_back({Box{}, begin, end});
  for (std::uint32_t i = begin; i < end; ++i) {
    nodes_[at].box.add(boxes_[order_[i]]);
  }
  if (end - begin <= kLeafSize) {
    return;
  }
  const glm::dvec3 size = nodes_[at].box.max - nodes_[at].box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto place = [&](std::uint32_t i) { return boxes_[i].min[axis] + boxes_[i].max[axis]; };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return place(a) != place(b) ? place(a) < place(b) : a < b;
                   });
  build(begin, middle);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

}  // namespace espalier
