// Values, derivatives and parts of Bézier hexahedra.

#include "lattice/volume/bezier_patch.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "lattice/volume/bernstein_lines.h"
#include "lattice/volume/bezier_evaluator.h"

namespace espalier {
namespace {

/// Makes the points at w = 1 one again, after round-off.
void restore_apex(BezierPatch& patch) {
  const auto n = static_cast<std::ptrdiff_t>(patch.points.size()) / (patch.degree[2] + 1);
  std::fill(patch.points.end() - n, patch.points.end(), patch.points.back());
}

/// A scalar polynomial's value and slopes at a place.
struct ScalarJet {
  double value = 0;
  glm::dvec3 slopes{0};
};

/// Of the weights' polynomial Σ B w.
ScalarJet weight_jet(const BezierView& patch, const glm::dvec3& uvw) {
  assert(patch.weights.size() == patch.points.size() && !patch.is_pyramid);
  const std::array<int, 3>& degree = patch.degree;
  const int most = std::max({degree[0], degree[1], degree[2]});
  const auto n = static_cast<std::size_t>(most + 1);
  Scratch<48> numbers(6 * n);
  const auto values = [&](std::size_t axis) { return numbers.data() + 2 * axis * n; };
  const auto slopes = [&](std::size_t axis) { return values(axis) + n; };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bernstein_basis(degree[axis], uvw[static_cast<int>(axis)], values(axis), slopes(axis));
  }
  ScalarJet jet;
  const double* weight = patch.weights.data();
  for (int k = 0; k <= degree[2]; ++k) {
    ScalarJet plane;
    for (int j = 0; j <= degree[1]; ++j) {
      double row = 0;
      double row_slope = 0;
      for (int i = 0; i <= degree[0]; ++i, ++weight) {
        row += values(0)[i] * *weight;
        row_slope += slopes(0)[i] * *weight;
      }
      plane.value += values(1)[j] * row;
      plane.slopes.x += values(1)[j] * row_slope;
      plane.slopes.y += slopes(1)[j] * row;
    }
    jet.value += values(2)[k] * plane.value;
    jet.slopes.x += values(2)[k] * plane.slopes.x;
    jet.slopes.y += values(2)[k] * plane.slopes.y;
    jet.slopes.z += slopes(2)[k] * plane.value;
  }
  return jet;
}

/// Applies `make`, which works on lines of doubles and of vectors alike, to all lines of an axis.
template <class Make>
void replace_lines(BezierPatch& patch, int axis, const Make& make) {
  if (!patch.weights.empty()) {
    std::array<int, 3> degree = patch.degree;
    patch.weights = with_lines<double>(degree, patch.weights, axis, make);
  }
  patch.points = with_lines<glm::dvec3>(patch.degree, patch.points, axis, make);
}

}  // namespace

glm::dvec3 BezierView::value(const glm::dvec3& uvw) const {
  const glm::dvec3 sum =
      with_evaluator(*this, [&](const auto& evaluator) { return evaluator.value(uvw); });
  return is_rational() ? sum / weight_jet(*this, uvw).value : sum;
}

glm::dmat3 BezierView::derivative(const glm::dvec3& uvw) const {
  glm::dvec3 value;
  glm::dmat3 result;
  evaluate(uvw, value, result);
  return result;
}

void BezierView::evaluate(const glm::dvec3& uvw, glm::dvec3& value, glm::dmat3& derivative) const {
  with_evaluator(*this, [&](const auto& evaluator) { evaluator.evaluate(uvw, value, derivative); });
  if (is_rational()) {
    const ScalarJet weight = weight_jet(*this, uvw);
    value /= weight.value;
    for (int axis = 0; axis < 3; ++axis) {
      derivative[axis] = (derivative[axis] - weight.slopes[axis] * value) / weight.value;
    }
  }
}

Box BezierView::hull_box() const {
  if (!is_rational()) {
    return box_of(points);
  }
  Box box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    box.add(position(i));
  }
  return box;
}

BezierPatch BezierPatch::part(const glm::dvec3& low, const glm::dvec3& high) const {
  BezierPatch result = *this;
  for (int axis = 0; axis < 3; ++axis) {
    replace_lines(result, axis,
                  [&](const auto& line) { return part_of_line(line, low[axis], high[axis]); });
  }
  result.is_pyramid = is_pyramid && high.z == 1;
  if (result.is_pyramid) {
    restore_apex(result);
  }
  return result;
}

BezierPatch BezierPatch::elevated(int axis, int new_degree) const {
  BezierPatch result = *this;
  while (result.degree[static_cast<std::size_t>(axis)] < new_degree) {
    replace_lines(result, axis, [](const auto& line) { return elevated_line(line); });
  }
  if (result.is_pyramid) {
    restore_apex(result);
  }
  return result;
}

}  // namespace espalier
