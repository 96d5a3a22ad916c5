/// Triangles and boxes by separating axes: T. Akenine-Möller, "Fast 3D triangle-box overlap
/// testing", 2001. Winding numbers as sums of solid angles, [JKS13]: A. Jacobson, L. Kavan and
/// O. Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding numbers",
/// 2013.

#include "deform/fit/surface_triangles.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace espalier {
namespace {

/// The lowest index of a point in the same place.
std::vector<std::int32_t> first_in_place(std::span<const glm::dvec3> points) {
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t i) {
    const glm::dvec3& p = points[static_cast<std::size_t>(i)];
    return std::array<double, 3>{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto ka = key(a);
    const auto kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::int32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] =
        is_same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

}  // namespace

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
    if (loop.size() == 3) {
      triangles.push_back({loop[0], loop[1], loop[2]});
    } else {
      append_face_triangles(loop, triangles);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_used[i] == 0) {
      triangles.push_back({points[i], points[i], points[i]});
    }
  }
  return triangles;
}

bool is_closed_surface(std::span<const glm::dvec3> points,
                       const CompressedRows<std::int32_t>& faces) {
  const std::vector<std::int32_t> first = first_in_place(points);
  std::vector<std::array<std::int32_t, 3>> edges;  // smaller end, larger, ±1 by direction
  edges.reserve(faces.n_values());
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto loop = faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = first[static_cast<std::size_t>(loop[i])];
      const std::int32_t b = first[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
      if (a != b) {
        edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::int32_t sum = 0;
    std::size_t end = i;
    for (; end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1];
         ++end) {
      sum += edges[end][2];
    }
    if (sum != 0) {
      return false;
    }
    i = end;
  }
  return !edges.empty();
}

double winding_number(std::span<const Triangle> triangles, const glm::dvec3& point) {
  double sum = 0;
  for (const Triangle& triangle : triangles) {
    sum += half_angle(point, triangle);
  }
  return sum / (2 * std::numbers::pi);
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
