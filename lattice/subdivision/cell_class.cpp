#include "lattice/subdivision/cell_class.h"

#include <algorithm>
#include <cassert>

namespace espalier {
namespace {

bool is_infinite(float sharpness) {
  return sharpness >= kInfiniteSharpness;
}

bool share_a_face(const CellComplex& complex, EdgeId a, EdgeId b) {
  return std::ranges::any_of(complex.half_faces(a), [&](HalfFaceId half_face) {
    const auto edges = complex.edges(half_face.face());
    return std::find(edges.begin(), edges.end(), b) != edges.end();
  });
}

}  // namespace

CellClassifier::CellClassifier(const Hexahedra& hexahedra, const Sharpness& sharpness,
                               Scheme scheme)
    : hexahedra_(hexahedra),
      complex_(hexahedra.complex()),
      sharpness_(sharpness),
      scheme_(scheme) {}

bool CellClassifier::has_hexahedra_only(VertexId vertex) const {
  return std::ranges::all_of(complex_.cells(vertex),
                             [&](CellId cell) { return hexahedra_.is_hexahedron(cell); });
}

bool CellClassifier::has_automatic_sharpness(VertexId vertex) const {
  const bool is_corner = complex_.cells(vertex).size() == 1;
  if (!is_corner && sharpness_.vertices[vertex] != 0) {
    return false;
  }
  return std::ranges::all_of(complex_.edges(vertex), [&](EdgeId edge) {
    const float sharpness = sharpness_.edges[edge];
    return complex_.n_cells(edge) == 1 ? is_infinite(sharpness) : sharpness == 0;
  });
}

bool CellClassifier::is_regular(VertexId vertex) const {
  const auto edges = complex_.edges(vertex);
  const std::size_t n_cells = complex_.cells(vertex).size();
  if (!has_hexahedra_only(vertex)) {
    return false;
  }
  const auto count_edges = [&](std::size_t n_faces) {
    return static_cast<std::size_t>(std::ranges::count_if(
        edges, [&](EdgeId edge) { return complex_.half_faces(edge).size() == n_faces; }));
  };
  if (!complex_.is_boundary(vertex)) {
    return n_cells == 8 && edges.size() == 6 && count_edges(4) == 6;
  }
  if (!has_automatic_sharpness(vertex)) {
    return false;
  }
  switch (n_cells) {
    case 4:  // smooth: one edge inward, four along the boundary
      return edges.size() == 5 && count_edges(4) == 1 && count_edges(3) == 4;
    case 2:  // on a sharp line: its two edges, and the two of the face between the cells
      return edges.size() == 4 && count_edges(2) == 2 && count_edges(3) == 2;
    default:
      return n_cells == 1 && edges.size() == 3;
  }
}

bool CellClassifier::is_on_line(VertexId vertex, EdgeId along) const {
  if (!has_hexahedra_only(vertex) || !has_automatic_sharpness(vertex) ||
      complex_.n_open_fans(along) > 1) {
    return false;
  }
  const auto n = static_cast<std::size_t>(complex_.n_cells(along));
  const std::size_t n_cells = complex_.cells(vertex).size();
  const bool is_end = n_cells == n;
  if (!is_end && n_cells != 2 * n) {
    return false;
  }
  int n_along = 1;
  for (const EdgeId edge : complex_.edges(vertex)) {
    if (edge == along) {
      continue;
    }
    const std::size_t n_faces = complex_.half_faces(edge).size();
    const bool is_boundary_of_section = complex_.n_cells(edge) == (is_end ? 1 : 2);
    const bool is_cross = share_a_face(complex_, edge, along) &&
                          n_faces == (is_end ? 3u : 4u) - (is_boundary_of_section ? 1u : 0u);
    if (is_cross) {
      continue;
    }
    if (is_end || share_a_face(complex_, edge, along) ||
        static_cast<std::size_t>(complex_.n_cells(edge)) != n) {
      return false;
    }
    ++n_along;
  }
  return n_along == (is_end ? 1 : 2);
}

CellClass CellClassifier::classify(CellId cell) const {
  using Kind = CellClass::Kind;
  if (!hexahedra_.is_hexahedron(cell)) {
    return {};
  }
  const Frame frame = hexahedra_.frame(cell);
  if (std::ranges::all_of(frame.corners, [&](VertexId v) { return is_regular(v); })) {
    return {Kind::Regular, -1};
  }
  if (scheme_ != Scheme::CatmullClark) {
    return {};
  }
  for (int axis = 0; axis < 3; ++axis) {
    bool is_line = true;
    for (std::size_t c = 0; c < 8 && is_line; ++c) {
      const VertexId vertex = frame.corners[c];
      const EdgeId along = complex_.find_edge(vertex, frame.corners[c ^ (std::size_t{1} << axis)]);
      is_line = is_on_line(vertex, along);
    }
    if (is_line) {
      return {Kind::Line, axis};
    }
  }
  return {};
}

RegularBlock regular_block(const Hexahedra& hexahedra, const Frame& frame) {
  RegularBlock block;
  std::array<int, 3> first{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    block.natural_begin[a] = hexahedra.complex().is_boundary(hexahedra.side(frame, axis, 0).face());
    block.natural_end[a] = hexahedra.complex().is_boundary(hexahedra.side(frame, axis, 1).face());
    first[a] = block.natural_begin[a] ? 0 : -1;
    block.size[a] = (block.natural_end[a] ? 2 : 3) - first[a];
  }
  block.points.resize(static_cast<std::size_t>(block.size[0] * block.size[1] * block.size[2]));
  // Cells at −1, 0, 1 along each axis, reached by steps along u, then v, then w.
  const auto moved = [&](const Frame& from, int axis, int by) {
    if (by == 0) {
      return from;
    }
    const auto next = hexahedra.step(from, axis, by < 0 ? 0 : 1);
    assert(next.has_value());
    return *next;
  };
  const auto cells = [&](std::size_t axis) {
    return std::pair(first[axis], block.natural_end[axis] ? 0 : 1);
  };
  for (int i = cells(0).first; i <= cells(0).second; ++i) {
    const Frame at_u = moved(frame, 0, i);
    for (int j = cells(1).first; j <= cells(1).second; ++j) {
      const Frame at_v = moved(at_u, 1, j);
      for (int k = cells(2).first; k <= cells(2).second; ++k) {
        const Frame at = moved(at_v, 2, k);
        for (int c = 0; c < 8; ++c) {
          const int u = i + c % 2 - first[0];
          const int v = j + c / 2 % 2 - first[1];
          const int w = k + c / 4 - first[2];
          block.points[static_cast<std::size_t>(u + block.size[0] * (v + block.size[1] * w))] =
              at.corners[static_cast<std::size_t>(c)];
        }
      }
    }
  }
  return block;
}

}  // namespace espalier
