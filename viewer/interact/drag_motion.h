#pragma once

/// How selected control points are moved together.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace espalier::viewer {

/// A displacement, or a linear map about a pivot; the other one does nothing.
struct DragMotion {
  glm::dvec3 displacement{0};
  glm::dmat3 map{1};

  /// The part of it on the straight way from mouse-down.
  [[nodiscard]] DragMotion part(double fraction) const {
    return {fraction * displacement, glm::dmat3(1) + fraction * (map - glm::dmat3(1))};
  }
};

}  // namespace espalier::viewer
