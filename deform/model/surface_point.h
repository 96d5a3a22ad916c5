#pragma once

/// Points of a model's surface.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/model/model.h"

namespace espalier {

/// A combination of a model's points: it moves as they do. Weights sum to 1.
struct SurfacePoint {
  struct Corner {
    std::size_t point = 0;
    double weight = 1;
  };
  std::vector<Corner> corners;
};

/// Where it is. points: the model's, at rest or moved.
[[nodiscard]] glm::dvec3 place_of(const SurfacePoint& point, std::span<const glm::dvec3> points);

/// The point of the model's faces that is closest to x, and of several the first. A triangle is
/// itself; a face with more corners is the fan of triangles round their mean, so that it is
/// covered where it is convex. A model without faces has its points only. O(#corners).
[[nodiscard]] SurfacePoint closest_surface_point(const Model& model, const glm::dvec3& x);

}  // namespace espalier
