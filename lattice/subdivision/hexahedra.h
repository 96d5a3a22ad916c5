#pragma once

/// Walking through the hexahedra of a complex while keeping directions.

#include <array>
#include <optional>
#include <vector>

#include "lattice/topology/cell_complex.h"
#include "lattice/topology/hexahedron.h"

namespace espalier {

/// A hexahedron seen in some directions u, v, w: corners in the order of index_order.h.
struct Frame {
  CellId cell;
  std::array<VertexId, 8> corners;
};

/// The hexahedra among a complex's cells.
class Hexahedra {
 public:
  explicit Hexahedra(const CellComplex& complex);

  [[nodiscard]] const CellComplex& complex() const { return *complex_; }
  [[nodiscard]] bool is_hexahedron(CellId cell) const { return cells_[cell].has_value(); }
  /// The cell in its own directions. It must be a hexahedron.
  [[nodiscard]] Frame frame(CellId cell) const { return {cell, cells_[cell]->corners}; }
  /// The frame's side along an axis at 0 or 1.
  [[nodiscard]] HalfFaceId side(const Frame& frame, int axis, int end) const;
  /// The neighbour across that side in the same directions; nothing on the boundary or if it is no
  /// hexahedron.
  [[nodiscard]] std::optional<Frame> step(const Frame& frame, int axis, int end) const;
  /// The vertex of a hexahedron farthest from one of its vertices.
  [[nodiscard]] VertexId opposite(CellId cell, VertexId vertex) const;

 private:
  [[nodiscard]] std::size_t corner_of(CellId cell, VertexId vertex) const;

  const CellComplex* complex_;
  IdVector<CellId, std::optional<Hexahedron>> cells_;
};

/// The vertex of a quadrilateral that is no neighbour of one of its vertices.
[[nodiscard]] VertexId opposite(const CellComplex& complex, FaceId face, VertexId vertex);

}  // namespace espalier
