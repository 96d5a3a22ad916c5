#pragma once

/// Cells of a grid shaped after the model that they hold.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/fit/cell_set.h"
#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier {

/// What became of cells that were relaxed round a model.
struct Enclosure {
  SubdivisionLattice lattice;  ///< at rest; automatic tags, and sharp where GridCells asks for it
  /// Elements of the grid where the cells even unrelaxed leave a probe outside or are no lattice:
  /// nodes that need cells round them. Empty: every probe is inside.
  std::vector<std::size_t> lacking;
};

/// Relaxes the cells' boundary and evens out their inside, but only so far that all probes stay
/// inside the volume and no cell folds: where one would not, the vertices go back to their places
/// in the grid by halves, in three steps at most, so that this ends. Volume here is the lattice
/// refined twice, with cells of positive determinants, at creases as often as freezing may
/// (NodeCheck): edges there become sharp where that helps. probes: points in the cells, model
/// units. Throws Cancelled. The same for any number of threads.
[[nodiscard]] Enclosure enclose(const GridCells& cells, const GridFrame& frame,
                                std::span<const glm::dvec3> probes, const Progress& progress = {});

}  // namespace espalier
