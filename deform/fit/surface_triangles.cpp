/// Triangles and boxes by separating axes, T. Akenine-Möller, "Fast 3D triangle-box overlap
/// testing", 2001.

#include "deform/fit/surface_triangles.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace espalier {

std::vector<Triangle> surface_triangles(std::span<const glm::dvec3> points,
                                        const CompressedRows<std::int32_t>& faces) {
  std::vector<Triangle> triangles;
  triangles.reserve(faces.n_values());
  std::vector<char> is_used(points.size(), 0);
  std::vector<glm::dvec3> loop;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    loop.clear();
    for (const std::int32_t point : faces[face]) {
      loop.push_back(points[static_cast<std::size_t>(point)]);
      is_used[static_cast<std::size_t>(point)] = 1;
    }
    append_face_triangles(loop, triangles);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_used[i] == 0) {
      triangles.push_back({points[i], points[i], points[i]});
    }
  }
  return triangles;
}

bool overlaps(const Triangle& triangle, const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 centre = 0.5 * low + 0.5 * high;
  const glm::dvec3 half = 0.5 * high - 0.5 * low;
  const Triangle t = {triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const auto is_apart = [&](const glm::dvec3& axis) {
    const double a = glm::dot(axis, t[0]);
    const double b = glm::dot(axis, t[1]);
    const double c = glm::dot(axis, t[2]);
    const double reach = glm::dot(glm::abs(axis), half);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (std::min({t[0][axis], t[1][axis], t[2][axis]}) > half[axis] ||
        std::max({t[0][axis], t[1][axis], t[2][axis]}) < -half[axis]) {
      return false;
    }
  }
  const std::array<glm::dvec3, 3> edges = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  for (const glm::dvec3& e : edges) {
    if (is_apart({0, -e.z, e.y}) || is_apart({e.z, 0, -e.x}) || is_apart({-e.y, e.x, 0})) {
      return false;
    }
  }
  return !is_apart(glm::cross(edges[0], edges[1]));
}

}  // namespace espalier
