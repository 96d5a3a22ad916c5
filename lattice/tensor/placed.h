#pragma once

/// Lattices without cells moved as a whole, at rest and posed.

#include "lattice/build/reshape.h"
#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_lattice.h"

namespace espalier {

/// The lattice under an affine map: what it does to a model that is placed the same way is placed
/// so too. Throws ParameterError for a placement that is not finite or flattens space, and
/// LatticeError for points that it takes too far away.
[[nodiscard]] TensorLattice placed(TensorLattice lattice, const Placement& placement);
[[nodiscard]] ThbLattice placed(ThbLattice lattice, const Placement& placement);

}  // namespace espalier
