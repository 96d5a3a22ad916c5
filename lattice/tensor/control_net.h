#pragma once

/// What lies between neighbouring control points of tensor and hierarchical lattices, to be drawn.

#include <cstdint>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_lattice.h"

namespace espalier {

/// Hexahedra, quadrilaterals, lines and points of a grid, none part of another.
struct ControlNet {
  CompressedRows<std::int32_t> cells;  ///< 8, 4, 2 or 1 control points, u fastest
  std::vector<std::int32_t> levels;    ///< #cells, of a hierarchy; else empty
};

/// All cells of the grid, closed round periodic axes; with one control point on an axis
/// quadrilaterals, and so on. O(#controls).
[[nodiscard]] ControlNet control_net(const TensorLattice& lattice);

/// Of each level what lies between neighbouring control points of the level, as many as are there:
/// a control point without any neighbour is a cell of its own. O(#controls).
[[nodiscard]] ControlNet control_net(const ThbLattice& lattice);

}  // namespace espalier
