#pragma once

/// Points as fixed sparse combinations of other points: topology is paid for once, every move is
/// one sparse product.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

/// Sums up one row: several weights for one index become their sum.
class StencilRow {
 public:
  void add(std::int32_t index, double weight) {
    double& sum = weights_[static_cast<std::size_t>(index)];
    if (!is_touched_[static_cast<std::size_t>(index)]) {
      is_touched_[static_cast<std::size_t>(index)] = 1;
      touched_.push_back(index);
    }
    sum += weight;
  }

 private:
  friend class StencilTable;
  void reset(std::size_t n_controls);
  /// Appends what does not sum to exactly zero, indices ascending.
  void finish(std::vector<std::int32_t>& indices, std::vector<double>& weights);

  std::vector<double> weights_;
  std::vector<char> is_touched_;
  std::vector<std::int32_t> touched_;
};

/// A sparse matrix in compressed rows: row i holds the weights of point i. Immutable.
class StencilTable {
 public:
  /// The weights of one point; indices ascend.
  struct Row {
    std::span<const std::int32_t> indices;
    std::span<const double> weights;
  };

  StencilTable() = default;

  /// Builds `n_rows` rows over `n_controls` points. fill(i, row) adds the weights of row i; rows
  /// are filled in parallel. Weights that sum to exactly zero are left out. Throws Error if there
  /// are more than 2^32 - 1 weights.
  [[nodiscard]] static StencilTable build(
      std::size_t n_rows, std::size_t n_controls,
      const std::function<void(std::size_t, StencilRow&)>& fill);

  [[nodiscard]] std::size_t n_rows() const { return offsets_.size() - 1; }
  [[nodiscard]] std::size_t n_controls() const { return n_controls_; }
  [[nodiscard]] std::size_t n_weights() const { return weights_.size(); }
  [[nodiscard]] Row operator[](std::size_t row) const {
    const std::size_t begin = offsets_[row];
    const std::size_t length = offsets_[row + 1] - begin;
    return {{indices_.data() + begin, length}, {weights_.data() + begin, length}};
  }

  /// The points for control points: controls: #controls, result: #rows. O(#weights).
  [[nodiscard]] std::vector<glm::dvec3> apply(std::span<const glm::dvec3> controls) const;

  /// The same for some rows only: points[i] of every i in `rows` is written, with the bits that
  /// apply() without `rows` gives, and no other. controls: #controls; rows: each once; points:
  /// #rows of the table. Allocates nothing. O(#weights of these rows).
  void apply(std::span<const glm::dvec3> controls, std::span<const std::int32_t> rows,
             std::span<glm::dvec3> points) const;

  /// Rows and columns exchanged: row j holds the weights that control point j has. O(#weights).
  [[nodiscard]] StencilTable transpose() const;

  /// Heap memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  std::vector<std::uint32_t> offsets_ = {0};
  std::vector<std::int32_t> indices_;
  std::vector<double> weights_;
  std::size_t n_controls_ = 0;
};

/// Which rows some control points reach: what is to be computed anew when only these have moved.
class ReachedRows {
 public:
  /// Keeps the table's transpose, not the table. O(#weights).
  explicit ReachedRows(const StencilTable& table);

  /// The rows that have a weight for one of these control points, ascending, each once; valid until
  /// the next call. controls: in any order, may repeat. Allocates only where the result is longer
  /// than any before. O(#weights of these control points + #rows / 64).
  [[nodiscard]] std::span<const std::int32_t> of(std::span<const std::int32_t> controls);

 private:
  StencilTable transposed_;
  std::vector<std::uint64_t> is_reached_;  // a bit a row, all clear between calls
  std::vector<std::int32_t> rows_;
};

/// `second` after `first`: its rows over the control points of `first`.
[[nodiscard]] StencilTable compose(const StencilTable& first, const StencilTable& second);

}  // namespace espalier
