#pragma once

/// Where a drawing stands in model space. Pictures are drawn in float; a model may be 1e-8 units
/// small or stand 1e8 units from the origin. The scene's centre is subtracted and its size divided
/// out in double before anything becomes float.

#include <glm/vec3.hpp>

#include "lattice/core/box.h"

namespace espalier::viewer {

using espalier::Box;

/// The map from model units to drawing units: subtract `origin`, multiply by `scale`.
struct DrawingFrame {
  glm::dvec3 origin{0.0};
  double scale = 1;

  /// The frame in which `box` has its middle at the origin and half its diagonal is 1. A box
  /// without extent keeps its units.
  [[nodiscard]] static DrawingFrame of(const Box& box);

  [[nodiscard]] glm::dvec3 to_drawing(const glm::dvec3& point) const {
    return (point - origin) * scale;
  }
  [[nodiscard]] glm::dvec3 to_model(const glm::dvec3& point) const {
    return point / scale + origin;
  }
  [[nodiscard]] Box to_drawing(const Box& box) const;
  bool operator==(const DrawingFrame&) const = default;
};

}  // namespace espalier::viewer
