#pragma once

/// A stencil table laid out for re-posing frame after frame.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/core/instruction_set.h"
#include "lattice/volume/stencil_kernels.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// The product of StencilTable::apply, several times as fast: rows with nearly the same indices
/// stand together in blocks that share one list of columns, filled up with zeros, and blocks with
/// the same weights, as the cells of a regular region have, share these. Those of a volume's
/// stencils() make what Volume::displacements() makes, frame after frame. Immutable.
/// Real: double, with the bits of StencilTable::apply on every machine, or float, within
/// (#weights of the row + 2) · 2⁻²⁴ of Σ |w| |p|, whose bits depend on the instruction set.
template <class Real>
class StencilBlocks {
 public:
  using Point = glm::vec<3, Real>;

  /// Keeps nothing of the table. O(#weights · log #rows).
  explicit StencilBlocks(const StencilTable& table, InstructionSet set = instruction_set());

  [[nodiscard]] std::size_t n_rows() const { return rows_.n_values(); }
  [[nodiscard]] std::size_t n_controls() const { return n_controls_; }
  /// Products of a weight and a point, those with zeros among them: what applying costs.
  [[nodiscard]] std::size_t n_products() const { return columns_.n_values() * kStencilRows; }

  /// The points for control points. controls: #controls, finite (an infinite one may spoil rows
  /// that have no weight for it); points: #rows, in the table's order. Zeros give zeros. The same
  /// bits for any number of threads. Throws ParameterError for other lengths. Allocates nothing.
  /// O(n_products()).
  void apply(std::span<const Point> controls, std::span<Point> points) const;

  /// Heap memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  SumRows<Real> sum_rows_;
  std::size_t n_controls_;
  CompressedRows<std::int32_t> rows_;         // of the table, block by block
  CompressedRows<std::int32_t> columns_;      // of the blocks
  std::vector<std::uint32_t> first_weights_;  // of the blocks
  std::vector<ColumnWeights<Real>> weights_;
};

}  // namespace espalier
