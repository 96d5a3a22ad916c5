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

/// What a unit of motion takes from a column's dominance: growth of its own component adds to it.
double taken_by(const glm::dvec3& moved, int axis) {
  return sum_of_sizes(moved) - std::abs(moved[axis]) - moved[axis];
}

/// The frame: any matrix serves whose determinant is surely positive.
bool find_frame(const BezierView& patch, glm::dmat3& frame) {
  const glm::dmat3 middle = patch.derivative(glm::dvec3(0.5));
  frame = glm::inverse(middle);
  const double sizes = sum_of_sizes(frame[0]) * sum_of_sizes(frame[1]) * sum_of_sizes(frame[2]);
  return glm::determinant(frame) > 1e-9 * sizes && std::isfinite(sizes);
}

/// Of the size, in the frame, of all values of a patch about a centre; without weights 0, as then
/// nothing depends on it.
double reach_of(const BezierView& patch, const glm::dmat3& frame, const glm::dvec3& centre) {
  double reach = 0;
  for (std::size_t i = 0; i < patch.weights.size(); ++i) {
    reach = std::max(reach, sum_of_sizes(frame * (patch.position(i) - centre)));
  }
  return reach;
}

/// Differences of a patch's numerators about a centre, and of its weights, along an axis.
struct Differences {
  BezierView patch;
  glm::dvec3 centre;
  std::size_t stride;
  double slope;

  [[nodiscard]] glm::dvec3 of_points(std::size_t i) const {
    const glm::dvec3 difference = patch.points[i] - patch.points[i - stride];
    return slope * (patch.is_rational() ? difference - of_weights(i) / slope * centre : difference);
  }
  [[nodiscard]] double of_weights(std::size_t i) const {
    return patch.is_rational() ? slope * (patch.weights[i] - patch.weights[i - stride]) : 0;
  }
};

}  // namespace

double dominant_step(const BezierView& start, const BezierPatch* motion,
                     const PatchErrors& errors) {
  constexpr double kRounding = 1e-13;  // of a product of 3 × 3 numbers, amply
  glm::dmat3 frame;
  if (start.is_pyramid || !find_frame(start, frame)) {
    return 0;
  }
  const double frame_size =
      sum_of_sizes(frame[0]) + sum_of_sizes(frame[1]) + sum_of_sizes(frame[2]);
  const glm::dvec3 centre = start.is_rational() ? start.value(glm::dvec3(0.5)) : glm::dvec3(0);
  const double reach = reach_of(start, frame, centre) * (1 + 1e-9);
  const double motion_reach =
      motion == nullptr ? 0 : reach_of(*motion, frame, glm::dvec3(0)) * (1 + 1e-9);
  // Taking the centre away costs as much again as the numbers are off, a few times.
  const double n_errors = start.is_rational() ? 24 : 6;
  double step = kInfinity;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(start.degree[static_cast<std::size_t>(axis)] + 1);
    const double slope = static_cast<double>(n - 1);
    const Differences differences{start, centre, stride, slope};
    for (std::size_t i = 0; i < start.points.size(); ++i) {
      if (i / stride % n == 0) {
        continue;
      }
      const glm::dvec3 difference = differences.of_points(i);
      const glm::dvec3 column = frame * difference;
      const double weight_slope =
          std::abs(differences.of_weights(i)) * (1 + kRounding) + 2 * slope * errors.weights;
      const double lost =
          frame_size * (kRounding * sum_of_sizes(difference) + n_errors * slope * errors.start) +
          weight_slope * reach;
      const double excess =
          2 * column[axis] - sum_of_sizes(column) - (column[axis] < 0 ? kInfinity : 0) - lost;
      if (!(excess > 0)) {
        return 0;
      }
      if (motion != nullptr) {
        const glm::dvec3 moved = slope * (motion->points[i] - motion->points[i - stride]);
        const double change =
            taken_by(frame * moved, axis) + weight_slope * motion_reach +
            frame_size * (kRounding * sum_of_sizes(moved) + 6 * slope * errors.motion);
        step = change > 0 ? std::min(step, excess / change * (1 - 1e-12)) : step;
      }
    }
    stride *= n;
  }
  return step;
}

}  // namespace espalier
