#include "lattice/subdivision/refinement_stencils.h"

#include <algorithm>
#include <vector>

#include "lattice/osd/crease_masks.h"
#include "lattice/subdivision/masks.h"
#include "lattice/subdivision/refine.h"

namespace espalier {
namespace {

/// Adds weighted centroids, midpoints and points of a complex to a row.
class PointAdder {
 public:
  PointAdder(const CellComplex& complex, StencilRow& row) : complex_(complex), row_(row) {}

  void add(VertexId vertex, double weight) { row_.add(vertex.value, weight); }
  void add(EdgeId edge, double weight) { add_mean(complex_.vertices(edge), weight); }
  void add(FaceId face, double weight) { add_mean(complex_.vertices(face), weight); }
  void add(CellId cell, double weight) { add_mean(complex_.vertices(cell), weight); }

  /// The mean over elements of their centroids.
  template <class Elements>
  void add_mean_of(const Elements& elements, double weight) {
    for (const auto element : elements) {
      add(element, weight / static_cast<double>(elements.size()));
    }
  }

 private:
  template <class Vertices>
  void add_mean(const Vertices& vertices, double weight) {
    for (const VertexId vertex : vertices) {
      add(vertex, weight / static_cast<double>(vertices.size()));
    }
  }

  const CellComplex& complex_;
  StencilRow& row_;
};

/// The boundary elements among some.
template <class Id>
std::vector<Id> boundary_only(const CellComplex& complex, std::span<const Id> elements) {
  std::vector<Id> boundary;
  std::copy_if(elements.begin(), elements.end(), std::back_inserter(boundary),
               [&](Id element) { return complex.is_boundary(element); });
  return boundary;
}

void fill_face_point(const CellComplex& complex, FaceId face, PointAdder& out) {
  if (complex.is_boundary(face)) {
    out.add(face, 1.0);
    return;
  }
  constexpr FacePointMask kMask;
  out.add(complex.cell(HalfFaceId(face, 0)), kMask.cells / 2);
  out.add(complex.cell(HalfFaceId(face, 1)), kMask.cells / 2);
  out.add(face, kMask.centroid);
}

void fill_inner_edge_point(const CellComplex& complex, EdgeId edge, PointAdder& out) {
  const auto half_faces = complex.half_faces(edge);
  const auto n = static_cast<int>(half_faces.size());
  const EdgePointMask mask = edge_point_mask(n);
  for (const HalfFaceId half_face : half_faces) {
    out.add(complex.cell(half_face), mask.cells / n);
    out.add(half_face.face(), mask.faces / n);
  }
  out.add(edge, mask.midpoint);
}

void fill_boundary_edge_point(const CellComplex& complex, EdgeId edge, float sharpness,
                              PointAdder& out) {
  const osd::EdgeMask mask = osd::edge_mask(sharpness);
  for (std::size_t i = 0; i < 2; ++i) {
    out.add(complex.vertices(edge)[i], mask.ends[i]);
  }
  if (mask.face_centroids[0] == 0) {
    return;
  }
  std::size_t i = 0;
  for (const HalfFaceId half_face : complex.half_faces(edge)) {
    if (complex.is_boundary(half_face.face())) {
      out.add(half_face.face(), mask.face_centroids[i++]);
    }
  }
}

void fill_line_vertex_point(const CellComplex& complex, VertexId vertex,
                            const std::array<EdgeId, 2>& line, PointAdder& out) {
  std::vector<EdgeId> cross_edges;
  for (const EdgeId edge : complex.edges(vertex)) {
    if (edge != line[0] && edge != line[1]) {
      cross_edges.push_back(edge);
    }
  }
  std::vector<FaceId> line_faces;
  std::vector<FaceId> cross_faces;
  for (const FaceId face : complex.faces(vertex)) {
    const auto edges = complex.edges(face);
    const bool has_line = std::find(edges.begin(), edges.end(), line[0]) != edges.end() ||
                          std::find(edges.begin(), edges.end(), line[1]) != edges.end();
    (has_line ? line_faces : cross_faces).push_back(face);
  }
  const LineVertexMask mask = line_vertex_mask(static_cast<int>(cross_edges.size()));
  out.add_mean_of(complex.cells(vertex), mask.cells);
  out.add_mean_of(line_faces, mask.line_faces);
  out.add_mean_of(cross_faces, mask.cross_faces);
  out.add_mean_of(cross_edges, mask.cross_edges);
  out.add_mean_of(line, mask.line_edges);
  out.add(vertex, mask.vertex);
}

void fill_inner_vertex_point(const CellComplex& complex, VertexId vertex, Scheme scheme,
                             PointAdder& out) {
  if (scheme == Scheme::CatmullClark) {
    if (const auto line = line_edges(complex, vertex)) {
      fill_line_vertex_point(complex, vertex, *line, out);
      return;
    }
  }
  constexpr VertexPointMask kMask;
  out.add_mean_of(complex.cells(vertex), kMask.cells);
  out.add_mean_of(complex.faces(vertex), kMask.faces);
  out.add_mean_of(complex.edges(vertex), kMask.edges);
  out.add(vertex, kMask.vertex);
}

void fill_boundary_vertex_point(const CellComplex& complex, VertexId vertex,
                                const Sharpness& sharpness, PointAdder& out) {
  const std::vector<EdgeId> edges = boundary_only(complex, complex.edges(vertex));
  const std::vector<FaceId> faces = boundary_only(complex, complex.faces(vertex));
  std::vector<float> edge_sharpness(edges.size());
  std::transform(edges.begin(), edges.end(), edge_sharpness.begin(),
                 [&](EdgeId edge) { return sharpness.edges[edge]; });
  const osd::VertexMask mask =
      osd::vertex_mask(sharpness.vertices[vertex], edge_sharpness, faces.size());
  out.add(vertex, mask.vertex);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    out.add(complex.other_end(edges[i], vertex), mask.other_ends[i]);
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    out.add(faces[i], mask.face_centroids[i]);
  }
}

}  // namespace

std::optional<std::array<EdgeId, 2>> line_edges(const CellComplex& complex, VertexId vertex) {
  if (complex.is_boundary(vertex)) {
    return std::nullopt;
  }
  const auto edges = complex.edges(vertex);
  const std::size_t n = edges.size() - 2;
  if (n == 4 || complex.cells(vertex).size() != 2 * n || complex.faces(vertex).size() != 3 * n) {
    return std::nullopt;
  }
  std::array<EdgeId, 2> line;
  std::size_t n_line = 0;
  for (const EdgeId edge : edges) {
    const std::size_t n_faces = complex.half_faces(edge).size();
    if (n_faces == 4) {
      continue;
    }
    if (n_faces != n || n_line == 2) {
      return std::nullopt;
    }
    line[n_line++] = edge;
  }
  return n_line == 2 ? std::optional(line) : std::nullopt;
}

StencilTable refinement_stencils(const CellComplex& complex, const Sharpness& sharpness,
                                 Scheme scheme) {
  const std::size_t n_vertices = complex.n_vertices();
  const std::size_t n_edges = complex.n_edges();
  const std::size_t n_faces = complex.n_faces();
  const auto fill = [&](std::size_t i, StencilRow& row) {
    PointAdder out(complex, row);
    if (i < n_vertices) {
      const VertexId vertex{static_cast<std::int32_t>(i)};
      complex.is_boundary(vertex) ? fill_boundary_vertex_point(complex, vertex, sharpness, out)
                                  : fill_inner_vertex_point(complex, vertex, scheme, out);
    } else if (i < n_vertices + n_edges) {
      const EdgeId edge{static_cast<std::int32_t>(i - n_vertices)};
      complex.is_boundary(edge)
          ? fill_boundary_edge_point(complex, edge, sharpness.edges[edge], out)
          : fill_inner_edge_point(complex, edge, out);
    } else if (i < n_vertices + n_edges + n_faces) {
      fill_face_point(complex, FaceId{static_cast<std::int32_t>(i - n_vertices - n_edges)}, out);
    } else {
      out.add(CellId{static_cast<std::int32_t>(i - n_vertices - n_edges - n_faces)}, 1.0);
    }
  };
  return StencilTable::build(n_vertices + n_edges + n_faces + complex.n_cells(), n_vertices, fill);
}

}  // namespace espalier
