#include "deform/evaluate/affine_drag.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "deform/evaluate/displace.h"
#include "deform/evaluate/first_zero.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kPointsPerRange = 4096;
constexpr double kFarthest = 1e12;

/// Sum of the products of entries.
double dot(const glm::dmat3& a, const glm::dmat3& b) {
  return glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]) + glm::dot(a[2], b[2]);
}

/// Of det(J + t B), from the constant on.
std::array<double, 4> determinant_polynomial(const glm::dmat3& J, const glm::dmat3& B) {
  return {glm::determinant(J), dot(cofactors(J), B), dot(J, cofactors(B)), glm::determinant(B)};
}

void require_near(const glm::dmat3& map) {
  for (int column = 0; column < 3; ++column) {
    if (!(glm::length(map[column]) <= kFarthest)) {
      throw ParameterError("column " + std::to_string(column) +
                           " of the map is not finite or longer than 1e12");
    }
  }
}

}  // namespace

template <class Real>
AffineDrag<Real>::AffineDrag(const DragModel& model, const AffineSelection& selection)
    : n_points_(model.rest_points.size()), has_folds_(model.has_fold_check) {
  require_valid(model, selection.weights);
  if (selection.controls.size() != selection.weights.size()) {
    throw ParameterError("a selection of " + std::to_string(selection.weights.size()) +
                         " control points given with " + std::to_string(selection.controls.size()) +
                         " places");
  }
  std::vector<glm::dvec3> vectors(selection.weights.size());
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = selection.weights[i] * (selection.controls[i] - selection.pivot);
    if (!std::isfinite(glm::length(vectors[i]))) {
      throw ParameterError("control point " + std::to_string(i) +
                           " or the pivot is not at a finite place");
    }
  }
  const DragStart start = drag_start(model);
  const DragField field = drag_field(model, vectors);
  for (std::size_t i = 0; i < n_points_; ++i) {
    const bool has_slopes = !field.slopes.empty();
    if (field.values[i] == glm::dvec3(0) && !(has_slopes && field.slopes[i] != glm::dmat3(0))) {
      continue;
    }
    reached_.push_back(static_cast<std::uint32_t>(i));
    points_.push_back(start.points[i]);
    values_.push_back(field.values[i]);
    if (has_slopes) {
      gradients_.push_back(start.gradients[i]);
      slopes_.push_back(field.slopes[i]);
    }
    if (!model.normals.empty()) {
      normals_.push_back(model.normals[i]);
    }
  }
}

template <class Real>
double AffineDrag<Real>::safe_fraction(const glm::dmat3& map, double margin) const {
  require_near(map);
  const glm::dmat3 change = map - glm::dmat3(1);
  require_margin(margin);
  if (!has_folds_) {
    throw ParameterError("the drag was begun without a fold check");
  }
  std::atomic<double> first = 1;
  const auto check = [&](std::size_t i) {
    std::array<double, 4> determinant = determinant_polynomial(gradients_[i], change * slopes_[i]);
    if (!(determinant[0] >= kLeastDeterminant)) {
      return;  // folded at mouse-down
    }
    determinant[0] *= 1 - std::max(margin, kLeastDeterminant);
    if (const auto zero = first_zero(determinant)) {
      const double fraction = *zero * (1 - kFoldGuard);
      double least = first;
      while (fraction < least && !first.compare_exchange_weak(least, fraction)) {
      }
    }
  };
  parallel_for(reached_.size(), check, kPointsPerRange);
  return first;
}

template <class Real>
AffineStep AffineDrag<Real>::update(const glm::dmat3& map, std::optional<double> margin,
                                    const DraggedPoints<Real>& out) const {
  require_near(map);
  require_possible(out);
  AffineStep step;
  step.fraction = margin ? safe_fraction(map, *margin) : 1;
  const glm::dmat3 change = step.fraction * (map - glm::dmat3(1));
  step.map = glm::dmat3(1) + change;
  parallel_for(
      reached_.size(), [&](std::size_t i) { write(i, change, out); }, kPointsPerRange);
  return step;
}

template <class Real>
void AffineDrag<Real>::write(std::size_t i, const glm::dmat3& change,
                             const DraggedPoints<Real>& out) const {
  const std::size_t point = reached_[i];
  if (!out.points.empty()) {
    out.points[point] = glm::vec<3, Real>(points_[i] + change * values_[i]);
  }
  if (out.normals.empty() && out.folded.empty()) {
    return;
  }
  const glm::dmat3 J = gradients_[i] + change * slopes_[i];
  if (!out.normals.empty()) {
    out.normals[point] = glm::vec<3, Real>(turned_normal(J, normals_[i]));
  }
  if (!out.folded.empty()) {
    out.folded[point] = static_cast<std::uint8_t>(glm::determinant(J) <= 0);
  }
}

template <class Real>
void AffineDrag<Real>::require_possible(const DraggedPoints<Real>& out) const {
  require_fits(out, n_points_, !normals_.empty() || reached_.empty(), has_folds_);
}

template class AffineDrag<float>;
template class AffineDrag<double>;

}  // namespace espalier
