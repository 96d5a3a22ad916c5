#pragma once

/// Lattices from surface meshes: the extrusion tool of [MJ96] section 5.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/build/cell_mesh.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

/// Sweeps an open surface mesh along `direction` in `layers` equal steps: every face becomes a
/// stack of prisms, faces between neighbours shared. Points no face uses are left out; vertex i of
/// step l is vertex i + l·n of the result. points: model units; faces: rows of points, any sizes
/// and windings. Throws ParameterError if there are no faces, the mesh is closed, one has fewer
/// than three points or names a point that does not exist, layers is not in 1…10,000, the direction
/// is zero or not finite, or the result has more than 200 million faces. Whether it is a valid
/// lattice is for validate() to say.
[[nodiscard]] CellMesh extrude(std::span<const glm::dvec3> points,
                               const CompressedRows<std::int32_t>& faces,
                               const glm::dvec3& direction, int layers);

}  // namespace espalier
