#include "viewer/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

/// The eye stays this many radii away from the target when a camera is fitted, so that a rod seen
/// end-on is neither distorted beyond recognition nor blown up without limit.
constexpr double kClosestFit = 1.5;
constexpr double kClosestOrthographicFit = 0.25;
/// The nearest plane as a fraction of the distance, for an eye inside the scene.
constexpr double kNearestPlane = 1e-3;

/// The elevation from which all axes look equally long: atan(1 / √2), in degrees.
constexpr double kIsoElevation = 35.264389682754654;

constexpr std::array<std::pair<std::string_view, ViewAngles>, 8> kViews{{
    {"front", {0, 0}},
    {"back", {180, 0}},
    {"left", {-90, 0}},
    {"right", {90, 0}},
    {"top", {0, 90}},
    {"bottom", {0, -90}},
    {"iso", {45, kIsoElevation}},
    {"three-quarter", {30, 20}},
}};

/// Sines and cosines that are exact for multiples of 90°, so that named views have exact axes.
std::pair<double, double> sine_and_cosine(double degrees) {
  const double turned = std::remainder(degrees, 360.0);
  const double quarter = std::round(turned / 90);
  const double rest = glm::radians(turned - 90 * quarter);
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// From y-up axes to those of the scene.
glm::dvec3 to_axes(UpAxis up, const glm::dvec3& v) {
  return up == UpAxis::Y ? v : glm::dvec3(v.x, -v.z, v.y);
}

double tangent_of_half(double degrees) {
  return std::tan(glm::radians(degrees / 2));
}

/// How far points reach along the edges of a view pyramid (or, for an orthographic view, prism)
/// whose half-width is `tangent` at distance 1: what decides position and distance of the eye.
struct Reach {
  double positive = -std::numeric_limits<double>::infinity();
  double negative = -std::numeric_limits<double>::infinity();

  void add(double across, double depth, double tangent) {
    positive = std::max(positive, depth + across / tangent);
    negative = std::max(negative, depth - across / tangent);
  }
  /// The eye is as far from the points' left edge as from their right one at this place …
  [[nodiscard]] double center(double tangent) const { return tangent * (positive - negative) / 2; }
  /// … and sees both from here on.
  [[nodiscard]] double distance() const { return (positive + negative) / 2; }
};

double farthest_from(const glm::dvec3& center, std::span<const glm::dvec3> points) {
  double farthest = 0;
  for (const glm::dvec3& point : points) {
    const double distance = glm::length(point - center);
    farthest = std::isfinite(distance) ? std::max(farthest, distance) : farthest;
  }
  return farthest;
}

void check_fit(double aspect, double margin) {
  if (!(aspect > 0) || !std::isfinite(aspect)) {
    throw ParameterError("Camera: the aspect is " + std::to_string(aspect) +
                         ", it must be finite and above 0");
  }
  if (!(margin >= 0 && margin < 0.5)) {
    throw ParameterError("Camera: the margin is " + std::to_string(margin) +
                         ", it must be in [0, 0.5)");
  }
}

}  // namespace

ViewAngles named_view(std::string_view name) {
  for (const auto& [known, angles] : kViews) {
    if (known == name) {
      return angles;
    }
  }
  throw ParameterError("the view is '" + std::string(name) +
                       "', it must be one of front, back, left, right, top, bottom, iso, "
                       "three-quarter");
}

glm::dvec3 Camera::right() const {
  const auto [sa, ca] = sine_and_cosine(angles.azimuth);
  return to_axes(up, {ca, 0, -sa});
}

glm::dvec3 Camera::upward() const {
  const auto [sa, ca] = sine_and_cosine(angles.azimuth);
  const auto [se, ce] = sine_and_cosine(angles.elevation);
  return to_axes(up, {-sa * se, ce, -ca * se});
}

glm::dvec3 Camera::backward() const {
  const auto [sa, ca] = sine_and_cosine(angles.azimuth);
  const auto [se, ce] = sine_and_cosine(angles.elevation);
  return to_axes(up, {sa * ce, se, ca * ce});
}

glm::dmat4 Camera::view_matrix() const {
  const glm::dmat4 turned_back(glm::dvec4(right(), 0), glm::dvec4(upward(), 0),
                               glm::dvec4(backward(), 0), glm::dvec4(0, 0, 0, 1));
  return glm::translate(glm::dmat4(1), {0, 0, -distance}) *
         glm::translate(glm::transpose(turned_back), -target);
}

glm::dmat4 Camera::projection_matrix(double aspect) const {
  const double far_plane = distance + radius * 1.05;
  const double half_height = distance * tangent_of_half(field_of_view);
  if (projection == Projection::Orthographic) {
    return glm::ortho(-half_height * aspect, half_height * aspect, -half_height, half_height,
                      distance - radius * 1.05, far_plane);
  }
  const double near_plane = std::max(distance - radius * 1.05, distance * kNearestPlane);
  return glm::perspective(glm::radians(field_of_view), aspect, near_plane, far_plane);
}

Camera Camera::fitted_to(std::span<const glm::dvec3> points, double aspect, double margin) const {
  check_fit(aspect, margin);
  Box box;
  box.add(points);
  Camera fitted = *this;
  fitted.target = box.center();
  if (!(box.radius() > 0)) {
    fitted.distance = 4;
    fitted.radius = 1;
    return fitted;
  }
  const double tangent_y = tangent_of_half(field_of_view) * (1 - 2 * margin);
  const double tangent_x = tangent_y * aspect;
  const double depth_weight = projection == Projection::Perspective ? 1 : 0;
  Reach reach_x;
  Reach reach_y;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 offset = point - fitted.target;
    if (std::isfinite(offset.x) && std::isfinite(offset.y) && std::isfinite(offset.z)) {
      const double depth = depth_weight * glm::dot(offset, backward());
      reach_x.add(glm::dot(offset, right()), depth, tangent_x);
      reach_y.add(glm::dot(offset, upward()), depth, tangent_y);
    }
  }
  fitted.target += reach_x.center(tangent_x) * right() + reach_y.center(tangent_y) * upward();
  fitted.radius = farthest_from(fitted.target, points);
  const double needed = std::max(reach_x.distance(), reach_y.distance());
  const double closest =
      projection == Projection::Perspective ? kClosestFit : kClosestOrthographicFit;
  fitted.distance = std::max(needed, closest * fitted.radius);
  return fitted;
}

Camera Camera::fitted_to(const Box& box, double aspect, double margin) const {
  std::array<glm::dvec3, 8> corners{};
  if (box.is_empty()) {
    return fitted_to(std::span<const glm::dvec3>(), aspect, margin);
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                  (i & 4) != 0 ? box.max.z : box.min.z};
  }
  return fitted_to(std::span<const glm::dvec3>(corners), aspect, margin);
}

}  // namespace espalier::viewer
