#pragma once

/// How far points reach: what ready-made lattices are laid round.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace espalier {

/// Points have no thickness below this fraction of their diagonal: so flat things get a volume.
inline constexpr double kThinnestFit = 1e-3;

/// Length of the diagonal of the points' axis-aligned box. Throws ParameterError if there are no
/// points, or all are in one place.
[[nodiscard]] double extent_of(std::span<const glm::dvec3> points);

/// The directions of the sides of the points' box, along the coordinate axes or the principal ones:
/// from the longest side to the shortest, unit, right-handed.
[[nodiscard]] glm::dmat3 sorted_axes(std::span<const glm::dvec3> points, bool is_principal);

/// Where points lie along a unit vector.
struct Interval {
  double low = 0;
  double high = 0;
  [[nodiscard]] double middle() const { return 0.5 * low + 0.5 * high; }
};

/// With `margin` more at either end; not shorter than kThinnestFit of the points' diagonal.
[[nodiscard]] Interval interval_along(std::span<const glm::dvec3> points, const glm::dvec3& axis,
                                      double margin);

struct Ball {
  glm::dvec3 center{0};
  double radius = 0;
};

/// A ball that holds the points, with a radius at most 1 % above the smallest; not thinner than
/// kThinnestFit of the points' diagonal.
[[nodiscard]] Ball enclosing_ball(std::span<const glm::dvec3> points);

/// The same of the points seen along a unit vector: a cylinder. The centre is the axis's point
/// closest to the origin.
[[nodiscard]] Ball enclosing_circle(std::span<const glm::dvec3> points, const glm::dvec3& axis);

}  // namespace espalier
