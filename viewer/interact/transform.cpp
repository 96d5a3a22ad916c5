#include "viewer/interact/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

#include "lattice/core/text_scanner.h"
#include "lattice/io/number_text.h"

namespace espalier::viewer {
namespace {

glm::dvec3 unit(int axis) {
  glm::dvec3 v(0.0);
  v[axis] = 1;
  return v;
}

/// The number typed, once it is one.
std::optional<double> typed(const std::string& text) {
  double number = 0;
  return parse_number(text, number) && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Pixels by which a point moves on the screen a unit of model space along a direction.
glm::dvec2 on_screen(const View& view, const glm::dvec3& at, const glm::dvec3& direction) {
  const double step = view.pixel_size(at);
  return glm::dvec2(view.project(at + step * direction) - view.project(at)) / step;
}

/// How far along a direction the mouse went, model units; 0 if it is seen end-on.
double length_along(const View& view, const glm::dvec3& at, const glm::dvec3& direction,
                    const glm::dvec2& pixels) {
  const glm::dvec2 along = on_screen(view, at, direction);
  const double length = glm::dot(along, along);
  return length > 0 ? glm::dot(pixels, along) / length : 0;
}

}  // namespace

bool Transform::type(const std::string& key) {
  if (key == "backspace") {
    if (!number.empty()) {
      number.pop_back();
    }
    return true;
  }
  if (key == "-") {
    number = number.starts_with('-') ? number.substr(1) : "-" + number;
    return true;
  }
  if (key == "." || (key.size() == 1 && key[0] >= '0' && key[0] <= '9')) {
    number += key;
    return true;
  }
  return false;
}

void Transform::toggle(const AxisLock& wanted) {
  const bool is_so = lock.axis == wanted.axis && lock.is_plane == wanted.is_plane;
  lock = is_so ? AxisLock() : wanted;
}

double Transform::distance(const View& view) const {
  const auto length = typed(number);
  return length ? *length : length_along(view, pivot, normal, at - from);
}

glm::dvec3 Transform::offset(const View& view) const {
  if (kind == TransformKind::Extrude && lock.axis < 0) {
    return distance(view) * normal;
  }
  if (const auto length = typed(number)) {
    const int axis = lock.axis < 0 || lock.is_plane ? (lock.axis == 0 ? 1 : 0) : lock.axis;
    return *length * unit(axis);
  }
  const glm::dvec2 pixels = at - from;
  if (lock.axis < 0) {
    return view.pixel_size(pivot) *
           (pixels.x * view.camera.right() - pixels.y * view.camera.upward());
  }
  if (!lock.is_plane) {
    return length_along(view, pivot, unit(lock.axis), pixels) * unit(lock.axis);
  }
  const int u = (lock.axis + 1) % 3;
  const int v = (lock.axis + 2) % 3;
  const glm::dmat2 axes(on_screen(view, pivot, unit(u)), on_screen(view, pivot, unit(v)));
  const double area = glm::determinant(axes);
  const double full = glm::length(axes[0]) * glm::length(axes[1]);
  if (std::abs(area) <= 1e-3 * full) {
    return glm::dvec3(0.0);  // the plane is seen edge-on
  }
  const glm::dvec2 steps = glm::inverse(axes) * pixels;
  return steps.x * unit(u) + steps.y * unit(v);
}

double Transform::angle(const View& view) const {
  if (const auto degrees = typed(number)) {
    return glm::radians(*degrees);
  }
  const glm::dvec2 center(view.project(pivot));
  const glm::dvec2 a = from - center;
  const glm::dvec2 b = at - center;
  const double turned = -std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));  // y points down
  const bool is_away = lock.axis >= 0 && view.camera.backward()[lock.axis] < 0;
  return is_away ? -turned : turned;
}

double Transform::factor(const View& view) const {
  if (const auto ratio = typed(number)) {
    return *ratio;
  }
  const glm::dvec2 center(view.project(pivot));
  return glm::length(at - center) / std::max(glm::length(from - center), 1.0);
}

std::vector<glm::dvec3> Transform::apply(const View& view, std::span<const glm::dvec3> points,
                                         std::span<const double> weights) const {
  std::vector<glm::dvec3> moved(points.begin(), points.end());
  const glm::dvec3 by = offset(view);
  const double turn = angle(view);
  const double ratio = factor(view);
  const glm::dvec3 axis = turn_axis(view);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights[i] == 0) {
      continue;
    }
    const glm::dvec3& center = pivots.empty() ? pivot : pivots[i];
    const glm::dvec3 arm = points[i] - center;
    if (kind == TransformKind::Move || kind == TransformKind::Extrude) {
      moved[i] = points[i] + weights[i] * by;
    } else if (kind == TransformKind::Turn) {
      moved[i] = center + glm::dvec3(glm::rotate(glm::dmat4(1), weights[i] * turn, axis) *
                                     glm::dvec4(arm, 0));
    } else {
      for (int k = 0; k < 3; ++k) {
        moved[i][k] = center[k] + arm[k] * (scales(k) ? 1 + weights[i] * (ratio - 1) : 1.0);
      }
    }
  }
  return moved;
}

glm::dvec3 Transform::turn_axis(const View& view) const {
  return lock.axis < 0 ? view.camera.backward() : unit(lock.axis);
}

DragMotion Transform::motion(const View& view) const {
  DragMotion motion;
  if (kind == TransformKind::Move || kind == TransformKind::Extrude) {
    motion.displacement = offset(view);
  } else if (kind == TransformKind::Turn) {
    motion.map = glm::dmat3(glm::rotate(glm::dmat4(1), angle(view), turn_axis(view)));
  } else {
    const double ratio = factor(view);
    for (int axis = 0; axis < 3; ++axis) {
      motion.map[axis][axis] = scales(axis) ? ratio : 1.0;
    }
  }
  return motion;
}

std::string Transform::text(const View& view) const {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  constexpr std::array<const char*, 4> kNames = {"move", "turn", "scale", "extrude"};
  std::string text = kNames.at(static_cast<std::size_t>(kind));
  if (lock.axis >= 0) {
    text += std::string(lock.is_plane ? " all but " : " along ") +
            kAxes.at(static_cast<std::size_t>(lock.axis));
  }
  text += ": ";
  if (!number.empty()) {
    return text + number + (kind == TransformKind::Turn ? " degrees" : "");
  }
  const auto rounded = [&](double x) { append_number(text, static_cast<float>(x)); };
  if (kind == TransformKind::Turn) {
    rounded(glm::degrees(angle(view)));
    return text + " degrees";
  }
  rounded(kind == TransformKind::Scale ? factor(view) : glm::length(offset(view)));
  return text;
}

std::vector<double> soft_weights(std::span<const glm::dvec3> points, const Selection& selected,
                                 double radius) {
  std::vector<double> weights(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (selected.contains(static_cast<std::int32_t>(i))) {
      weights[i] = 1;
      continue;
    }
    if (!(radius > 0)) {
      continue;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::int32_t vertex : selected) {
      nearest =
          std::min(nearest, glm::length(points[i] - points[static_cast<std::size_t>(vertex)]));
    }
    if (nearest < radius) {
      const double rest = 1 - nearest / radius * (nearest / radius);
      weights[i] = rest * rest;
    }
  }
  return weights;
}

}  // namespace espalier::viewer
