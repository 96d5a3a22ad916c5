#pragma once

/// Where the vertices of a Catmull-Clark lattice converge to.

#include <optional>
#include <utility>
#include <vector>

#include "lattice/subdivision/hexahedra.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/sharpness.h"

namespace espalier {

/// A point as a combination of vertices of one complex.
using VertexCombination = std::vector<std::pair<VertexId, double>>;

/// The limit position of a vertex with hexahedra round it: regular and line vertices inside, all
/// boundary vertices whose sharpness is 0 or infinite. Nothing at nodes and elsewhere.
[[nodiscard]] std::optional<VertexCombination> limit_position(const Hexahedra& hexahedra,
                                                              const Sharpness& sharpness,
                                                              Scheme scheme, VertexId vertex);

}  // namespace espalier
