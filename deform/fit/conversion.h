#pragma once

/// What is worth telling about a lattice that was made from a model.

#include <cstddef>
#include <vector>

#include "deform/fit/shared_cells.h"
#include "deform/model/model.h"
#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier {

struct Conversion {
  std::size_t n_points = 0;         ///< of the model; 0: there was none
  std::size_t n_inside = 0;         ///< of these, in the volume or on its border
  std::vector<SharedPlace> shared;  ///< of a wrap, see Wrap
  int cells_to_part = 0;
};

/// Counts the model's points inside the lattice's volume, refined twice, which is exact to about a
/// hundredth of a cell, or once if it has more than 20000 cells; none (n_points = 0) if a cell has
/// more than 128 faces, which would take too long. The same for
/// any number of threads.
[[nodiscard]] Conversion measured(const SubdivisionLattice& lattice, const Model& model,
                                  const Progress& progress = {});

}  // namespace espalier
