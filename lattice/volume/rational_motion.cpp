// Quotients of polynomials subtracted: N/W − n/w = ((N − n) w − n (W − w)) / (W w).

#include "lattice/volume/rational_motion.h"

#include <cassert>
#include <vector>

#include "lattice/volume/bernstein.h"

namespace espalier {
namespace {

constexpr int kWeight = 3;

/// x, y, z of the numerators, or the weights.
BernsteinPolynomial component(const BezierView& patch, int which) {
  BernsteinPolynomial result{patch.degree, {}};
  result.coefficients.reserve(patch.points.size());
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const double weight = patch.is_rational() ? patch.weights[i] : 1;
    result.coefficients.push_back(which == kWeight ? weight : patch.points[i][which]);
  }
  return result;
}

}  // namespace

BezierPatch difference(const BezierView& a, const BezierView& b) {
  assert(a.degree == b.degree && !a.is_pyramid && !b.is_pyramid);
  const BernsteinPolynomial a_weight = component(a, kWeight);
  const BernsteinPolynomial b_weight = component(b, kWeight);
  const BernsteinPolynomial weight_change = a_weight - b_weight;
  const BernsteinPolynomial weight = a_weight * b_weight;
  BezierPatch result{weight.degree, std::vector<glm::dvec3>(weight.coefficients.size())};
  result.weights = weight.coefficients;
  for (int axis = 0; axis < 3; ++axis) {
    const BernsteinPolynomial b_part = component(b, axis);
    const BernsteinPolynomial part =
        (component(a, axis) - b_part) * b_weight - b_part * weight_change;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      result.points[i][axis] = part.coefficients[i];
    }
  }
  return result;
}

BezierPatch rational_motion(const Volume& volume, std::size_t i,
                            std::span<const glm::dvec3> displacements,
                            std::span<const double> weights) {
  BezierPatch posed;
  BezierPatch moves;
  volume.bezier(i, volume.rest_points(), weights, posed);
  volume.bezier(i, displacements, weights, moves);
  for (std::size_t k = 0; k < posed.points.size(); ++k) {
    posed.points[k] += moves.points[k];
  }
  return difference(posed, volume.bezier(i, volume.rest_points()));
}

}  // namespace espalier
