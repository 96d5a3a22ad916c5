#pragma once

/// Loops of cells inserted into a mesh.

#include <cstdint>

#include "lattice/build/mesh_draft.h"

namespace espalier {

/// Splits the layer of cells that an edge crosses in two: the edge, the edges opposite it in its
/// faces, those opposite them and so on are cut at the fraction `at`, counted from vertex `from`,
/// and every cell between is cut through. Cells must be prisms along the edge, such as hexahedra; a
/// split cell or face becomes its part at `from` and a new one. Throws ParameterError if there is
/// no such edge or `at` is not within (0, 1); LatticeError if the layer runs into a face that is no
/// quadrilateral, crosses itself or is one-sided.
[[nodiscard]] Edited split_layer(const CellMesh& mesh, std::int32_t from, std::int32_t to,
                                 double at);

}  // namespace espalier
