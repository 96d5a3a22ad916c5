#include "viewer/interact/pivot.h"

#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "lattice/core/disjoint_sets.h"

namespace espalier::viewer {

std::vector<Selection> islands(const LatticeElements& elements, ElementKind kind,
                               const Selection& chosen) {
  const Selection vertices = elements.vertices(kind, chosen);
  DisjointSets sets(vertices.empty() ? 0 : static_cast<std::size_t>(*vertices.rbegin()) + 1);
  const ElementKind link = kind == ElementKind::Vertex ? ElementKind::Edge : kind;
  const Selection links = kind == ElementKind::Vertex ? elements.within(link, vertices) : chosen;
  for (const std::int32_t element : links) {
    const std::vector<std::int32_t> joined = elements.vertices(link, element);
    for (const std::int32_t vertex : joined) {
      sets.join(static_cast<std::size_t>(joined.front()), static_cast<std::size_t>(vertex));
    }
  }
  std::map<std::size_t, Selection> by_first;
  for (const std::int32_t vertex : vertices) {
    by_first[sets.first(static_cast<std::size_t>(vertex))].insert(vertex);
  }
  std::vector<Selection> result;
  result.reserve(by_first.size());
  for (auto& [first, island] : by_first) {
    result.push_back(std::move(island));
  }
  return result;
}

glm::dvec3 middle_of(std::span<const glm::dvec3> points, const Selection& some) {
  glm::dvec3 middle(0.0);
  for (const std::int32_t i : some) {
    middle += points[static_cast<std::size_t>(i)] / double(some.size());
  }
  return middle;
}

std::vector<glm::dvec3> island_pivots(std::span<const glm::dvec3> points,
                                      const std::vector<Selection>& islands) {
  std::vector<glm::dvec3> pivots(points.size());
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
  for (const Selection& island : islands) {
    for (const std::int32_t vertex : island) {
      nearest[static_cast<std::size_t>(vertex)] = 0;  // no other is nearer
    }
  }
  for (const Selection& island : islands) {
    const glm::dvec3 middle = middle_of(points, island);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (auto vertex = island.begin(); nearest[i] > 0 && vertex != island.end(); ++vertex) {
        const double distance = glm::distance(points[i], points[static_cast<std::size_t>(*vertex)]);
        if (distance < nearest[i]) {
          nearest[i] = distance;
          pivots[i] = middle;
        }
      }
    }
    for (const std::int32_t vertex : island) {
      pivots[static_cast<std::size_t>(vertex)] = middle;
    }
  }
  return pivots;
}

}  // namespace espalier::viewer
