#pragma once

/// Cells that occupy the same space.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/defect.h"

namespace espalier {

/// One defect for every cell and each earlier cell whose interior overlaps its own by more than
/// `tolerance`, up to 16 a cell. Two cells overlap if faces of theirs cross, or if one has a point
/// close beneath its surface inside the other. Touching in vertices, edges or faces, shared or
/// merely coinciding, is no overlap. is_sound: cells to look at. points: #vertices, about unit
/// size. O(n log n) for cells whose boxes overlap few others.
[[nodiscard]] std::vector<Defect> find_intersecting_cells(const CellComplex& complex,
                                                          std::span<const glm::dvec3> points,
                                                          const IdVector<CellId, bool>& is_sound,
                                                          double tolerance,
                                                          const Progress& progress);

}  // namespace espalier
