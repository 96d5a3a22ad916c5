#include "viewer/interact/pivot.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

namespace espalier::viewer {
namespace {

/// Sets of vertices, each named by its smallest member.
class VertexSets {
 public:
  explicit VertexSets(const Selection& vertices) {
    for (const std::int32_t vertex : vertices) {
      parents_[vertex] = vertex;
    }
  }
  [[nodiscard]] std::int32_t find(std::int32_t vertex) const {
    while (parents_.at(vertex) != vertex) {
      vertex = parents_.at(vertex);
    }
    return vertex;
  }
  void unite(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::map<std::int32_t, std::int32_t> parents_;
};

}  // namespace

std::vector<Selection> islands(const LatticeElements& elements, ElementKind kind,
                               const Selection& chosen) {
  const Selection vertices = elements.vertices(kind, chosen);
  VertexSets sets(vertices);
  const ElementKind link = kind == ElementKind::Vertex ? ElementKind::Edge : kind;
  const Selection links = kind == ElementKind::Vertex ? elements.within(link, vertices) : chosen;
  for (const std::int32_t element : links) {
    const std::vector<std::int32_t> joined = elements.vertices(link, element);
    for (const std::int32_t vertex : joined) {
      sets.unite(joined.front(), vertex);
    }
  }
  std::map<std::int32_t, Selection> by_first;
  for (const std::int32_t vertex : vertices) {
    by_first[sets.find(vertex)].insert(vertex);
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
    const glm::dvec3 middle = middle_of(points, island);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const std::int32_t vertex : island) {
        const double distance = glm::distance(points[i], points[static_cast<std::size_t>(vertex)]);
        const bool is_member = static_cast<std::size_t>(vertex) == i;
        if (is_member || distance < nearest[i]) {
          nearest[i] = is_member ? -1 : distance;
          pivots[i] = middle;
        }
      }
    }
  }
  return pivots;
}

}  // namespace espalier::viewer
