#pragma once

/// Ready-made lattices.

#include <array>
#include <glm/vec3.hpp>

#include "lattice/build/cell_mesh.h"

namespace espalier {

/// A grid of hexahedra that fills the box from `min` to `max`. cells: how many along x, y, z;
/// vertex order as in index_order.h. Throws ParameterError unless every count is 1 or more, the
/// total at most 20 million, and min < max on every axis.
[[nodiscard]] CellMesh make_box(const std::array<int, 3>& cells, const glm::dvec3& min,
                                const glm::dvec3& max);

/// A round bar from one point to another, in layers of wedges round its axis.
struct CylinderOptions {
  glm::dvec3 from{0, 0, 0};  ///< centre of the first end
  glm::dvec3 to{0, 1, 0};    ///< centre of the second end
  double radius = 0.5;       ///< of the volume at the first end; its control points lie farther out
  double end_radius = 0;     ///< at the second end; 0: the same
  int sectors = 8;           ///< wedges a layer, 3 or more
  int layers = 4;            ///< along the axis, 1 or more
};

/// Step l holds its centre at l·(sectors + 1), then the ring. Throws ParameterError naming the
/// option that is out of range.
[[nodiscard]] CellMesh make_cylinder(const CylinderOptions& options);

}  // namespace espalier
