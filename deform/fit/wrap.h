#pragma once

/// A lattice round a whole model, limbs and all: the cells of a grid that it touches.

#include <cstddef>
#include <vector>

#include "deform/fit/shared_cells.h"
#include "deform/model/model.h"
#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier {

/// Most cells along the longest side.
inline constexpr int kMostWrapCells = 128;

struct Wrap {
  SubdivisionLattice lattice;
  double step = 0;                  ///< of the grid, model units
  std::vector<SharedPlace> shared;  ///< where limbs share cells though they do not touch
  int cells_to_part = 0;  ///< along the longest side, worth trying to keep all of `shared` apart:
                          ///< enough where their gaps can be told; 0: more than there may be
};

/// The cells of a grid, `n` along the longest side of the model's box, that its surface touches or
/// comes nearer to than an eighth of a cell, and those inside it (see classify_elements()), as
/// hexahedra with automatic tags and a few more. Neighbours hold together where the surface passes
/// their common face or that is inside; so limbs side by side stay apart. The boundary is relaxed
/// as far as every point of the model stays inside the volume by a twentieth of a cell along its
/// normal, both ways; where the volume would even in the grid's own shape leave a point outside,
/// cells are added.
///
/// Faces need not be closed, consistent or manifold; points that no face uses are wrapped too.
/// Throws ParameterError unless n is 1…kMostWrapCells and the model's box has a length and
/// coordinates up to kLargestCoordinate; LatticeError if no lattice comes out of it. The same for
/// any number of threads. Tells `progress` "wrap".
[[nodiscard]] Wrap wrap(const Model& model, int n, const Progress& progress = {});

}  // namespace espalier
