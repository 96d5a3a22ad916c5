#pragma once

/// How far two volumes of one lattice are apart, measured at points.

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/evaluate/displace.h"

namespace espalier::test {

/// Where a pose takes points, and its derivative there.
struct Motion {
  std::vector<PointStatus> status;
  std::vector<glm::dvec3> points;
  std::vector<glm::dmat3> gradients;
};

inline Motion motion(const Volume& volume, std::span<const glm::dvec3> points,
                     std::span<const glm::dvec3> pose) {
  const Binding binding = embed(volume, points);
  const std::vector<glm::dvec3> displacements = volume.displacements(pose);
  return {binding.status, displaced_points(volume, binding, points, displacements),
          deformation_gradients(volume, binding, displacements)};
}

/// The largest length of a column of a difference of derivatives.
inline double distance(const glm::dmat3& a, const glm::dmat3& b) {
  return std::max(
      {glm::distance(a[0], b[0]), glm::distance(a[1], b[1]), glm::distance(a[2], b[2])});
}

/// The largest differences over the points that both volumes hold.
struct Difference {
  double position = 0;
  double gradient = 0;
  std::size_t n_points = 0;
};

inline Difference difference(const Motion& a, const Motion& b) {
  const auto is_held = [](PointStatus status) {
    return status == PointStatus::Inside || status == PointStatus::Border;
  };
  Difference result;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    if (is_held(a.status[i]) && is_held(b.status[i])) {
      ++result.n_points;
      result.position = std::max(result.position, glm::distance(a.points[i], b.points[i]));
      result.gradient = std::max(result.gradient, distance(a.gradients[i], b.gradients[i]));
    }
  }
  return result;
}

}  // namespace espalier::test
