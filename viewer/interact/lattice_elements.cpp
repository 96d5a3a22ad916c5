#include "viewer/interact/lattice_elements.h"

#include <algorithm>

#include "lattice/topology/face_triangles.h"
#include "viewer/interact/grid_elements.h"

namespace espalier::viewer {
namespace {

template <class Ids>
std::vector<std::int32_t> values_of(const Ids& ids) {
  std::vector<std::int32_t> values;
  for (const auto id : ids) {
    values.push_back(id.value);
  }
  return values;
}

std::vector<std::int32_t> faces_of(std::span<const HalfFaceId> half_faces) {
  std::vector<std::int32_t> faces;
  for (const HalfFaceId half_face : half_faces) {
    faces.push_back(half_face.face().value);
  }
  return faces;
}

bool share_a_value(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  return std::any_of(a.begin(), a.end(), [&](std::int32_t value) {
    return std::find(b.begin(), b.end(), value) != b.end();
  });
}

/// The edge that goes straight on at an end of `edge`; -1 if none does, or several.
std::int32_t next_edge(const LatticeElements& lattice, std::int32_t edge, std::int32_t end) {
  std::int32_t next = -1;
  for (std::size_t other = 0; other < lattice.edges.n_rows(); ++other) {
    const auto ends = lattice.edges[other];
    const bool is_candidate = static_cast<std::int32_t>(other) != edge &&
                              (ends[0] == end || ends[1] == end) &&
                              !share_a_value(lattice.edge_faces[static_cast<std::size_t>(edge)],
                                             lattice.edge_faces[other]);
    if (is_candidate && next >= 0) {
      return -1;
    }
    next = is_candidate ? static_cast<std::int32_t>(other) : next;
  }
  return next;
}

LatticeElements subdivision_elements(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  LatticeElements elements;
  elements.n_vertices = static_cast<std::int32_t>(complex.n_vertices());
  elements.levels.assign(complex.n_vertices(), 0);
  for (const EdgeId edge : complex.edges()) {
    elements.edges.push_back(values_of(complex.vertices(edge)));
    elements.edge_faces.push_back(faces_of(complex.half_faces(edge)));
  }
  for (const FaceId face : complex.faces()) {
    elements.faces.push_back(values_of(complex.vertices(face)));
    elements.is_outer.push_back(complex.is_boundary(face));
  }
  for (const CellId cell : complex.cells()) {
    elements.cells.push_back(values_of(complex.vertices(cell)));
    elements.cell_faces.push_back(faces_of(complex.half_faces(cell)));
  }
  elements.edge_sharpness = lattice.sharpness.edges.values();
  elements.vertex_sharpness = lattice.sharpness.vertices.values();
  return elements;
}

}  // namespace

std::size_t LatticeElements::count(ElementKind kind) const {
  switch (kind) {
    case ElementKind::Vertex:
      return static_cast<std::size_t>(n_vertices);
    case ElementKind::Edge:
      return edges.n_rows();
    case ElementKind::Face:
      return faces.n_rows();
    default:
      return cells.n_rows();
  }
}

std::vector<std::int32_t> LatticeElements::vertices(ElementKind kind, std::int32_t element) const {
  if (kind == ElementKind::Vertex) {
    return {element};
  }
  const auto& rows = kind == ElementKind::Edge ? edges : kind == ElementKind::Face ? faces : cells;
  const auto row = rows[static_cast<std::size_t>(element)];
  return {row.begin(), row.end()};
}

Selection LatticeElements::vertices(ElementKind kind, const Selection& elements) const {
  Selection all;
  for (const std::int32_t element : elements) {
    const std::vector<std::int32_t> some = vertices(kind, element);
    all.insert(some.begin(), some.end());
  }
  return all;
}

Selection LatticeElements::within(ElementKind kind, const Selection& chosen) const {
  Selection elements;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(count(kind)); ++i) {
    const std::vector<std::int32_t> needed = vertices(kind, i);
    if (std::all_of(needed.begin(), needed.end(),
                    [&](std::int32_t vertex) { return chosen.contains(vertex); })) {
      elements.insert(i);
    }
  }
  return elements;
}

Selection LatticeElements::connected(ElementKind kind, const Selection& elements) const {
  Selection reached = vertices(kind, elements);
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (std::size_t i = 0; i < edges.n_rows(); ++i) {
      if (reached.contains(edges[i][0]) || reached.contains(edges[i][1])) {
        reached.insert(edges[i].begin(), edges[i].end());
      }
    }
  }
  return within(kind, reached);
}

Selection LatticeElements::loop(std::int32_t edge) const {
  Selection loop = {edge};
  for (const std::int32_t start : vertices(ElementKind::Edge, edge)) {
    std::int32_t end = start;
    std::int32_t next = next_edge(*this, edge, end);
    while (next >= 0 && loop.insert(next).second) {
      const auto ends = edges[static_cast<std::size_t>(next)];
      end = ends[0] == end ? ends[1] : ends[0];
      next = next_edge(*this, next, end);
    }
  }
  return loop;
}

std::vector<bool> LatticeElements::outer_edges() const {
  std::vector<bool> is_outer_edge;
  for (std::size_t edge = 0; edge < edges.n_rows(); ++edge) {
    const auto at_edge = edge_faces[edge];
    is_outer_edge.push_back(at_edge.empty() ||
                            std::any_of(at_edge.begin(), at_edge.end(), [&](std::int32_t face) {
                              return is_outer[static_cast<std::size_t>(face)];
                            }));
  }
  return is_outer_edge;
}

bool LatticeElements::is_same_net(const LatticeElements& other) const {
  const auto is_equal = [](const auto& a, const auto& b) {
    return a.n_rows() == b.n_rows() && std::ranges::equal(a.values(), b.values());
  };
  return n_vertices == other.n_vertices && is_equal(edges, other.edges) &&
         is_equal(faces, other.faces) && is_equal(cells, other.cells);
}

LatticeElements elements_of(const Lattice& lattice) {
  const auto* subdivision = lattice.as<SubdivisionLattice>();
  if (subdivision != nullptr) {
    return subdivision_elements(*subdivision);
  }
  const auto* tensor = lattice.as<TensorLattice>();
  return tensor != nullptr ? grid_elements(*tensor) : grid_elements(*lattice.as<ThbLattice>());
}

bool is_same(const Lattice& a, const Lattice& b) {
  const auto address = [](const Lattice& lattice) {
    return lattice.visit([](const auto& held) -> const void* { return &held; });
  };
  return address(a) == address(b);
}

std::span<const glm::dvec3> points_of(const Scene& scene, const std::string& lattice, Shape shape) {
  const Lattice& found = lattice_in(scene, lattice);
  return shape == Shape::Rest ? found.rest_points() : found.posed_points();
}

glm::dvec3 outward_area(const Scene& scene, const std::string& lattice, std::int32_t face,
                        std::span<const glm::dvec3> points) {
  const CellComplex& complex = *subdivision_lattice_in(scene, lattice, "growing cells").complex;
  std::vector<glm::dvec3> loop;
  for (const VertexId vertex : complex.vertices(FaceId{face})) {
    loop.push_back(points[vertex.index()]);
  }
  const double sign = complex.inner_half_face(FaceId{face}).side() == 0 ? 0.5 : -0.5;
  return sign * area_vector(loop);
}

}  // namespace espalier::viewer
