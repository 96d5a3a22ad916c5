#include "viewer/interact/gizmo.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace espalier::viewer {
namespace {

constexpr double kLength = 96;  // pixels
constexpr double kReach = 7;
/// Parts of the length.
constexpr double kGap = 0.16;
constexpr double kArrow = 0.14;
constexpr double kArrowRadius = 0.05;
constexpr double kBox = 0.05;
constexpr double kPlaneFrom = 0.32;
constexpr double kPlaneTo = 0.52;
constexpr double kOuterRing = 1.2;
constexpr int kArcs = 48;

using Segments = std::vector<glm::dvec3>;

glm::dvec3 unit(int axis) {
  glm::dvec3 v(0.0);
  v[axis] = 1;
  return v;
}

void add_loop(std::initializer_list<glm::dvec3> corners, Segments& segments) {
  for (auto corner = corners.begin(); corner != corners.end(); ++corner) {
    segments.push_back(*corner);
    segments.push_back(corner + 1 == corners.end() ? *corners.begin() : corner[1]);
  }
}

/// From one angle to another of the circle through `center + u` and `center + v`.
void add_arc(const glm::dvec3& center, const glm::dvec3& u, const glm::dvec3& v, double radians,
             Segments& segments) {
  const auto at = [&](int i) {
    const double angle = radians * i / kArcs;
    return center + std::cos(angle) * u + std::sin(angle) * v;
  };
  for (int i = 0; i < kArcs; ++i) {
    segments.insert(segments.end(), {at(i), at(i + 1)});
  }
}

/// What handles are built from: the pivot, and how long they are there, in model units.
struct Place {
  const Gizmo& gizmo;
  const View& view;
  double length = kLength * view.pixel_size(gizmo.pivot);

  [[nodiscard]] glm::dvec3 at(const glm::dvec3& direction) const {
    return gizmo.pivot + length * direction;
  }
};

GizmoHandle arrow(const Place& place, int axis) {
  const glm::dvec3 along = unit(axis);
  const glm::dvec3 u = kArrowRadius * unit((axis + 1) % 3);
  const glm::dvec3 v = kArrowRadius * unit((axis + 2) % 3);
  const glm::dvec3 neck = (1 - kArrow) * along;
  GizmoHandle handle{{axis, false}, {place.at(kGap * along), place.at(along)}};
  for (const glm::dvec3& side : {u, v, -u, -v}) {
    handle.segments.insert(handle.segments.end(), {place.at(neck + side), place.at(along)});
  }
  add_loop({place.at(neck + u), place.at(neck + v), place.at(neck - u), place.at(neck - v)},
           handle.segments);
  return handle;
}

GizmoHandle plane(const Place& place, int axis) {
  const glm::dvec3 u = unit((axis + 1) % 3);
  const glm::dvec3 v = unit((axis + 2) % 3);
  GizmoHandle handle{{axis, true}, {}, true};
  add_loop({place.at(kPlaneFrom * (u + v)), place.at(kPlaneTo * u + kPlaneFrom * v),
            place.at(kPlaneTo * (u + v)), place.at(kPlaneFrom * u + kPlaneTo * v)},
           handle.segments);
  return handle;
}

/// Faces the eye.
GizmoHandle middle(const Place& place) {
  const glm::dvec3 u = kBox * place.view.camera.right();
  const glm::dvec3 v = kBox * place.view.camera.upward();
  GizmoHandle handle{{}, {}, true};
  add_loop({place.at(-u - v), place.at(u - v), place.at(u + v), place.at(v - u)}, handle.segments);
  return handle;
}

/// The half of the circle that is nearer to the eye; all of it where it faces the eye.
GizmoHandle ring(const Place& place, int axis) {
  constexpr double kFacing = 0.25;
  const glm::dvec3 toward =
      glm::normalize(place.view.eye_before(place.gizmo.pivot) - place.gizmo.pivot);
  glm::dvec3 front = toward - glm::dot(toward, unit(axis)) * unit(axis);
  const bool is_facing = glm::length(front) < kFacing;
  front = is_facing ? unit((axis + 1) % 3) : glm::normalize(front);
  const glm::dvec3 side = glm::cross(unit(axis), front);
  GizmoHandle handle{{axis, false}, {}};
  add_arc(place.gizmo.pivot, -place.length * side, place.length * front,
          (is_facing ? 2 : 1) * std::numbers::pi, handle.segments);
  return handle;
}

GizmoHandle outer_ring(const Place& place) {
  GizmoHandle handle;
  add_arc(place.gizmo.pivot, kOuterRing * place.length * place.view.camera.right(),
          kOuterRing * place.length * place.view.camera.upward(), 2 * std::numbers::pi,
          handle.segments);
  return handle;
}

GizmoHandle stick(const Place& place, int axis) {
  const glm::dvec3 along = unit(axis);
  const glm::dvec3 u = kBox * unit((axis + 1) % 3);
  const glm::dvec3 v = kBox * unit((axis + 2) % 3);
  const glm::dvec3 low = (1 - kBox) * along;
  const glm::dvec3 high = (1 + kBox) * along;
  GizmoHandle handle{{axis, false}, {place.at(kGap * along), place.at(low)}};
  for (const glm::dvec3& end : {low, high}) {
    add_loop({place.at(end - u - v), place.at(end + u - v), place.at(end + u + v),
              place.at(end - u + v)},
             handle.segments);
  }
  return handle;
}

double distance_to_segment(const glm::dvec2& pixel, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(pixel - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(pixel - a - t * along);
}

/// How far a pixel is from a handle; 0 on its area.
double distance_to(const GizmoHandle& handle, const View& view, const glm::dvec2& pixel) {
  double nearest = 1e9;
  bool is_inside = false;
  for (std::size_t i = 0; i + 1 < handle.segments.size(); i += 2) {
    const glm::dvec3 a = view.project(handle.segments[i]);
    const glm::dvec3 b = view.project(handle.segments[i + 1]);
    if (!(a.z > 0 && b.z > 0)) {
      continue;
    }
    nearest = std::min(nearest, distance_to_segment(pixel, glm::dvec2(a), glm::dvec2(b)));
    if ((a.y > pixel.y) != (b.y > pixel.y) &&
        pixel.x < a.x + (b.x - a.x) * (pixel.y - a.y) / (b.y - a.y)) {
      is_inside = !is_inside;
    }
  }
  return handle.is_area && is_inside ? 0 : nearest;
}

}  // namespace

std::vector<GizmoHandle> gizmo_handles(const Gizmo& gizmo, const View& view) {
  const Place place{gizmo, view};
  std::vector<GizmoHandle> handles;
  for (int axis = 0; axis < 3; ++axis) {
    handles.push_back(gizmo.kind == TransformKind::Turn    ? ring(place, axis)
                      : gizmo.kind == TransformKind::Scale ? stick(place, axis)
                                                           : arrow(place, axis));
  }
  for (int axis = 0; axis < 3 && gizmo.kind == TransformKind::Move; ++axis) {
    handles.push_back(plane(place, axis));
  }
  handles.push_back(gizmo.kind == TransformKind::Turn ? outer_ring(place) : middle(place));
  return handles;
}

std::optional<AxisLock> gizmo_hit(const Gizmo& gizmo, const View& view, const glm::dvec2& pixel) {
  std::optional<AxisLock> found;
  double best = kReach;
  for (const GizmoHandle& handle : gizmo_handles(gizmo, view)) {
    const double distance = distance_to(handle, view, pixel);
    // What is seen end-on yields to the middle.
    if (distance < best || (distance == best && handle.lock.axis < 0)) {
      best = distance;
      found = handle.lock;
    }
  }
  return found;
}

}  // namespace espalier::viewer
