#pragma once

/// Cells that are hexahedra, in the corner order of index_order.h.

#include <array>
#include <optional>

#include "lattice/topology/cell_complex.h"

namespace espalier {

/// A hexahedron's elements in the order of index_order.h, with a positive orientation.
struct Hexahedron {
  std::array<VertexId, 8> corners;
  std::array<HalfFaceId, 6> faces;
};

/// The cell as a hexahedron, corner 0 at its first vertex, or nothing if it is none: six
/// quadrilaterals, eight vertices, three edges at each.
[[nodiscard]] std::optional<Hexahedron> hexahedron(const CellComplex& complex, CellId cell);

/// A side's vertices in its own direction: counter-clockwise seen from outside its cell.
[[nodiscard]] std::vector<VertexId> loop(const CellComplex& complex, HalfFaceId half_face);

}  // namespace espalier
