#pragma once

/// A tree that finds the boxes that overlap.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice/core/box.h"

namespace espalier {

/// A static tree over boxes, split at the median of the longest axis. Built in O(n log n).
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  [[nodiscard]] const Box& box(std::size_t i) const { return boxes_[i]; }

  /// Calls visit(i) for every box i that overlaps `box`, in the tree's order.
  template <class Visit>
  void visit_overlapping(const Box& box, const Visit& visit) const {
    std::array<std::uint32_t, 64> stack;  // deeper than any median split of 2^32 boxes
    std::size_t depth = 0;
    for (std::uint32_t at = 0; at < nodes_.size();) {
      const Node& node = nodes_[at];
      if (node.box.overlaps(box)) {
        if (node.right != 0) {
          stack[depth++] = node.right;
          ++at;
          continue;
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
          if (boxes_[order_[i]].overlaps(box)) {
            visit(static_cast<std::size_t>(order_[i]));
          }
        }
      }
      if (depth == 0) {
        return;
      }
      at = stack[--depth];
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin;  // of its boxes in order_
    std::uint32_t end;
    std::uint32_t right = 0;  // second child; the first follows its parent; 0: a leaf
  };
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace espalier
