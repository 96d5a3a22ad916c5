#pragma once

/// Where a picture is taken from.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "viewer/render/drawing_frame.h"

namespace espalier::viewer {

enum class UpAxis { Y, Z };
enum class Projection { Perspective, Orthographic };

/// The side a scene is seen from, in degrees. Azimuth 0 is the front: from +z with y up, from -y
/// with z up. It grows towards +x (90: the right side). Elevation 90 is straight from above.
struct ViewAngles {
  double azimuth = 30;
  double elevation = 20;
};

/// front, back, left, right, top, bottom, iso (equal angles to all axes) or three-quarter.
/// Throws ParameterError for another name.
[[nodiscard]] ViewAngles named_view(std::string_view name);

/// A value; all of it in the units of what it looks at.
struct Camera {
  glm::dvec3 target{0.0};
  double distance = 4;  ///< From the eye to the target; above 0.
  double radius = 1;    ///< Of a ball around the target that holds the scene; above 0.
  ViewAngles angles;
  UpAxis up = UpAxis::Y;
  Projection projection = Projection::Perspective;
  double field_of_view = 30;  ///< From bottom to top, in degrees, also for the scale of an
                              ///< orthographic view: both show the target at one size.

  /// Unit vectors: to the right and up in the picture, and from the target back to the eye.
  [[nodiscard]] glm::dvec3 right() const;
  [[nodiscard]] glm::dvec3 upward() const;
  [[nodiscard]] glm::dvec3 backward() const;
  [[nodiscard]] glm::dvec3 eye() const { return target + distance * backward(); }

  /// World to eye space (x right, y up, looking along -z).
  [[nodiscard]] glm::dmat4 view_matrix() const;
  /// Eye space to OpenGL's clip space. aspect: width / height. The planes enclose the ball.
  [[nodiscard]] glm::dmat4 projection_matrix(double aspect) const;

  /// This camera moved, not turned, so that the points just fill the picture but for a margin
  /// (a fraction of each side, on either side). Points that are not finite are left out; no
  /// points are one at the origin, and points all in one place are seen from 4 units away.
  /// O(#P). Throws ParameterError for a margin outside [0, 0.5) or an aspect that is not above 0.
  [[nodiscard]] Camera fitted_to(std::span<const glm::dvec3> points, double aspect,
                                 double margin = 0.06) const;
  [[nodiscard]] Camera fitted_to(const Box& box, double aspect, double margin = 0.06) const;
};

}  // namespace espalier::viewer
