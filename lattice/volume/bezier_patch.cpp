// Values, derivatives and parts of Bézier hexahedra.

#include "lattice/volume/bezier_patch.h"

#include <algorithm>

#include "lattice/volume/bernstein_lines.h"
#include "lattice/volume/bezier_evaluator.h"

namespace espalier {
namespace {

/// Makes the points at w = 1 one again, after round-off.
void restore_apex(BezierPatch& patch) {
  const auto n = static_cast<std::ptrdiff_t>(patch.points.size()) / (patch.degree[2] + 1);
  std::fill(patch.points.end() - n, patch.points.end(), patch.points.back());
}

}  // namespace

glm::dvec3 BezierView::value(const glm::dvec3& uvw) const {
  return with_evaluator(*this, [&](const auto& evaluator) { return evaluator.value(uvw); });
}

glm::dmat3 BezierView::derivative(const glm::dvec3& uvw) const {
  glm::dvec3 value;
  glm::dmat3 result;
  evaluate(uvw, value, result);
  return result;
}

void BezierView::evaluate(const glm::dvec3& uvw, glm::dvec3& value, glm::dmat3& derivative) const {
  with_evaluator(*this, [&](const auto& evaluator) { evaluator.evaluate(uvw, value, derivative); });
}

BezierPatch BezierPatch::part(const glm::dvec3& low, const glm::dvec3& high) const {
  BezierPatch result = *this;
  for (int axis = 0; axis < 3; ++axis) {
    result.points = with_lines<glm::dvec3>(result.degree, result.points, axis,
                                           [&](std::span<const glm::dvec3> line) {
                                             return part_of_line(line, low[axis], high[axis]);
                                           });
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
    result.points =
        with_lines<glm::dvec3>(result.degree, result.points, axis, elevated_line<glm::dvec3>);
  }
  if (result.is_pyramid) {
    restore_apex(result);
  }
  return result;
}

}  // namespace espalier
