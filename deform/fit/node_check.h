#pragma once

/// Whether a lattice keeps its orientation at its boundary's vertices however finely it is refined.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// Looks at the cells round boundary vertices, refined again and again. Two refinements do not tell
/// what becomes of them: later the slower eigenvectors of refinement take over, and cells that were
/// sound may fold. The vertices and cells round one depend on their like a level before only, by
/// the same rule on every level. Made once for a lattice's cells and sharpness, O(#vertices); then
/// a shape of it costs some microseconds a vertex.
class NodeCheck {
 public:
  /// Of lattices of hexahedra without finite sharpness.
  explicit NodeCheck(const SubdivisionLattice& lattice);

  /// Of each vertex: whether refined cells at it are folded or as good as that. rest: #vertices.
  [[nodiscard]] std::vector<char> folded(std::span<const glm::dvec3> rest) const;

 private:
  /// What refinement does round vertices that have like cells and like sharp edges.
  struct Rule {
    StencilTable step;                               // vertices round it over those a level before
    std::vector<std::array<std::int32_t, 8>> cells;  // corners, as in index_order.h
  };
  struct Node {
    VertexId vertex;
    std::size_t rule;
    std::vector<VertexId> around;  // the vertices of its cells
  };

  [[nodiscard]] static Rule make_rule(const CellComplex& fan, const Sharpness& sharpness,
                                      Scheme scheme, VertexId vertex);
  [[nodiscard]] bool is_folded(const Node& node, std::span<const glm::dvec3> rest) const;

  std::size_t n_vertices_;
  std::vector<Rule> rules_;
  std::vector<Node> nodes_;
};

}  // namespace espalier
