/// The first zero of a cubic polynomial, by the intervals between its extrema.

#include "deform/evaluate/first_zero.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier {
namespace {

double value(const std::array<double, 4>& c, double t) {
  return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
}

/// Where a + b t + c t² is zero, ascending; not finite where it is not. Free of cancellation.
std::pair<double, double> quadratic_zeros(double a, double b, double c) {
  const double root = std::sqrt(std::max(b * b - 4 * a * c, 0.0));
  const double q = -0.5 * (b + std::copysign(root, b));
  return std::minmax(q / c, a / q);
}

}  // namespace

std::optional<double> first_zero(const std::array<double, 4>& c) {
  if (!(c[0] > 0)) {
    return 0.0;
  }
  // Its Bernstein coefficients bound it.
  if (c[0] + c[1] / 3 > 0 && c[0] + (2 * c[1] + c[2]) / 3 > 0 && value(c, 1) > 0) {
    return std::nullopt;
  }
  const std::pair<double, double> extrema = quadratic_zeros(c[1], 2 * c[2], 3 * c[3]);
  double low = 0;
  for (double high : {extrema.first, extrema.second, 1.0}) {
    if (!(high > low && high <= 1)) {
      continue;
    }
    if (value(c, high) > 0) {
      low = high;
      continue;
    }
    for (double middle = (low + high) / 2; middle > low && middle < high;
         middle = (low + high) / 2) {
      (value(c, middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  return std::nullopt;
}

}  // namespace espalier
