#pragma once

/// Growing a mesh from its faces: the extrusion tool of [MJ96] section 5 applied to lattices.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/build/mesh_draft.h"

namespace espalier {

/// Extrudes faces along a vector in `layers` equal steps: every face becomes a stack of prisms,
/// neighbours share side faces. From faces on the boundary the mesh grows outward. Along inner
/// faces it is opened on the side `by` points to: new layers are inserted and take their room from
/// the cells beyond. An old face stays with the cell behind it, new vertices follow what they were
/// extruded from. Throws ParameterError for faces that do not exist or are given twice, layers not
/// in 1…10,000, or a vector that is zero or not finite; LatticeError if the mesh is no complex, or
/// cannot be opened: the inner faces' rim is inside it, or one is parallel to `by`.
[[nodiscard]] Edited extrude_faces_along(const CellMesh& mesh, std::span<const std::int32_t> faces,
                                         const glm::dvec3& by, int layers);

/// The same by `distance` along the faces' normals, see offsets_along_normals(): outward from the
/// boundary, inward if negative; from side 0 of inner faces.
[[nodiscard]] Edited extrude_faces_outward(const CellMesh& mesh,
                                           std::span<const std::int32_t> faces, double distance,
                                           int layers);

/// The same of boundary faces by one offset a vertex. offsets: #vertices, model units.
[[nodiscard]] Edited extrude_faces_by(const CellMesh& mesh, std::span<const std::int32_t> faces,
                                      std::span<const glm::dvec3> offsets, int layers);

}  // namespace espalier
