#include "deform/fit/fitted_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "deform/fit/point_extent.h"
#include "lattice/build/offsets.h"
#include "lattice/build/section.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Points = std::span<const glm::dvec3>;

/// The coordinate axis asked for, else the column of sorted_axes().
glm::dvec3 axis_of(Points points, const FitOptions& fit, int column) {
  if (fit.along >= 0) {
    glm::dvec3 axis(0);
    axis[fit.along] = 1;
    return axis;
  }
  return sorted_axes(points, fit.is_principal)[column];
}

/// Distances of points from an axis through a centre.
struct Distances {
  double least = 0;
  double most = 0;
};

Distances distances_from(Points points, const glm::dvec3& center, const glm::dvec3& axis) {
  Distances distances = {std::numeric_limits<double>::infinity(), 0};
  for (const glm::dvec3& point : points) {
    const glm::dvec3 offset = point - center;
    const double distance = glm::length(offset - axis * glm::dot(offset, axis));
    distances.least = std::min(distances.least, distance);
    distances.most = std::max(distances.most, distance);
  }
  return distances;
}

/// Sets the ends and the radius of a bar of any kind.
template <class Bar>
Bar laid_along(Bar bar, Points points, const glm::dvec3& axis, double margin) {
  const Interval along = interval_along(points, axis, margin);
  const Ball circle = enclosing_circle(points, axis);
  bar.from = circle.center + axis * along.low;
  bar.to = circle.center + axis * along.high;
  bar.radius = circle.radius + margin;
  return bar;
}

/// Of a barbell in its own plane, disks at ±center.
struct BarbellPlan {
  double center = 0;
  double radius = 0;
  double bar_radius = 0;
};

/// The least barbell with disks at ±center that holds points of the plane; nothing if the disks
/// would touch. points: x along the bar.
std::optional<BarbellPlan> barbell_at(double center, const std::vector<glm::dvec3>& points,
                                      double margin) {
  constexpr double kWidestBar = 0.65;  // of the disks' radius
  constexpr int kTries = 8;
  const auto to_disk = [&](const glm::dvec3& p) { return std::hypot(std::abs(p.x) - center, p.y); };
  BarbellPlan plan = {center, 0, 0};
  for (const glm::dvec3& p : points) {
    if (std::abs(p.x) >= center) {
      plan.radius = std::max(plan.radius, to_disk(p) + margin);
    }
  }
  for (int i = 0; i < kTries; ++i) {
    plan.bar_radius = 0;
    for (const glm::dvec3& p : points) {
      if (to_disk(p) + margin > plan.radius) {
        plan.bar_radius = std::max(plan.bar_radius, std::abs(p.y) + margin);
      }
    }
    plan.radius = std::max(plan.radius, plan.bar_radius / kWidestBar);
  }
  plan.bar_radius = std::max(plan.bar_radius, plan.radius / 10);
  const bool is_apart = plan.radius < 0.95 * center;
  return is_apart && plan.bar_radius <= kWidestBar * plan.radius * (1 + 1e-9) ? std::optional(plan)
                                                                              : std::nullopt;
}

/// The radius that arms from a centre need to hold the points.
double arm_radius(Points points, const glm::dvec3& center, const std::vector<glm::dvec3>& along) {
  double radius = 0;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 offset = point - center;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& arm : along) {
      const double t = std::max(0.0, glm::dot(offset, arm));
      nearest = std::min(nearest, glm::distance(offset, arm * t));
    }
    radius = std::max(radius, nearest);
  }
  return radius;
}

/// The centre in the box's middle plane with the thinnest arms, by ever finer grids.
glm::dvec3 best_center(Points points, const std::vector<glm::dvec3>& along) {
  constexpr int kSteps = 6;  // to either side
  constexpr int kGrids = 4;
  const Box box = box_of(points);
  const glm::dvec3 right = along[0];
  const glm::dvec3 up = unit_vector(along[1] - right * glm::dot(along[1], right));
  glm::dvec3 best = box.center();
  double least = arm_radius(points, best, along);
  double step = box.radius() / kSteps;
  for (int grid = 0; grid < kGrids; ++grid, step /= kSteps / 2.0) {
    const glm::dvec3 middle = best;
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        const glm::dvec3 center = middle + step * (right * double(i) + up * double(j));
        const double radius = arm_radius(points, center, along);
        if (radius < least) {
          least = radius;
          best = center;
        }
      }
    }
  }
  return best;
}

}  // namespace

OrientedBox fitted_box_of(Points points, const FitOptions& fit, double margin) {
  const OrientedBox box =
      fit.is_principal ? fitted_principal_box(points, 0) : fitted_box(points, 0);
  return {box.center, box.axes, box.half_sizes + margin};
}

CellMesh fitted_box_grid(const std::array<int, 3>& cells, Points points, const FitOptions& fit,
                         double margin) {
  const OrientedBox box = fitted_box_of(points, fit, margin);
  CellMesh mesh = make_box(cells, glm::dvec3(-1), glm::dvec3(1));
  for (glm::dvec3& point : mesh.points) {
    point = box.at(point);
  }
  return mesh;
}

CylinderOptions fitted(CylinderOptions options, Points points, const FitOptions& fit,
                       double margin) {
  return laid_along(options, points, axis_of(points, fit, 0), margin);
}

OGridOptions fitted(OGridOptions options, Points points, const FitOptions& fit, double margin) {
  return laid_along(options, points, axis_of(points, fit, 0), margin);
}

AnnulusOptions fitted(AnnulusOptions options, Points points, const FitOptions& fit, double margin) {
  const glm::dvec3 axis = axis_of(points, fit, 2);
  options = laid_along(options, points, axis, margin);
  options.inner_radius = distances_from(points, options.from, axis).least - margin;
  if (!(options.inner_radius > 0)) {
    throw ParameterError("annulus: the points leave no hole along this axis");
  }
  return options;
}

TorusOptions fitted(TorusOptions options, Points points, const FitOptions& fit, double margin) {
  options.axis = axis_of(points, fit, 2);
  const double height = interval_along(points, options.axis, 0).middle();
  options.center = enclosing_circle(points, options.axis).center + options.axis * height;
  const Distances distances = distances_from(points, options.center, options.axis);
  options.radius = (distances.least + distances.most) / 2;
  double farthest = kThinnestFit * extent_of(points) / 2;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 offset = point - options.center;
    const double up = glm::dot(offset, options.axis);
    const double out = glm::length(offset - options.axis * up) - options.radius;
    farthest = std::max(farthest, std::hypot(out, up));
  }
  options.tube_radius = farthest + margin;
  if (!(options.tube_radius < options.radius)) {
    throw ParameterError("torus: the points leave no hole along this axis");
  }
  return options;
}

SphereOptions fitted(SphereOptions options, Points points, const FitOptions&, double margin) {
  const Ball ball = enclosing_ball(points);
  options.center = ball.center;
  options.radius = ball.radius + margin;
  return options;
}

StarOptions fitted(StarOptions options, Points points, const FitOptions& fit, double margin) {
  constexpr double kValley = 0.5;
  options = [&] {
    StarOptions laid = laid_along(options, points, axis_of(points, fit, 2), margin);
    laid.radius = 0;
    return laid;
  }();
  const auto [right, up] = plane_across(unit_vector(options.to - options.from));
  // The side from a tip at angle 0 to the valley beside it, for a star of radius 1.
  const double half = std::numbers::pi / std::max(options.tips, 3);
  const glm::dvec3 normal =
      glm::normalize(glm::dvec3(kValley * std::sin(half), 1 - kValley * std::cos(half), 0));
  for (const glm::dvec3& point : points) {
    const double x = glm::dot(point - options.from, right);
    const double y = glm::dot(point - options.from, up);
    const double angle =
        std::abs(std::remainder(std::atan2(y, x) - std::numbers::pi / 2, 2 * half));
    const double distance = std::hypot(x, y);
    const double out = distance * (normal.x * std::cos(angle) + normal.y * std::sin(angle));
    options.radius = std::max(options.radius, (out + margin) / normal.x);
  }
  options.radius = std::max(options.radius, kThinnestFit * extent_of(points));
  options.inner_radius = kValley * options.radius;
  return options;
}

BarbellOptions fitted(BarbellOptions options, Points points, const FitOptions& fit, double margin) {
  constexpr int kPlaces = 64;
  const glm::dmat3 axes = sorted_axes(points, fit.is_principal);
  const Interval length = interval_along(points, axes[0], 0);
  const Interval width = interval_along(points, axes[1], 0);
  const Interval depth = interval_along(points, axes[2], margin);
  std::vector<glm::dvec3> flat;
  for (const glm::dvec3& point : points) {
    flat.emplace_back(glm::dot(point, axes[0]) - length.middle(),
                      glm::dot(point, axes[1]) - width.middle(), 0);
  }
  const double half = (length.high - length.low) / 2;
  std::optional<BarbellPlan> best;
  for (int i = 1; i < kPlaces; ++i) {
    const auto plan = barbell_at(half * i / kPlaces, flat, margin);
    if (plan && (!best || plan->radius < best->radius)) {
      best = plan;
    }
  }
  if (!best) {
    throw ParameterError(
        "barbell: the points are too wide for their length, or thick between disks");
  }
  const glm::dvec3 middle =
      axes[0] * length.middle() + axes[1] * width.middle() + axes[2] * depth.low;
  options.from = middle - axes[0] * best->center;
  options.to = middle + axes[0] * best->center;
  options.by = axes[2] * (depth.high - depth.low);
  options.radius = best->radius;
  options.bar_radius = best->bar_radius;
  return options;
}

JunctionOptions fitted(JunctionOptions options, Points points, const FitOptions&, double margin) {
  constexpr double kShortest = 2.4;  // of the radius
  std::vector<glm::dvec3> along;
  for (const glm::dvec3& arm : options.arms) {
    along.push_back(unit_vector(arm));
  }
  const double extent = extent_of(points);
  options.center = best_center(points, along);
  options.radius =
      std::max(arm_radius(points, options.center, along), kThinnestFit * extent / 2) + margin;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double end = interval_along(points, along[i], margin).high;
    options.arms[i] =
        along[i] * std::max(end - glm::dot(options.center, along[i]), kShortest * options.radius);
  }
  return options;
}

}  // namespace espalier
