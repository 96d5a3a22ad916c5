#include "viewer/interact/surface_pick.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

namespace espalier::viewer {
namespace {

struct Ray {
  glm::dvec3 from;
  glm::dvec3 along;
};

/// How far along a ray a triangle is, in lengths of its direction; infinite if it is not met.
double distance_along(const Ray& ray, const std::array<glm::dvec3, 3>& triangle) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const glm::dvec3 u = triangle[1] - triangle[0];
  const glm::dvec3 v = triangle[2] - triangle[0];
  const glm::dvec3 across = glm::cross(ray.along, v);
  const double volume = glm::dot(u, across);
  if (volume == 0) {
    return kNone;
  }
  const glm::dvec3 arm = ray.from - triangle[0];
  const double a = glm::dot(arm, across) / volume;
  const glm::dvec3 turned = glm::cross(arm, u);
  const double b = glm::dot(ray.along, turned) / volume;
  const double t = glm::dot(v, turned) / volume;
  return a >= 0 && b >= 0 && a + b <= 1 && t > 0 ? t : kNone;
}

}  // namespace

std::optional<glm::dvec3> surface_point(const View& view, const BentModels& models,
                                        const glm::dvec2& pixel) {
  const glm::dvec3 there = view.point_at(pixel, view.frame.to_model(view.camera.target));
  const glm::dvec3 eye = view.eye_before(there);
  const Ray ray{eye - view.frame.origin, there - eye};  // positions are from the frame's origin
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [name, model] : models.all()) {
    const auto& corners = model.drawing().triangles();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      const double t = distance_along(ray, {glm::dvec3(model.positions()[corners[i]]),
                                            glm::dvec3(model.positions()[corners[i + 1]]),
                                            glm::dvec3(model.positions()[corners[i + 2]])});
      nearest = std::min(nearest, t);
    }
  }
  return nearest < std::numeric_limits<double>::infinity()
             ? std::optional(eye + nearest * ray.along)
             : std::nullopt;
}

}  // namespace espalier::viewer
