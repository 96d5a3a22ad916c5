#pragma once

/// What the builders make: cells with points, not yet a lattice of any kind.

#include <glm/vec3.hpp>
#include <vector>

#include "lattice/topology/polyhedra.h"

namespace espalier {

/// Oriented cells at rest points.
struct CellMesh {
  Polyhedra cells;
  std::vector<glm::dvec3> points;  ///< #vertices, model units
};

}  // namespace espalier
