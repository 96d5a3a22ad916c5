// Boxes, balls and cylinders round points; balls by the iteration of Bădoiu and Clarkson, Smaller
// core-sets for balls (2003), section 3.

#include "deform/fit/point_extent.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "lattice/core/error.h"
#include "lattice/tensor/oriented_box.h"

namespace espalier {
namespace {

/// Steps after which the radius is within 1 % of the smallest.
constexpr int kBallSteps = 400;

}  // namespace

double extent_of(std::span<const glm::dvec3> points) {
  if (points.empty()) {
    throw ParameterError("there are no points to fit to");
  }
  const double diagonal = 2 * box_of(points).radius();
  if (!(diagonal > 0)) {
    throw ParameterError("the points to fit to are all in one place");
  }
  return diagonal;
}

glm::dmat3 sorted_axes(std::span<const glm::dvec3> points, bool is_principal) {
  const OrientedBox box = is_principal ? fitted_principal_box(points, 0) : fitted_box(points, 0);
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return box.half_sizes[a] > box.half_sizes[b]; });
  glm::dmat3 axes(box.axes[order[0]], box.axes[order[1]], box.axes[order[2]]);
  if (glm::determinant(axes) < 0) {
    axes[1] = -axes[1];
  }
  return axes;
}

Interval interval_along(std::span<const glm::dvec3> points, const glm::dvec3& axis, double margin) {
  Interval interval = {std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()};
  for (const glm::dvec3& point : points) {
    const double s = glm::dot(point, axis);
    interval.low = std::min(interval.low, s);
    interval.high = std::max(interval.high, s);
  }
  const double half =
      std::max((interval.high - interval.low) / 2 + margin, kThinnestFit * extent_of(points) / 2);
  return {interval.middle() - half, interval.middle() + half};
}

Ball enclosing_ball(std::span<const glm::dvec3> points) {
  const double thinnest = kThinnestFit * extent_of(points) / 2;
  const auto farthest_from = [&](const glm::dvec3& center) {
    return *std::max_element(
        points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
          return glm::dot(a - center, a - center) < glm::dot(b - center, b - center);
        });
  };
  glm::dvec3 center = box_of(points).center();
  glm::dvec3 farthest = farthest_from(center);
  Ball best = {center, glm::distance(center, farthest)};
  for (int step = 1; step <= kBallSteps; ++step) {
    center += (farthest - center) / (step + 1.0);
    farthest = farthest_from(center);
    if (glm::distance(center, farthest) < best.radius) {
      best = {center, glm::distance(center, farthest)};
    }
  }
  return {best.center, std::max(best.radius, thinnest)};
}

Ball enclosing_circle(std::span<const glm::dvec3> points, const glm::dvec3& axis) {
  std::vector<glm::dvec3> flat;
  flat.reserve(points.size());
  for (const glm::dvec3& point : points) {
    flat.push_back(point - axis * glm::dot(point, axis));
  }
  const double thinnest = kThinnestFit * extent_of(points) / 2;
  if (!(box_of(flat).radius() > thinnest)) {
    return {box_of(flat).center(), thinnest};
  }
  const Ball circle = enclosing_ball(flat);
  return {circle.center, std::max(circle.radius, thinnest)};
}

}  // namespace espalier
