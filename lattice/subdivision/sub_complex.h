#pragma once

/// Some cells of a complex as a complex of their own.

#include <memory>
#include <span>
#include <vector>

#include "lattice/topology/cell_complex.h"
#include "lattice/topology/sharpness.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// Cells cut out of a larger complex. Where the cut runs its boundary is not the larger one's.
struct SubComplex {
  CellComplex complex;
  Sharpness sharpness;             ///< taken over; what touches because of the cut is sharp
  std::vector<VertexId> vertices;  ///< of the larger complex, ascending
  std::vector<CellId> cells;       ///< of the larger complex, in the order given
};

/// Cuts out cells. O(size of the cells).
[[nodiscard]] SubComplex cut_out(const CellComplex& complex, const Sharpness& sharpness,
                                 std::span<const CellId> cells);

/// The rows of some vertices of the complex that a table has a row a vertex of.
[[nodiscard]] StencilTable rows_of(const StencilTable& table, std::span<const VertexId> vertices);

/// The cells that share a vertex with one of `cells`, these first and in their order.
[[nodiscard]] std::vector<CellId> with_neighbours(const CellComplex& complex,
                                                  std::span<const CellId> cells);

}  // namespace espalier
