#pragma once

/// Edges, faces and cells between the control points of grids.

#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_lattice.h"
#include "viewer/interact/lattice_elements.h"

namespace espalier::viewer {

/// Between neighbours along u, v and w; a periodic axis closes.
[[nodiscard]] LatticeElements grid_elements(const TensorLattice& lattice);

/// Between neighbours of one level that all are control points.
[[nodiscard]] LatticeElements grid_elements(const ThbLattice& lattice);

}  // namespace espalier::viewer
