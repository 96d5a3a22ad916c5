#pragma once

/// Finding the vertex that a refinement puts at an element, by the element's vertices.

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "lattice/subdivision/refine.h"

namespace espalier::test {

/// The refined vertex that stands for the element with exactly these vertices (a vertex, an edge, a
/// face or a cell), if there is one.
inline std::optional<VertexId> refined_point(const CellComplex& complex, const ParentMap& parents,
                                             const std::vector<VertexId>& vertices) {
  const std::set<VertexId> wanted(vertices.begin(), vertices.end());
  const auto is_it = [&](const auto& found) {
    return std::set<VertexId>(found.begin(), found.end()) == wanted;
  };
  if (vertices.size() == 1) {
    return parents.vertex_point(vertices[0]);
  }
  for (const EdgeId edge : complex.edges(vertices[0])) {
    if (is_it(complex.vertices(edge))) {
      return parents.edge_point(edge);
    }
  }
  for (const FaceId face : complex.faces(vertices[0])) {
    if (is_it(complex.vertices(face))) {
      return parents.face_point(face);
    }
  }
  for (const CellId cell : complex.cells(vertices[0])) {
    if (is_it(complex.vertices(cell))) {
      return parents.cell_point(cell);
    }
  }
  return std::nullopt;
}

}  // namespace espalier::test
