#pragma once

/// Where the vertices of a Catmull-Clark lattice converge to.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lattice/subdivision/hexahedra.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/sharpness.h"

namespace espalier {

/// A point as a combination of vertices of one complex.
using VertexCombination = std::vector<std::pair<VertexId, double>>;

/// The limit position of a vertex: in closed form at regular and line vertices inside and at all
/// boundary vertices whose sharpness is 0 or infinite; at nodes inside, and where other cells than
/// hexahedra meet, from the left eigenvector of the one-ring's refinement matrix. Nothing at
/// fractional creases, nor on the boundary at faces that are not quadrilaterals. The sharpness must
/// count what touches. O(1), but a thousand times slower in the last case.
[[nodiscard]] std::optional<VertexCombination> limit_position(const Hexahedra& hexahedra,
                                                              const Sharpness& sharpness,
                                                              Scheme scheme, VertexId vertex);

/// The limit positions of the points that refinement puts into some cells. O(size of the cells and
/// those that share vertices with them), so that many at once cost less than one by one.
[[nodiscard]] std::vector<VertexCombination> limits_of_cell_points(const CellComplex& complex,
                                                                   const Sharpness& sharpness,
                                                                   Scheme scheme,
                                                                   std::span<const CellId> cells);

}  // namespace espalier
