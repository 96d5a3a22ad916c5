#include "lattice/topology/corner_check.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "lattice/core/parallel.h"
#include "lattice/topology/hexahedron.h"

namespace espalier {
namespace {

/// A corner of a face, as its cell sees it from outside.
struct FaceCorner {
  VertexId vertex;
  VertexId next;
  VertexId previous;
  auto operator<=>(const FaceCorner&) const = default;
};

std::vector<FaceCorner> face_corners(const CellComplex& complex, CellId cell) {
  std::vector<FaceCorner> corners;
  for (const HalfFaceId side : complex.half_faces(cell)) {
    const std::vector<VertexId> around = loop(complex, side);
    const std::size_t n = around.size();
    for (std::size_t i = 0; i < n; ++i) {
      corners.push_back({around[i], around[(i + 1) % n], around[(i + n - 1) % n]});
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

bool is_inverted_at_corner(const CellComplex& complex, std::span<const glm::dvec3> points,
                           CellId cell) {
  const std::vector<FaceCorner> corners = face_corners(complex, cell);
  const auto at = [&](VertexId vertex) { return points[vertex.index()]; };
  for (std::size_t i = 0, end = 0; i < corners.size(); i = end) {
    while (end < corners.size() && corners[end].vertex == corners[i].vertex) {
      ++end;
    }
    if (end - i != 3) {
      continue;
    }
    // The third edge is the one that the first face does not have.
    const FaceCorner& face = corners[i];
    const FaceCorner& other = corners[i + 1];
    const VertexId third =
        other.next == face.next || other.next == face.previous ? other.previous : other.next;
    const glm::dvec3 origin = at(face.vertex);
    if (!(glm::dot(glm::cross(at(face.previous) - origin, at(face.next) - origin),
                   at(third) - origin) > 0)) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::size_t count_cells_inverted_at_corners(const CellComplex& complex,
                                            std::span<const glm::dvec3> points) {
  std::vector<char> is_inverted(complex.n_cells());
  parallel_for(is_inverted.size(), [&](std::size_t i) {
    is_inverted[i] =
        is_inverted_at_corner(complex, points, CellId{static_cast<std::int32_t>(i)}) ? 1 : 0;
  });
  return static_cast<std::size_t>(std::count(is_inverted.begin(), is_inverted.end(), 1));
}

}  // namespace espalier
