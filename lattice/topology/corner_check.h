#pragma once

/// Cells that are folded at a corner though their volume is positive.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/topology/cell_complex.h"

namespace espalier {

/// How many cells have a corner with three edges that span no positive volume. Corners with more
/// edges are not looked at. points: #vertices, model units. O(n).
[[nodiscard]] std::size_t count_cells_inverted_at_corners(const CellComplex& complex,
                                                          std::span<const glm::dvec3> points);

}  // namespace espalier
