#pragma once

/// Round bars that meet.

#include <glm/vec3.hpp>
#include <vector>

#include "lattice/build/cell_mesh.h"

namespace espalier {

/// Arms from a common centre: a square core of 2 × 2 cells in a shell, so no wedges.
struct JunctionOptions {
  glm::dvec3 center{0, 0, 0};
  std::vector<glm::dvec3> arms;  ///< from the centre to the end of each, 1 to 6
  double radius = 0.25;          ///< of the volume round each arm, to about 5 %
  int layers = 3;                ///< along each arm
};

/// Every arm leaves the centre through the side of a cube it points to most. Throws ParameterError
/// naming the option that is out of range, or two arms that would leave by one side.
[[nodiscard]] CellMesh make_junction(const JunctionOptions& options);

}  // namespace espalier
