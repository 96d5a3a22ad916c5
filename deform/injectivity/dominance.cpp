#include "deform/injectivity/dominance.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

namespace espalier {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double sum_of_sizes(const glm::dvec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// The frame: any matrix serves whose determinant is surely positive.
bool find_frame(const BezierView& patch, glm::dmat3& frame) {
  const glm::dmat3 middle = patch.derivative(glm::dvec3(0.5));
  frame = glm::inverse(middle);
  const double sizes = sum_of_sizes(frame[0]) * sum_of_sizes(frame[1]) * sum_of_sizes(frame[2]);
  return glm::determinant(frame) > 1e-9 * sizes && std::isfinite(sizes);
}

}  // namespace

double dominant_step(const BezierView& start, const BezierPatch* motion, double start_error,
                     double motion_error) {
  constexpr double kRounding = 1e-13;  // of a product of 3 × 3 numbers, amply
  glm::dmat3 frame;
  if (start.is_pyramid || !find_frame(start, frame)) {
    return 0;
  }
  const double frame_size =
      sum_of_sizes(frame[0]) + sum_of_sizes(frame[1]) + sum_of_sizes(frame[2]);
  double step = kInfinity;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(start.degree[static_cast<std::size_t>(axis)] + 1);
    const double slope = static_cast<double>(n - 1);
    for (std::size_t i = 0; i < start.points.size(); ++i) {
      if (i / stride % n == 0) {
        continue;
      }
      const glm::dvec3 difference = slope * (start.points[i] - start.points[i - stride]);
      const glm::dvec3 column = frame * difference;
      const double lost =
          frame_size * (kRounding * sum_of_sizes(difference) + 6 * slope * start_error);
      const double excess =
          2 * column[axis] - sum_of_sizes(column) - (column[axis] < 0 ? kInfinity : 0) - lost;
      if (!(excess > 0)) {
        return 0;
      }
      if (motion != nullptr) {
        const glm::dvec3 moved = slope * (motion->points[i] - motion->points[i - stride]);
        const double change =
            sum_of_sizes(frame * moved) +
            frame_size * (kRounding * sum_of_sizes(moved) + 6 * slope * motion_error);
        step = change > 0 ? std::min(step, excess / change * (1 - 1e-12)) : step;
      }
    }
    stride *= n;
  }
  return step;
}

}  // namespace espalier
