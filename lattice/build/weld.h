#pragma once

/// Meshes put together: side by side, welded, mirrored.

#include <glm/vec3.hpp>

#include "lattice/build/mesh_draft.h"

namespace espalier {

/// Makes vertices within `tolerance` of each other one, chains of them too, at their mean; then
/// edges and faces with the same vertices coincide and cells become neighbours; what is left
/// without extent vanishes. tolerance: model units; 0 joins only what coincides exactly. Throws
/// ParameterError for a tolerance that is negative or not finite. O(n log n).
[[nodiscard]] Edited weld(const CellMesh& mesh, double tolerance);

/// Two meshes as one, nothing shared: the elements of `first`, then those of `second`.
[[nodiscard]] CellMesh side_by_side(const CellMesh& first, const CellMesh& second);

/// The mesh with its mirror image, welded at the plane: vertices within `tolerance` of it move onto
/// it and are shared. Old elements keep their indices; copies follow them, mirrored. Throws
/// ParameterError for a normal that is zero or not finite, or a bad tolerance.
[[nodiscard]] Edited mirror(const CellMesh& mesh, const glm::dvec3& point, const glm::dvec3& normal,
                            double tolerance);

/// What counts as one place unless told otherwise: 1e-6 of the points' diagonal.
[[nodiscard]] double usual_tolerance(const CellMesh& mesh);

}  // namespace espalier
