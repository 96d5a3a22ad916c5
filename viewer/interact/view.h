#pragma once

/// Between the picture on the screen and model space, and how hands move the camera.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "viewer/render/camera.h"
#include "viewer/render/drawing_frame.h"

namespace espalier::viewer {

/// A camera in drawing units, where these stand in model space, and the picture's size in pixels.
struct View {
  Camera camera{};
  DrawingFrame frame{};
  int width = 1280;
  int height = 800;

  [[nodiscard]] double aspect() const { return double(width) / height; }
  /// Pixels from the top left corner, and the distance in front of the eye's plane in drawing
  /// units: what is not in front has none above 0. point: model units.
  [[nodiscard]] glm::dvec3 project(const glm::dvec3& point) const;
  /// How far a pixel reaches at the depth of a point, in model units.
  [[nodiscard]] double pixel_size(const glm::dvec3& point) const;
  /// The point seen at a pixel that is as far before the eye's plane as another one.
  [[nodiscard]] glm::dvec3 point_at(const glm::dvec2& pixel, const glm::dvec3& depth) const;
  /// The eye, or for an orthographic view the point straight before `point` that far away, in model
  /// units.
  [[nodiscard]] glm::dvec3 eye_before(const glm::dvec3& point) const;
};

/// The camera turned about its target as if the scene were dragged by so many pixels.
[[nodiscard]] Camera orbited(Camera camera, const glm::dvec2& pixels);
/// The camera shifted so that what is at the target follows the mouse.
[[nodiscard]] Camera panned(Camera camera, const glm::dvec2& pixels, int height);
/// steps: of the wheel; above 0 comes nearer.
[[nodiscard]] Camera zoomed(Camera camera, double steps);

}  // namespace espalier::viewer
