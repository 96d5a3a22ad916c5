#include "lattice/subdivision/sub_complex.h"

#include <algorithm>
#include <utility>

namespace espalier {
namespace {

template <class Id>
std::int32_t position(const std::vector<Id>& sorted, Id id) {
  return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), id) -
                                   sorted.begin());
}

template <class Id>
void make_unique(std::vector<Id>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

SubComplex cut_out(const CellComplex& complex, const Sharpness& sharpness,
                   std::span<const CellId> cells) {
  SubComplex sub;
  sub.cells.assign(cells.begin(), cells.end());
  std::vector<FaceId> faces;
  for (const CellId cell : cells) {
    const auto vertices = complex.vertices(cell);
    sub.vertices.insert(sub.vertices.end(), vertices.begin(), vertices.end());
    for (const HalfFaceId side : complex.half_faces(cell)) {
      faces.push_back(side.face());
    }
  }
  make_unique(sub.vertices);
  make_unique(faces);
  Polyhedra tables{static_cast<std::int32_t>(sub.vertices.size()), {}, {}};
  std::vector<std::int32_t> row;
  for (const FaceId face : faces) {
    row.clear();
    for (const VertexId vertex : complex.vertices(face)) {
      row.push_back(position(sub.vertices, vertex));
    }
    tables.faces.push_back(row);
  }
  for (const CellId cell : cells) {
    row.clear();
    for (const HalfFaceId side : complex.half_faces(cell)) {
      row.push_back(2 * position(faces, side.face()) + side.side());
    }
    tables.cells.push_back(row);
  }
  sub.complex = CellComplex::from_valid(std::move(tables));
  sub.sharpness = smooth_sharpness(sub.complex);
  for (const EdgeId edge : sub.complex.edges()) {
    const auto& ends = sub.complex.vertices(edge);
    sub.sharpness.edges[edge] =
        sharpness
            .edges[complex.find_edge(sub.vertices[ends[0].index()], sub.vertices[ends[1].index()])];
  }
  for (const VertexId vertex : sub.complex.vertices()) {
    sub.sharpness.vertices[vertex] = sharpness.vertices[sub.vertices[vertex.index()]];
  }
  sub.sharpness = with_touching_elements(sub.complex, std::move(sub.sharpness));
  return sub;
}

StencilTable rows_of(const StencilTable& table, std::span<const VertexId> vertices) {
  return StencilTable::build(vertices.size(), table.n_controls(),
                             [&](std::size_t i, StencilRow& row) {
                               const StencilTable::Row source = table[vertices[i].index()];
                               for (std::size_t k = 0; k < source.indices.size(); ++k) {
                                 row.add(source.indices[k], source.weights[k]);
                               }
                             });
}

std::vector<CellId> with_neighbours(const CellComplex& complex, std::span<const CellId> cells) {
  std::vector<CellId> result(cells.begin(), cells.end());
  std::vector<CellId> taken = result;
  std::sort(taken.begin(), taken.end());
  std::vector<CellId> around;
  for (const CellId cell : cells) {
    for (const VertexId vertex : complex.vertices(cell)) {
      const auto at_vertex = complex.cells(vertex);
      around.insert(around.end(), at_vertex.begin(), at_vertex.end());
    }
  }
  make_unique(around);
  std::set_difference(around.begin(), around.end(), taken.begin(), taken.end(),
                      std::back_inserter(result));
  return result;
}

}  // namespace espalier
