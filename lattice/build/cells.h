#pragma once

/// Cells added one by one and taken away: the lowest level of building lattices, [MJ96] section 5.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/build/mesh_draft.h"

namespace espalier {

/// Joins two boundary faces of equal size by a cell. Their vertices are paired with the rotation
/// that twists least: first the one face is turned, the shortest way, until it looks at the other;
/// then the sum of squared distances between partners decides. Where the faces share vertices the
/// cell is a wedge. Throws ParameterError for faces that do not exist, are one, or differ in size;
/// LatticeError if one is no boundary face.
[[nodiscard]] Edited bridge_faces(const CellMesh& mesh, std::int32_t first, std::int32_t second);

/// Adds the cell that chosen faces and vertices span: their convex hull, but where it runs along a
/// chosen face, that face. Faces with the same vertices as old ones are shared. At most 64
/// vertices. Throws ParameterError for elements that do not exist or are given twice or that are
/// too many; LatticeError if there are fewer than four vertices, all lie in a plane, a face is no
/// boundary face or not part of the hull.
[[nodiscard]] Edited add_spanned_cell(const CellMesh& mesh, std::span<const std::int32_t> faces,
                                      std::span<const std::int32_t> vertices);

/// Takes cells away, and faces and vertices that belong to no other. Throws ParameterError for
/// cells that do not exist or are given twice, LatticeError if none would be left.
[[nodiscard]] Edited delete_cells(const CellMesh& mesh, std::span<const std::int32_t> cells);

}  // namespace espalier
