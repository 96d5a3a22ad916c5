#pragma once

/// Boxes in any direction, and those that hold points.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/core/box.h"

namespace espalier {

/// center + axes · h for h between −half_sizes and half_sizes.
struct OrientedBox {
  glm::dvec3 center{0.5};
  glm::dmat3 axes{1.0};  ///< columns; unit length, right-handed and perpendicular if made here
  glm::dvec3 half_sizes{0.5};

  /// t: in [−1, 1]³.
  [[nodiscard]] glm::dvec3 at(const glm::dvec3& t) const {
    return center + axes * (half_sizes * t);
  }
};

[[nodiscard]] OrientedBox oriented(const Box& box);

/// The axis-aligned box of points, every side moved outward by `padding` times the diagonal. No
/// side is shorter than a thousandth of the diagonal, so that flat things get a volume. Points that
/// are not finite do not count. Throws ParameterError for a padding that is not a number from 0 to
/// 100, or if there is no extent at all.
[[nodiscard]] OrientedBox fitted_box(std::span<const glm::dvec3> points, double padding);

/// The same with axes along the points' principal directions, each the one that is nearest to its
/// coordinate axis.
[[nodiscard]] OrientedBox fitted_principal_box(std::span<const glm::dvec3> points, double padding);

}  // namespace espalier
