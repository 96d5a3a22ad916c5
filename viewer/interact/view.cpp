#include "viewer/interact/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace espalier::viewer {
namespace {

constexpr double kDegreesAPixel = 0.4;
constexpr double kZoomAStep = 0.88;
/// Distances from which a camera still has a picture, in drawing units.
constexpr double kNearest = 1e-4;
constexpr double kFarthest = 1e4;

/// Drawing units a pixel, at this distance from the eye.
double units_a_pixel(const Camera& camera, double depth, int height) {
  return 2 * depth * std::tan(glm::radians(camera.field_of_view / 2)) / height;
}

}  // namespace

glm::dvec3 View::project(const glm::dvec3& point) const {
  const glm::dvec4 seen = camera.view_matrix() * glm::dvec4(frame.to_drawing(point), 1);
  const double depth = camera.projection == Projection::Perspective ? -seen.z : camera.distance;
  const double unit = units_a_pixel(camera, depth, height);
  return {0.5 * width + seen.x / unit, 0.5 * height - seen.y / unit, -seen.z};
}

double View::pixel_size(const glm::dvec3& point) const {
  const double depth = camera.projection == Projection::Perspective
                           ? std::max(project(point).z, kNearest)
                           : camera.distance;
  return units_a_pixel(camera, depth, height) / frame.scale;
}

glm::dvec3 View::point_at(const glm::dvec2& pixel, const glm::dvec3& depth) const {
  const glm::dvec2 by = pixel_size(depth) * (pixel - glm::dvec2(project(depth)));
  return depth + by.x * camera.right() - by.y * camera.upward();
}

glm::dvec3 View::eye_before(const glm::dvec3& point) const {
  if (camera.projection == Projection::Perspective) {
    return frame.to_model(camera.eye());
  }
  return point + 2 * (camera.distance + camera.radius) / frame.scale * camera.backward();
}

Camera orbited(Camera camera, const glm::dvec2& pixels) {
  camera.angles.azimuth -= kDegreesAPixel * pixels.x;
  camera.angles.elevation =
      std::clamp(camera.angles.elevation + kDegreesAPixel * pixels.y, -90.0, 90.0);
  return camera;
}

Camera panned(Camera camera, const glm::dvec2& pixels, int height) {
  const double unit = units_a_pixel(camera, camera.distance, height);
  const glm::dvec3 shift = unit * (pixels.y * camera.upward() - pixels.x * camera.right());
  camera.target += shift;
  camera.radius += glm::length(shift);
  return camera;
}

Camera zoomed(Camera camera, double steps) {
  camera.distance = std::clamp(camera.distance * std::pow(kZoomAStep, steps), kNearest, kFarthest);
  return camera;
}

}  // namespace espalier::viewer
