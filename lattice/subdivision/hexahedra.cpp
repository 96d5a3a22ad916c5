#include "lattice/subdivision/hexahedra.h"

#include <algorithm>
#include <cassert>

namespace espalier {

Hexahedra::Hexahedra(const CellComplex& complex) : complex_(&complex), cells_(complex.n_cells()) {
  for (const CellId cell : complex.cells()) {
    cells_[cell] = hexahedron(complex, cell);
  }
}

std::size_t Hexahedra::corner_of(CellId cell, VertexId vertex) const {
  const auto& corners = cells_[cell]->corners;
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) -
                                  corners.begin());
}

HalfFaceId Hexahedra::side(const Frame& frame, int axis, int end) const {
  // The four corners share one bit of their numbers in the cell's own directions.
  std::size_t all = 7;
  std::size_t any = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    if (static_cast<int>(c >> axis & 1) == end) {
      const std::size_t own = corner_of(frame.cell, frame.corners[c]);
      all &= own;
      any |= own;
    }
  }
  for (std::size_t own_axis = 0; own_axis < 3; ++own_axis) {
    if ((all >> own_axis & 1) != 0) {
      return cells_[frame.cell]->faces[2 * own_axis + 1];
    }
    if ((any >> own_axis & 1) == 0) {
      return cells_[frame.cell]->faces[2 * own_axis];
    }
  }
  assert(false);
  return {};
}

std::optional<Frame> Hexahedra::step(const Frame& frame, int axis, int end) const {
  const CellId next = complex_->cell(side(frame, axis, end).opposite());
  if (!next.is_valid() || !is_hexahedron(next)) {
    return std::nullopt;
  }
  const std::size_t bit = std::size_t{1} << axis;
  const auto& corners = cells_[next]->corners;
  Frame result{next, {}};
  std::array<std::size_t, 8> own{};
  for (std::size_t c = 0; c < 8; ++c) {
    if (static_cast<int>(c >> axis & 1) == end) {
      result.corners[c ^ bit] = frame.corners[c];
      own[c ^ bit] = corner_of(next, frame.corners[c]);
    }
  }
  // The axis that leaves the shared side, in the neighbour's own directions.
  std::size_t all = 7;
  std::size_t any = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    if (static_cast<int>(c >> axis & 1) != end) {
      all &= own[c];
      any |= own[c];
    }
  }
  const std::size_t across = all | (~any & 7);
  for (std::size_t c = 0; c < 8; ++c) {
    if (static_cast<int>(c >> axis & 1) == end) {
      result.corners[c] = corners[own[c ^ bit] ^ across];
    }
  }
  return result;
}

VertexId Hexahedra::opposite(CellId cell, VertexId vertex) const {
  return cells_[cell]->corners[corner_of(cell, vertex) ^ 7];
}

VertexId opposite(const CellComplex& complex, FaceId face, VertexId vertex) {
  const auto loop = complex.vertices(face);
  const auto at =
      static_cast<std::size_t>(std::find(loop.begin(), loop.end(), vertex) - loop.begin());
  return loop[(at + 2) % 4];
}

}  // namespace espalier
