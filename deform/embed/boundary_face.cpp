#include "deform/embed/boundary_face.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

namespace espalier {
namespace {

constexpr int kMostSteps = 60;
constexpr int kMostHalvings = 40;

/// A curve's point and its first two derivatives.
struct CurveJet {
  glm::dvec3 value, first, second;
};

/// By de Casteljau's algorithm in place.
CurveJet curve_jet(std::span<glm::dvec3> points, double t) {
  const std::size_t n = points.size() - 1;
  CurveJet jet{points[0], glm::dvec3(0), glm::dvec3(0)};
  for (std::size_t last = n; last > 0; --last) {
    if (last == 2) {
      jet.second = static_cast<double>(n * (n - 1)) * (points[0] - 2.0 * points[1] + points[2]);
    } else if (last == 1) {
      jet.first = static_cast<double>(n) * (points[1] - points[0]);
    }
    for (std::size_t i = 0; i < last; ++i) {
      points[i] = (1 - t) * points[i] + t * points[i + 1];
    }
  }
  jet.value = points[0];
  return jet;
}

/// A symmetric 2 × 2 matrix.
struct Symmetric {
  double ss = 0;
  double st = 0;
  double tt = 0;
};

/// A⁻¹ b over the free parameters; 0 for the others. Nothing is free, or A is positive definite
/// there.
glm::dvec2 solve(const Symmetric& A, const glm::dvec2& b, const glm::bvec2& is_free) {
  if (is_free.x && is_free.y) {
    const double determinant = A.ss * A.tt - A.st * A.st;
    return {(A.tt * b.x - A.st * b.y) / determinant, (A.ss * b.y - A.st * b.x) / determinant};
  }
  return {is_free.x ? b.x / A.ss : 0.0, is_free.y ? b.y / A.tt : 0.0};
}

bool is_definite(const Symmetric& A, const glm::bvec2& is_free) {
  const bool is_positive = (!is_free.x || A.ss > 0) && (!is_free.y || A.tt > 0);
  return is_positive &&
         (!(is_free.x && is_free.y) || A.ss * A.tt - A.st * A.st > 1e-12 * A.ss * A.tt);
}

}  // namespace

BoundaryFace::BoundaryFace(const BezierView& patch, int face) : face_(face) {
  const int axis = face / 2;
  axes_ = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
  degree_ = {patch.degree[axes_[0]], patch.degree[axes_[1]]};
  const std::array<int, 3> stride = {1, patch.degree[0] + 1,
                                     (patch.degree[0] + 1) * (patch.degree[1] + 1)};
  const int first = face % 2 == 0 ? 0 : patch.degree[axis] * stride[axis];
  for (int j = 0; j <= degree_[1]; ++j) {
    for (int i = 0; i <= degree_[0]; ++i) {
      const auto at = static_cast<std::size_t>(first + i * stride[axes_[0]] + j * stride[axes_[1]]);
      points_.push_back(patch.points[at]);
      if (patch.is_rational()) {
        weights_.emplace_back(patch.weights[at]);
      }
    }
  }
  for (int j = 0; j < n_samples(1); ++j) {
    for (int i = 0; i < n_samples(0); ++i) {
      samples_.push_back(
          jet(glm::dvec2(i, j) / glm::dvec2(n_samples(0) - 1, n_samples(1) - 1)).value);
    }
  }
}

glm::dvec3 BoundaryFace::uvw(const glm::dvec2& st) const {
  glm::dvec3 result(face_ % 2);
  result[axes_[0]] = st.x;
  result[axes_[1]] = st.y;
  return result;
}

Box BoundaryFace::hull_box() const {
  Box box;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    box.add(weights_.empty() ? points_[i] : points_[i] / weights_[i]);
  }
  return box;
}

BoundaryFace::Jet BoundaryFace::jet(const glm::dvec2& st) const {
  const Jet sum = polynomial_jet(points_, st);
  if (weights_.empty()) {
    return sum;
  }
  const Jet weight = polynomial_jet(weights_, st);
  Jet jet;
  jet.value = sum.value / weight.value;
  jet.s = (sum.s - weight.s * jet.value) / weight.value;
  jet.t = (sum.t - weight.t * jet.value) / weight.value;
  jet.ss = (sum.ss - 2.0 * weight.s * jet.s - weight.ss * jet.value) / weight.value;
  jet.st = (sum.st - weight.s * jet.t - weight.t * jet.s - weight.st * jet.value) / weight.value;
  jet.tt = (sum.tt - 2.0 * weight.t * jet.t - weight.tt * jet.value) / weight.value;
  return jet;
}

BoundaryFace::Jet BoundaryFace::polynomial_jet(const std::vector<glm::dvec3>& points,
                                               const glm::dvec2& st) const {
  const auto n_rows = static_cast<std::size_t>(degree_[1]) + 1;
  const auto n = static_cast<std::size_t>(degree_[0]) + 1;
  std::vector<glm::dvec3> row(n);
  std::vector<glm::dvec3> columns(3 * n_rows);
  const std::span values(columns.data(), n_rows);
  const std::span firsts(columns.data() + n_rows, n_rows);
  const std::span seconds(columns.data() + 2 * n_rows, n_rows);
  for (std::size_t j = 0; j < n_rows; ++j) {
    std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(j * n), n, row.begin());
    const CurveJet along = curve_jet(row, st.x);
    values[j] = along.value;
    firsts[j] = along.first;
    seconds[j] = along.second;
  }
  const CurveJet value = curve_jet(values, st.y);
  const CurveJet s = curve_jet(firsts, st.y);
  const CurveJet ss = curve_jet(seconds, st.y);
  return {value.value, s.value, value.first, ss.value, s.first, value.second};
}

glm::dvec2 BoundaryFace::closest_sample(const glm::dvec3& x) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const glm::dvec3 to = samples_[i] - x;
    if (const double square = glm::dot(to, to); square < least) {
      least = square;
      best = i;
    }
  }
  const auto n = static_cast<std::size_t>(n_samples(0));
  return glm::dvec2(best % n, best / n) / glm::dvec2(n_samples(0) - 1, n_samples(1) - 1);
}

bool BoundaryFace::is_better(const glm::dvec3& from, const glm::dvec2& slope, const Jet& there,
                             const glm::dvec3& x, const glm::bvec2& is_free) {
  constexpr double kRoundOff = 1e-15;
  const glm::dvec3 to = there.value - x;
  if (glm::length(to) < (1 - kRoundOff) * glm::length(from)) {
    return true;
  }
  const glm::dvec2 free(is_free);
  return glm::length(to) <= (1 + kRoundOff) * glm::length(from) &&
         glm::length(free * glm::dvec2(glm::dot(to, there.s), glm::dot(to, there.t))) <
             glm::length(free * slope);
}

BoundaryFace::Closest BoundaryFace::closest(const glm::dvec3& x) const {
  glm::dvec2 at = closest_sample(x);
  Jet here = jet(at);
  Symmetric hessian;
  glm::bvec2 is_free(true);
  for (int step = 0; step < kMostSteps; ++step) {
    const glm::dvec3 from = here.value - x;
    const glm::dvec2 slope(glm::dot(from, here.s), glm::dot(from, here.t));
    const Symmetric flat = {glm::dot(here.s, here.s), glm::dot(here.s, here.t),
                            glm::dot(here.t, here.t)};
    hessian = {flat.ss + glm::dot(from, here.ss), flat.st + glm::dot(from, here.st),
               flat.tt + glm::dot(from, here.tt)};
    for (int axis = 0; axis < 2; ++axis) {  // held where the descent leads out of the face
      is_free[axis] = !(at[axis] <= 0 && slope[axis] >= 0) && !(at[axis] >= 1 && slope[axis] <= 0);
    }
    if (!is_definite(hessian, is_free)) {
      const double damping = 1e-3 * std::max(flat.ss, flat.tt) + 1e-300;
      hessian = {flat.ss + damping, flat.st, flat.tt + damping};
    }
    const glm::dvec2 wanted = solve(hessian, slope, is_free);
    double scale = 1;
    bool is_closer = false;
    for (int halving = 0; halving < kMostHalvings && !is_closer; ++halving, scale *= 0.5) {
      const glm::dvec2 next = glm::clamp(at - scale * wanted, 0.0, 1.0);
      const Jet there = jet(next);
      if (is_better(from, slope, there, x, is_free)) {
        at = next;
        here = there;
        is_closer = true;
      }
      if (glm::length(scale * wanted) < 1e-15) {
        break;
      }
    }
    if (!is_closer || glm::length(scale * wanted) < 1e-12) {
      break;
    }
  }
  Closest result{at, here.value, glm::distance(here.value, x), {}};
  const glm::dvec2 by_s = solve(hessian, {1, 0}, is_free);
  const glm::dvec2 by_t = solve(hessian, {0, 1}, is_free);
  // d(st)/dx = H⁻¹ (F_s, F_t)ᵀ over the free parameters.
  if (is_free.x) {
    result.slopes[0] = by_s.x * here.s + (is_free.y ? by_t.x * here.t : glm::dvec3(0));
  }
  if (is_free.y) {
    result.slopes[1] = by_t.y * here.t + (is_free.x ? by_s.y * here.s : glm::dvec3(0));
  }
  return result;
}

}  // namespace espalier
