#pragma once

/// Whether tables of faces and cells describe a cell complex, coordinates aside.

#include <vector>

#include "lattice/topology/defect.h"
#include "lattice/topology/polyhedra.h"

namespace espalier {

/// Every structural defect that shows before edges are built (NoCells … UnusedVertex), in the
/// order of the elements. Defects that would only follow from an earlier one are left out: indices
/// are checked first, then faces, then cells; unused vertices are told in any case. O(n log(size of
/// a cell)).
[[nodiscard]] std::vector<Defect> find_structural_defects(const Polyhedra& polyhedra);

}  // namespace espalier
