#pragma once

/// Things that hang together, by their numbers.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace espalier {

/// Numbers in sets that can be joined. Nearly O(1) a call.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t n) { reset(n); }

  /// The numbers below n, each in a set of its own. Reuses the memory.
  void reset(std::size_t n) {
    parents_.resize(n);
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  /// The smallest number in the set of i.
  [[nodiscard]] std::size_t first(std::size_t i) {
    while (parents_[i] != i) {
      parents_[i] = parents_[parents_[i]];
      i = parents_[i];
    }
    return i;
  }

  /// False if they are in one set already.
  bool join(std::size_t a, std::size_t b) {
    a = first(a);
    b = first(b);
    parents_[std::max(a, b)] = static_cast<std::uint32_t>(std::min(a, b));
    return a != b;
  }

 private:
  std::vector<std::uint32_t> parents_;  // not above the number; the smallest of a set is its own
};

}  // namespace espalier
