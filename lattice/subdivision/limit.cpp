#include "lattice/subdivision/limit.h"

#include <algorithm>
#include <array>

#include "lattice/osd/crease_masks.h"
#include "lattice/subdivision/refine.h"

namespace espalier {
namespace {

bool is_crisp(float sharpness) {
  return sharpness == 0 || sharpness >= kInfiniteSharpness;
}

bool has_hexahedra_only(const Hexahedra& hexahedra, VertexId vertex) {
  return std::ranges::all_of(hexahedra.complex().cells(vertex),
                             [&](CellId cell) { return hexahedra.is_hexahedron(cell); });
}

std::optional<VertexCombination> on_boundary(const CellComplex& complex, const Sharpness& sharpness,
                                             VertexId vertex) {
  VertexCombination result;
  std::vector<EdgeId> edges;
  std::vector<float> edge_sharpness;
  for (const EdgeId edge : complex.edges(vertex)) {
    if (complex.is_boundary(edge)) {
      edges.push_back(edge);
      edge_sharpness.push_back(sharpness.edges[edge]);
    }
  }
  if (!is_crisp(sharpness.vertices[vertex]) || !std::ranges::all_of(edge_sharpness, is_crisp)) {
    return std::nullopt;
  }
  std::vector<FaceId> faces;
  for (const FaceId face : complex.faces(vertex)) {
    if (complex.is_boundary(face)) {
      faces.push_back(face);
    }
  }
  const osd::VertexMask mask =
      osd::vertex_limit_mask(sharpness.vertices[vertex], edge_sharpness, faces.size());
  result.emplace_back(vertex, mask.vertex);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    result.emplace_back(complex.other_end(edges[i], vertex), mask.other_ends[i]);
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    result.emplace_back(opposite(complex, faces[i], vertex), mask.face_centroids[i]);
  }
  return result;
}

/// The limit of the surface across a line of valence n: weights of the vertex, each neighbour, each
/// opposite corner.
struct SurfaceLimit {
  double vertex;
  double edge;
  double face;
};

SurfaceLimit surface_limit(double n) {
  const double face = 1 / (n * (n + 5));
  return {1 - 5 * n * face, 4 * face, face};
}

/// Inside, on a line of valence n (any two opposite edges where n = 4): surface limit across times
/// (1, 4, 1) / 6 along.
VertexCombination on_line(const Hexahedra& hexahedra, VertexId vertex,
                          const std::array<EdgeId, 2>& line) {
  const CellComplex& complex = hexahedra.complex();
  const SurfaceLimit across =
      surface_limit(static_cast<double>(complex.half_faces(line[0]).size()));
  constexpr double kHere = 4.0 / 6;
  constexpr double kBeside = 1.0 / 6;
  VertexCombination result = {{vertex, across.vertex * kHere}};
  for (const EdgeId edge : complex.edges(vertex)) {
    const bool is_line = edge == line[0] || edge == line[1];
    result.emplace_back(complex.other_end(edge, vertex),
                        is_line ? across.vertex * kBeside : across.edge * kHere);
  }
  for (const FaceId face : complex.faces(vertex)) {
    const auto edges = complex.edges(face);
    const bool has_line =
        std::ranges::any_of(edges, [&](EdgeId edge) { return edge == line[0] || edge == line[1]; });
    result.emplace_back(opposite(complex, face, vertex),
                        has_line ? across.edge * kBeside : across.face * kHere);
  }
  for (const CellId cell : complex.cells(vertex)) {
    result.emplace_back(hexahedra.opposite(cell, vertex), across.face * kBeside);
  }
  return result;
}

bool is_regular_inside(const CellComplex& complex, VertexId vertex) {
  return complex.cells(vertex).size() == 8 && complex.edges(vertex).size() == 6 &&
         std::ranges::all_of(complex.edges(vertex),
                             [&](EdgeId edge) { return complex.half_faces(edge).size() == 4; });
}

/// An edge at a regular inner vertex and the one that shares no face with it.
std::array<EdgeId, 2> any_line(const CellComplex& complex, VertexId vertex) {
  const auto edges = complex.edges(vertex);
  for (const EdgeId edge : edges.subspan(1)) {
    const bool shares_face = std::ranges::any_of(complex.half_faces(edge), [&](HalfFaceId side) {
      const auto around = complex.edges(side.face());
      return std::find(around.begin(), around.end(), edges[0]) != around.end();
    });
    if (!shares_face) {
      return {edges[0], edge};
    }
  }
  return {edges[0], edges[0]};
}

}  // namespace

std::optional<VertexCombination> limit_position(const Hexahedra& hexahedra,
                                                const Sharpness& sharpness, Scheme scheme,
                                                VertexId vertex) {
  const CellComplex& complex = hexahedra.complex();
  if (!has_hexahedra_only(hexahedra, vertex)) {
    return std::nullopt;
  }
  if (complex.is_boundary(vertex)) {
    return on_boundary(complex, sharpness, vertex);
  }
  if (is_regular_inside(complex, vertex)) {
    return on_line(hexahedra, vertex, any_line(complex, vertex));
  }
  if (scheme == Scheme::CatmullClark) {
    if (const auto line = line_edges(complex, vertex)) {
      return on_line(hexahedra, vertex, *line);
    }
  }
  return std::nullopt;
}

}  // namespace espalier
