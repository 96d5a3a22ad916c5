#include "lattice/subdivision/limit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lattice/core/parallel.h"
#include "lattice/osd/crease_masks.h"
#include "lattice/subdivision/refine.h"
#include "lattice/subdivision/sub_complex.h"

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
      if (complex.vertices(face).size() != 4) {
        return std::nullopt;
      }
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

/// The place of a vertex of the larger complex in a part of it.
VertexId within(const SubComplex& part, VertexId vertex) {
  const auto found = std::lower_bound(part.vertices.begin(), part.vertices.end(), vertex);
  return VertexId{static_cast<std::int32_t>(found - part.vertices.begin())};
}

/// A combination of refined vertices as one of the vertices they come from: of the part's, numbered
/// in the larger complex.
VertexCombination pulled_back(const VertexCombination& refined, const StencilTable& stencils,
                              const SubComplex& part) {
  std::vector<double> weights(part.vertices.size(), 0.0);
  for (const auto& [vertex, weight] : refined) {
    const StencilTable::Row row = stencils[vertex.index()];
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      weights[static_cast<std::size_t>(row.indices[k])] += weight * row.weights[k];
    }
  }
  VertexCombination result;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] != 0) {
      result.emplace_back(part.vertices[i], weights[i]);
    }
  }
  return result;
}

/// For each vertex of a ring that is alike at all levels, the vertex that stands for it after a
/// refinement: vertex, edge, face and cell points at the centre.
std::vector<VertexId> next_ring(const CellComplex& ring, const ParentMap& parents,
                                VertexId centre) {
  std::vector<VertexId> next(ring.n_vertices());
  next[centre.index()] = parents.vertex_point(centre);
  for (const EdgeId edge : ring.edges(centre)) {
    next[ring.other_end(edge, centre).index()] = parents.edge_point(edge);
  }
  for (const FaceId face : ring.faces(centre)) {
    next[opposite(ring, face, centre).index()] = parents.face_point(face);
  }
  for (const CellId cell : ring.cells(centre)) {
    for (const VertexId vertex : ring.vertices(cell)) {
      if (next[vertex.index()] == VertexId{}) {  // neither an edge nor a face leads there
        next[vertex.index()] = parents.cell_point(cell);
      }
    }
  }
  return next;
}

/// The left eigenvector of eigenvalue 1 of the matrix whose rows are some rows of a table, scaled
/// to the sum 1: by multiplying from the left until nothing changes. The next eigenvalue is at
/// most about 0.7.
VertexCombination left_eigenvector(const StencilTable& table, const std::vector<VertexId>& rows,
                                   VertexId start) {
  constexpr int kMostSteps = 400;
  constexpr double kSmall = 1e-17;
  std::vector<double> weights(rows.size(), 0.0);
  weights[start.index()] = 1;
  double change = 1;
  for (int step = 0; step < kMostSteps && change > kSmall; ++step) {
    std::vector<double> next(rows.size(), 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const StencilTable::Row row = table[rows[i].index()];
      for (std::size_t k = 0; k < row.indices.size(); ++k) {
        next[static_cast<std::size_t>(row.indices[k])] += weights[i] * row.weights[k];
      }
    }
    change = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      change = std::max(change, std::abs(next[i] - weights[i]));
    }
    weights = std::move(next);
  }
  VertexCombination result;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    result.emplace_back(VertexId{static_cast<std::int32_t>(i)}, weights[i]);
  }
  return result;
}

/// An inner vertex of any kind. After one refinement its ring is alike at all levels.
VertexCombination at_node(const CellComplex& complex, const Sharpness& sharpness, Scheme scheme,
                          VertexId vertex) {
  const SubComplex around = cut_out(complex, sharpness, complex.cells(vertex));
  const Refinement first = refine(around.complex, around.sharpness, scheme);
  const VertexId centre = first.parents.vertex_point(within(around, vertex));
  const SubComplex ring = cut_out(*first.complex, first.sharpness, first.complex->cells(centre));
  const VertexId ring_centre = within(ring, centre);
  const Refinement second = refine(ring.complex, ring.sharpness, scheme);
  VertexCombination limit = left_eigenvector(
      second.stencils, next_ring(ring.complex, second.parents, ring_centre), ring_centre);
  for (auto& [refined, weight] : limit) {
    refined = ring.vertices[refined.index()];
  }
  return pulled_back(limit, first.stencils, around);
}

}  // namespace

std::optional<VertexCombination> limit_position(const Hexahedra& hexahedra,
                                                const Sharpness& sharpness, Scheme scheme,
                                                VertexId vertex) {
  const CellComplex& complex = hexahedra.complex();
  if (complex.is_boundary(vertex)) {
    return on_boundary(complex, sharpness, vertex);
  }
  if (has_hexahedra_only(hexahedra, vertex)) {
    if (is_regular_inside(complex, vertex)) {
      return on_line(hexahedra, vertex, any_line(complex, vertex));
    }
    if (scheme == Scheme::CatmullClark) {
      if (const auto line = line_edges(complex, vertex)) {
        return on_line(hexahedra, vertex, *line);
      }
    }
  }
  return at_node(complex, sharpness, scheme, vertex);
}

std::vector<VertexCombination> limits_of_cell_points(const CellComplex& complex,
                                                     const Sharpness& sharpness, Scheme scheme,
                                                     std::span<const CellId> cells) {
  const SubComplex part = cut_out(complex, sharpness, with_neighbours(complex, cells));
  const Refinement refinement = refine(part.complex, part.sharpness, scheme);
  std::vector<VertexCombination> result(cells.size());
  parallel_for(
      cells.size(),
      [&](std::size_t i) {  // with_neighbours() keeps the cells in front
        const CellId cell{static_cast<std::int32_t>(i)};
        result[i] = at_node(*refinement.complex, refinement.sharpness, scheme,
                            refinement.parents.cell_point(cell));
      },
      16);
  const StencilTable limits = compose(
      refinement.stencils, StencilTable::build(cells.size(), refinement.complex->n_vertices(),
                                               [&](std::size_t i, StencilRow& row) {
                                                 for (const auto& [vertex, weight] : result[i]) {
                                                   row.add(vertex.value, weight);
                                                 }
                                               }));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const StencilTable::Row row = limits[i];
    result[i].clear();
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      result[i].emplace_back(part.vertices[static_cast<std::size_t>(row.indices[k])],
                             row.weights[k]);
    }
  }
  return result;
}

}  // namespace espalier
