#pragma once

/// Places of grids so large that only what is in use is stored.

#include <array>
#include <compare>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace espalier {

/// A cell or a function of a grid, by its place along u, v, w; ordered with u fastest. Each from 0
/// to 2^21 − 1.
struct GridIndex {
  std::int32_t i = 0;
  std::int32_t j = 0;
  std::int32_t k = 0;

  [[nodiscard]] std::int32_t operator[](std::size_t axis) const {
    return axis == 0 ? i : axis == 1 ? j : k;
  }
  /// In order.
  [[nodiscard]] std::uint64_t key() const {
    return static_cast<std::uint64_t>(k) << 42 | static_cast<std::uint64_t>(j) << 21 |
           static_cast<std::uint64_t>(i);
  }
  [[nodiscard]] static GridIndex of_key(std::uint64_t key) {
    const auto part = [&](int shift) {
      return static_cast<std::int32_t>(key >> shift & ((1u << 21) - 1));
    };
    return {part(0), part(21), part(42)};
  }
  bool operator==(const GridIndex&) const = default;
  auto operator<=>(const GridIndex& other) const { return key() <=> other.key(); }
};

/// A value for each place of a grid, stored in bricks of 8 × 8 × 8 where any was set.
template <class T>
class BrickGrid {
  using Brick = std::array<T, 512>;

 public:
  explicit BrickGrid(T empty = T()) : empty_(empty) {}

  void set(const GridIndex& at, T value) {
    const auto [found, is_new] = numbers_.try_emplace(brick_of(at), bricks_.size());
    if (is_new) {
      bricks_.emplace_back().fill(empty_);
    }
    bricks_[found->second][within(at)] = value;
  }

  /// Looks values up, fastest where places follow each other. For one thread.
  class Reader {
   public:
    explicit Reader(const BrickGrid& grid) : grid_(&grid) {}
    [[nodiscard]] T operator()(const GridIndex& at) {
      const std::uint64_t brick = brick_of(at);
      Slot& slot = slots_[static_cast<std::size_t>((at.i >> 3 & 1) + (at.j >> 3 & 1) * 2 +
                                                   (at.k >> 3 & 1) * 4)];
      if (slot.brick != brick) {
        const auto found = grid_->numbers_.find(brick);
        slot = {brick, found == grid_->numbers_.end() ? nullptr : &grid_->bricks_[found->second]};
      }
      return slot.values == nullptr ? grid_->empty_ : (*slot.values)[within(at)];
    }

   private:
    struct Slot {
      std::uint64_t brick = ~std::uint64_t{0};
      const Brick* values = nullptr;
    };
    const BrickGrid* grid_;
    std::array<Slot, 8> slots_;
  };

 private:
  [[nodiscard]] static std::uint64_t brick_of(const GridIndex& at) {
    return GridIndex{at.i >> 3, at.j >> 3, at.k >> 3}.key();
  }
  [[nodiscard]] static std::size_t within(const GridIndex& at) {
    return static_cast<std::size_t>((at.i & 7) + 8 * ((at.j & 7) + 8 * (at.k & 7)));
  }

  T empty_;
  std::unordered_map<std::uint64_t, std::size_t> numbers_;
  std::vector<Brick> bricks_;
};

}  // namespace espalier
