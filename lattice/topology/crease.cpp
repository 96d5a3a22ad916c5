#include "lattice/topology/crease.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

void check_boundary(const CellComplex& complex, EdgeId edge) {
  if (!complex.is_boundary(edge)) {
    throw LatticeError(
        fmt::format("edge {}-{} is not on the boundary, where alone edges may be "
                    "sharp",
                    complex.vertices(edge)[0].value, complex.vertices(edge)[1].value));
  }
}

bool share_boundary_face(const CellComplex& complex, EdgeId a, EdgeId b) {
  for (const HalfFaceId half_face : complex.half_faces(a)) {
    const auto edges = complex.edges(half_face.face());
    if (complex.is_boundary(half_face.face()) &&
        std::find(edges.begin(), edges.end(), b) != edges.end()) {
      return true;
    }
  }
  return false;
}

/// The edge that goes straight on beyond a vertex; invalid if there is none.
EdgeId straight_on(const CellComplex& complex, EdgeId edge, VertexId vertex) {
  EdgeId ahead;
  int n_boundary = 0;
  for (const EdgeId other : complex.edges(vertex)) {
    if (complex.is_boundary(other)) {
      ++n_boundary;
      if (other != edge && !share_boundary_face(complex, edge, other)) {
        ahead = other;
      }
    }
  }
  return n_boundary == 4 ? ahead : EdgeId{};
}

}  // namespace

std::vector<EdgeId> boundary_line(const CellComplex& complex, EdgeId edge) {
  check_boundary(complex, edge);
  std::vector<EdgeId> line = {edge};
  for (const VertexId end : complex.vertices(edge)) {
    EdgeId at = edge;
    VertexId vertex = end;
    while (true) {
      at = straight_on(complex, at, vertex);
      if (!at.is_valid() || std::find(line.begin(), line.end(), at) != line.end()) {
        break;
      }
      line.push_back(at);
      vertex = complex.other_end(at, vertex);
    }
  }
  return line;
}

Sharpness with_tags(const CellComplex& complex, Sharpness sharpness, std::span<const EdgeId> edges,
                    std::span<const VertexId> vertices, float value) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw ParameterError("the sharpness must be a finite number from 0 up");
  }
  for (const EdgeId edge : edges) {
    check_boundary(complex, edge);
    sharpness.edges[edge] = value;
  }
  for (const VertexId vertex : vertices) {
    if (!complex.is_boundary(vertex)) {
      throw LatticeError(fmt::format(
          "vertex {} is not on the boundary, where alone vertices may be sharp", vertex.value));
    }
    sharpness.vertices[vertex] = value;
  }
  return sharpness;
}

}  // namespace espalier
