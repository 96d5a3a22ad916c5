#include "lattice/topology/hexahedron.h"

#include <algorithm>

#include "lattice/core/index_order.h"

namespace espalier {
namespace {

using Quad = std::array<VertexId, 4>;

/// A quadrilateral side, turned so that it starts at `first`; nothing if it has no such vertex.
std::optional<Quad> quad_from(const CellComplex& complex, HalfFaceId half_face, VertexId first) {
  const std::vector<VertexId> vertices = loop(complex, half_face);
  const auto at = std::find(vertices.begin(), vertices.end(), first);
  if (at == vertices.end()) {
    return std::nullopt;
  }
  Quad quad;
  std::rotate_copy(vertices.begin(), at, vertices.end(), quad.begin());
  return quad;
}

bool has_hexahedron_counts(const CellComplex& complex, CellId cell) {
  const auto sides = complex.half_faces(cell);
  return sides.size() == 6 && complex.vertices(cell).size() == 8 &&
         std::all_of(sides.begin(), sides.end(),
                     [&](HalfFaceId side) { return complex.vertices(side.face()).size() == 4; });
}

}  // namespace

std::vector<VertexId> loop(const CellComplex& complex, HalfFaceId half_face) {
  const auto stored = complex.vertices(half_face.face());
  std::vector<VertexId> vertices(stored.begin(), stored.end());
  if (half_face.side() == 1) {
    std::reverse(vertices.begin(), vertices.end());
  }
  return vertices;
}

std::optional<Hexahedron> hexahedron(const CellComplex& complex, CellId cell) {
  if (!has_hexahedron_counts(complex, cell)) {
    return std::nullopt;
  }
  // The sides at corner 0, each starting there, first the one that becomes w = 0.
  Hexahedron result;
  auto& corner = result.corners;
  corner[0] = complex.vertices(cell).front();
  std::vector<Quad> quads;
  for (const HalfFaceId side : complex.half_faces(cell)) {
    if (const auto quad = quad_from(complex, side, corner[0])) {
      quads.push_back(*quad);
    }
  }
  if (quads.size() != 3) {
    return std::nullopt;
  }
  // w = 0 runs 0 2 3 1, u = 0 runs 0 4 6 2, v = 0 runs 0 1 5 4.
  corner[2] = quads[0][1];
  corner[3] = quads[0][2];
  corner[1] = quads[0][3];
  const Quad& u_side = quads[1][3] == corner[2] ? quads[1] : quads[2];
  const Quad& v_side = quads[1][3] == corner[2] ? quads[2] : quads[1];
  corner[4] = u_side[1];
  corner[6] = u_side[2];
  corner[5] = v_side[2];
  const auto used_end = corner.begin() + 7;
  for (const VertexId vertex : complex.vertices(cell)) {
    if (std::find(corner.begin(), used_end, vertex) == used_end) {
      corner[7] = vertex;
    }
  }
  // Every side must be one of the six faces; this rejects other polyhedra with the same counts.
  for (std::size_t face = 0; face < 6; ++face) {
    Quad expected;
    std::transform(kHexahedronFaces[face].begin(), kHexahedronFaces[face].end(), expected.begin(),
                   [&](int c) { return corner[static_cast<std::size_t>(c)]; });
    for (const HalfFaceId side : complex.half_faces(cell)) {
      if (quad_from(complex, side, expected[0]) == expected) {
        result.faces[face] = side;
      }
    }
    if (!result.faces[face].is_valid()) {
      return std::nullopt;
    }
  }
  return result;
}

}  // namespace espalier
