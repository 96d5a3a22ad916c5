#include "deform/fit/node_check.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <map>
#include <utility>

#include "lattice/core/parallel.h"
#include "lattice/subdivision/hexahedra.h"
#include "lattice/subdivision/refine.h"
#include "lattice/subdivision/sub_complex.h"
#include "lattice/topology/sharpness.h"

namespace espalier {
namespace {

constexpr int kLevels = 8;                  // where freezing ends
constexpr double kLeastDeterminant = 1e-5;  // of the box of the edges

/// Of lattices that are grids there, and none of their corners is cut off.
bool is_plain(const CellComplex& complex, const Sharpness& sharpness, VertexId vertex) {
  const std::size_t n = complex.cells(vertex).size();
  return (n == 1 || n == 2 || n == 4) &&
         complex.edges(vertex).size() == 3 + std::bit_width(n - 1) &&
         std::ranges::none_of(complex.edges(vertex), [&](EdgeId edge) {
           return sharpness.edges[edge] > 0 && complex.n_cells(edge) > 1;
         });
}

std::size_t corner_of(const Frame& frame, VertexId vertex) {
  return static_cast<std::size_t>(std::find(frame.corners.begin(), frame.corners.end(), vertex) -
                                  frame.corners.begin());
}

/// The refined vertex in a cell, between one of its corners and another, that plays the other's
/// part in the child at the first.
VertexId refined_vertex(const CellComplex& complex, const ParentMap& parents, const Frame& frame,
                        VertexId at, VertexId other) {
  const std::size_t differing = corner_of(frame, at) ^ corner_of(frame, other);
  switch (std::popcount(differing)) {
    case 0:
      return parents.vertex_point(at);
    case 1:
      return parents.edge_point(complex.find_edge(at, other));
    case 2:
      for (const HalfFaceId side : complex.half_faces(frame.cell)) {
        const auto vertices = complex.vertices(side.face());
        if (std::find(vertices.begin(), vertices.end(), at) != vertices.end() &&
            std::find(vertices.begin(), vertices.end(), other) != vertices.end()) {
          return parents.face_point(side.face());
        }
      }
      return {};
    default:
      return parents.cell_point(frame.cell);
  }
}

/// What a rule depends on.
std::vector<std::int32_t> key_of(const CellComplex& fan, const Sharpness& sharpness,
                                 VertexId vertex) {
  const Hexahedra hexahedra(fan);
  std::vector<std::int32_t> key = {vertex.value, sharpness.vertices[vertex] > 0 ? 1 : 0};
  for (const EdgeId edge : fan.edges(vertex)) {
    if (sharpness.edges[edge] > 0) {
      key.push_back(fan.other_end(edge, vertex).value);
    }
  }
  for (const CellId cell : fan.cells()) {
    key.push_back(-1);
    for (const VertexId corner : hexahedra.frame(cell).corners) {
      key.push_back(corner.value);
    }
  }
  return key;
}

/// The smallest determinant at the corners of a trilinear cell, of the box of its edges there.
double least_determinant(const std::array<glm::dvec3, 8>& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dmat3 edges;
    double box = 1;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned low = corner & ~(1U << axis);
      edges[static_cast<int>(axis)] = corners[low | 1U << axis] - corners[low];
      box *= glm::length(edges[static_cast<int>(axis)]);
    }
    least = std::min(least, box > 0 ? glm::determinant(edges) / box : 0);
  }
  return least;
}

}  // namespace

NodeCheck::Rule NodeCheck::make_rule(const CellComplex& fan, const Sharpness& sharpness,
                                     Scheme scheme, VertexId vertex) {
  const Hexahedra hexahedra(fan);
  const Refinement refinement = refine(fan, sharpness, scheme);
  std::vector<VertexId> refined(fan.n_vertices());
  Rule rule;
  for (const CellId cell : fan.cells()) {
    const Frame frame = hexahedra.frame(cell);
    std::array<std::int32_t, 8>& corners = rule.cells.emplace_back();
    for (std::size_t c = 0; c < 8; ++c) {
      const VertexId corner = frame.corners[c];
      corners[c] = corner.value;
      refined[corner.index()] = refined_vertex(fan, refinement.parents, frame, vertex, corner);
    }
  }
  rule.step = rows_of(refinement.stencils, refined);
  return rule;
}

NodeCheck::NodeCheck(const SubdivisionLattice& lattice)
    : n_vertices_(lattice.complex->n_vertices()) {
  const CellComplex& complex = *lattice.complex;
  const Sharpness sharpness = with_touching_elements(complex, lattice.sharpness);
  std::map<std::vector<std::int32_t>, std::size_t> numbers;
  for (const VertexId vertex : complex.vertices()) {
    if (!complex.is_boundary(vertex) || is_plain(complex, sharpness, vertex)) {
      continue;
    }
    SubComplex fan = cut_out(complex, sharpness, complex.cells(vertex));
    const auto at = std::lower_bound(fan.vertices.begin(), fan.vertices.end(), vertex);
    const VertexId own{static_cast<std::int32_t>(at - fan.vertices.begin())};
    const auto [found, is_new] =
        numbers.emplace(key_of(fan.complex, fan.sharpness, own), rules_.size());
    if (is_new) {
      rules_.push_back(make_rule(fan.complex, fan.sharpness, lattice.scheme, own));
    }
    nodes_.push_back({vertex, found->second, std::move(fan.vertices)});
  }
}

bool NodeCheck::is_folded(const Node& node, std::span<const glm::dvec3> rest) const {
  const Rule& rule = rules_[node.rule];
  const glm::dvec3 origin = rest[node.vertex.index()];  // lest small cells drown in rounding
  std::vector<glm::dvec3> points;
  for (const VertexId vertex : node.around) {
    points.push_back(rest[vertex.index()] - origin);
  }
  for (int level = 1; level <= kLevels; ++level) {
    points = rule.step.apply(points);
    for (const std::array<std::int32_t, 8>& cell : rule.cells) {
      std::array<glm::dvec3, 8> corners;
      std::transform(cell.begin(), cell.end(), corners.begin(),
                     [&](std::int32_t point) { return points[static_cast<std::size_t>(point)]; });
      if (least_determinant(corners) < kLeastDeterminant) {
        return true;
      }
    }
  }
  return false;
}

std::vector<char> NodeCheck::folded(std::span<const glm::dvec3> rest) const {
  std::vector<char> result(n_vertices_, 0);
  parallel_for(
      nodes_.size(),
      [&](std::size_t i) { result[nodes_[i].vertex.index()] = is_folded(nodes_[i], rest) ? 1 : 0; },
      16);
  return result;
}

}  // namespace espalier
