#include "lattice/build/hull.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "lattice/build/offsets.h"
#include "lattice/core/box.h"

namespace espalier {
namespace {

constexpr double kFlat = 1e-9;

/// The corners of the convex polygon that points of one plane span, counter-clockwise about
/// `normal`, starting with the smallest (gift wrapping).
VertexLoop wrap(std::span<const glm::dvec3> points, const VertexLoop& flat,
                const glm::dvec3& normal, double tolerance) {
  const auto at = [&](std::int32_t vertex) { return points[static_cast<std::size_t>(vertex)]; };
  // The farthest from the first point is a corner.
  const std::int32_t start =
      *std::max_element(flat.begin(), flat.end(), [&](std::int32_t a, std::int32_t b) {
        return glm::distance(at(a), at(flat[0])) < glm::distance(at(b), at(flat[0]));
      });
  VertexLoop loop;
  std::int32_t corner = start;
  do {
    loop.push_back(corner);
    std::int32_t next = -1;
    for (const std::int32_t other : flat) {
      if (other == corner) {
        continue;
      }
      if (next < 0) {
        next = other;
        continue;
      }
      const glm::dvec3 along = unit_vector(at(next) - at(corner));
      const double right = glm::dot(glm::cross(along, at(other) - at(corner)), normal);
      const bool is_beyond =
          std::abs(right) <= tolerance &&
          glm::distance(at(other), at(corner)) > glm::distance(at(next), at(corner));
      if (right < -tolerance || is_beyond) {
        next = other;
      }
    }
    corner = next;
  } while (corner != start && loop.size() < flat.size());
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

/// The points of the plane through three if all others are on its inner side; else none.
VertexLoop supporting_points(std::span<const glm::dvec3> points,
                             std::span<const std::int32_t> chosen, const glm::dvec3& origin,
                             const glm::dvec3& normal, double tolerance) {
  VertexLoop flat;
  for (const std::int32_t vertex : chosen) {
    const double height = glm::dot(points[static_cast<std::size_t>(vertex)] - origin, normal);
    if (height > tolerance) {
      return {};
    }
    if (height >= -tolerance) {
      flat.push_back(vertex);
    }
  }
  return flat.size() < chosen.size() ? flat : VertexLoop{};
}

}  // namespace

std::vector<VertexLoop> convex_hull(std::span<const glm::dvec3> points,
                                    std::span<const std::int32_t> chosen) {
  Box box;
  for (const std::int32_t vertex : chosen) {
    box.add(points[static_cast<std::size_t>(vertex)]);
  }
  const double tolerance = kFlat * box.radius();
  const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(chosen[i])]; };
  std::vector<VertexLoop> hull;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = i + 1; j < chosen.size(); ++j) {
      const glm::dvec3 along = unit_vector(at(j) - at(i));
      for (std::size_t k = i + 1; k < chosen.size(); ++k) {
        const glm::dvec3 across = glm::cross(along, at(k) - at(i));
        if (k == j || glm::length(across) <= tolerance) {
          continue;
        }
        const glm::dvec3 normal = unit_vector(across);
        const VertexLoop flat = supporting_points(points, chosen, at(i), normal, tolerance);
        if (!flat.empty()) {
          VertexLoop loop = wrap(points, flat, normal, tolerance);
          if (std::find(hull.begin(), hull.end(), loop) == hull.end()) {
            hull.push_back(std::move(loop));
          }
        }
      }
    }
  }
  return hull;
}

}  // namespace espalier
