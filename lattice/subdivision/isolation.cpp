/// Isolation of extraordinary lines. [DS78] the eigenvalues.

#include "lattice/subdivision/isolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier {
namespace {

/// What a leaf misses of x' and ∂x'/∂x in a cell of size 1 before any isolation, for moves of about
/// a cell; as measured for 3 to 10 cells.
constexpr double kPositionError = 0.1;
constexpr double kGradientError = 1;
constexpr double kGradientErrorOfThree = 3;

/// What differences of points of size 1 may lose to round-off, as certificates bound it.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
constexpr int kMostLevels = 60;

/// The largest eigenvalue at a vertex of valence n, of frequency k.
double eigenvalue(int n, int k) {
  const double angle = std::numbers::pi * k / n;
  const double c = std::cos(2 * angle);
  return (5 + c + std::cos(angle) * std::sqrt(2 * (9 + c))) / 16;
}

}  // namespace

IsolationRates isolation_rates(int n_cells, bool is_boundary) {
  const int n = is_boundary ? 2 * n_cells : n_cells;
  const double first = eigenvalue(n, 1);
  const double position = std::max(first * first, eigenvalue(n, 2));
  return {position, is_boundary ? 1 : position / first, first};
}

double levels_within(double tolerance, double error, double rate) {
  return std::ceil(std::log(tolerance / error) / std::log(rate));
}

int isolation_levels(const IsolationRates& rates, const LeafAccuracy& accuracy) {
  double levels = levels_within(accuracy.tolerance, kPositionError, rates.position);
  if (rates.gradient < 1) {
    const double largest = leaf_gradient_error(rates, 0);
    const double wanted = levels_within(accuracy.gradient_tolerance, largest, rates.gradient);
    // Round-off of differences between the points of a leaf grows as the leaf shrinks.
    const double rounding = kRounding * std::max(1.0, accuracy.coordinate_scale);
    const double possible =
        std::floor(std::log(rounding / largest) / std::log(rates.gradient * rates.size));
    levels = std::max(levels, std::min(wanted, possible));
  }
  return static_cast<int>(std::clamp(levels, 1.0, double{kMostLevels}));
}

double leaf_gradient_error(const IsolationRates& rates, int levels) {
  // Three cells are the only ones whose leaves shrink faster than by a half.
  const double first = rates.size < 0.5 ? kGradientErrorOfThree : kGradientError;
  return first * std::pow(rates.gradient, levels);
}

}  // namespace espalier
