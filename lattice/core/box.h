#pragma once

/// Axis-aligned boxes.

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace espalier {

/// Empty until a point is added.
struct Box {
  glm::dvec3 min = glm::dvec3(std::numeric_limits<double>::infinity());
  glm::dvec3 max = glm::dvec3(-std::numeric_limits<double>::infinity());

  [[nodiscard]] bool is_empty() const { return !(min.x <= max.x); }
  void add(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Box& box) {
    min = glm::min(min, box.min);
    max = glm::max(max, box.max);
  }
  /// Points with a coordinate that is not finite are left out.
  void add(std::span<const glm::dvec3> points) {
    for (const glm::dvec3& point : points) {
      if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z)) {
        add(point);
      }
    }
  }
  /// Middle; the origin for an empty box.
  [[nodiscard]] glm::dvec3 center() const {
    return is_empty() ? glm::dvec3(0) : 0.5 * min + 0.5 * max;
  }
  /// Half the diagonal; 0 for an empty box.
  [[nodiscard]] double radius() const {
    return is_empty() ? 0.0 : glm::length(0.5 * max - 0.5 * min);
  }
  /// The box with its sides moved outward by `margin`, inward if that is negative.
  [[nodiscard]] Box grown(double margin) const { return {min - margin, max + margin}; }
  /// Whether the closed boxes have a point in common; an inside-out box has none.
  [[nodiscard]] bool overlaps(const Box& box) const {
    return min.x <= box.max.x && box.min.x <= max.x && min.y <= box.max.y && box.min.y <= max.y &&
           min.z <= box.max.z && box.min.z <= max.z;
  }
  [[nodiscard]] bool contains(const glm::dvec3& point) const { return overlaps(Box{point, point}); }
};

/// The smallest box that holds the finite points among these.
[[nodiscard]] inline Box box_of(std::span<const glm::dvec3> points) {
  Box box;
  box.add(points);
  return box;
}

}  // namespace espalier
