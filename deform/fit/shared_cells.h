#pragma once

/// Where parts of a model that do not touch there lie in one cell of a grid.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/fit/cell_set.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {

/// Cells side by side that hold parts, limbs say, which are joined nowhere near them.
struct SharedPlace {
  glm::dvec3 center{0};  ///< mean of the cells' middles, model units
  std::size_t n_cells = 0;
  double gap = 0;  ///< least width of the space between the parts, model units; 0: less
                   ///< than what can be told apart, a third of a cell
};

/// Finds them on a grid three times as fine, with what lies that near to a cell: parts are joined
/// if they are in the block of 3 × 3 × 3 cells round the cell. triangles, is_closed: as for
/// classify_elements(). Nothing for grids too large for that, of more than about a hundred cells
/// each way. Sorted by number of cells, most first.
[[nodiscard]] std::vector<SharedPlace> find_shared_places(const CellSet& cells,
                                                          std::span<const Triangle> triangles,
                                                          bool is_closed);

}  // namespace espalier
