#include "deform/injectivity/determinant_nets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <random>

#include "deform/injectivity/positivity.h"
#include "lattice/volume/bernstein.h"
#include "lattice/volume/bernstein_lines.h"
#include "tests/support/exact_nets.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

using test::exact_determinant;
using test::exact_value;
using test::ExactNet;
using test::Integer;
using test::IntegerPoint;
using test::random_points;

/// The same shape with large odd factors, exact in double, so that products are rounded.
BezierPatch rounded_patch(int degree, const std::vector<IntegerPoint>& points,
                          const IntegerPoint& factors) {
  BezierPatch patch{{degree, degree, degree}, {}, false};
  for (const IntegerPoint& p : points) {
    patch.points.emplace_back(static_cast<double>(p[0] * factors[0]),
                              static_cast<double>(p[1] * factors[1]),
                              static_cast<double>(p[2] * factors[2]));
  }
  return patch;
}

constexpr IntegerPoint kFactors = {(1LL << 39) + 12345677, (1LL << 38) + 987654321,
                                   (1LL << 37) + 55555};

TEST(DeterminantNets, hold_the_exact_coefficients_within_their_error) {
  std::mt19937 random(5);
  DeterminantNets nets;
  BoundedPolynomial found;
  double largest_use = 0;
  for (const int degree : {1, 2, 3, 4}) {
    for (int number = 0; number < 10; ++number) {
      const auto points = random_points(degree, number, random);
      const ExactNet exact = exact_determinant(degree, points);
      nets.determinant(rounded_patch(degree, points, kFactors), {}, 0, found);
      ASSERT_EQ(found.shape.size, exact.size);
      const long double factor = static_cast<long double>(kFactors[0]) *
                                 static_cast<long double>(kFactors[1]) *
                                 static_cast<long double>(kFactors[2]);
      const double use = test::used_part_of_error(exact, factor, found.coefficients, found.error);
      ASSERT_LE(use, 1);
      largest_use = std::max(largest_use, use);
    }
  }
  EXPECT_GT(largest_use, 1e-4);  // there was rounding to bound, and the bound is no joke
}

TEST(DeterminantNets, never_certify_what_exact_integers_see_fold) {
  std::mt19937 random(17);
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  int n_certified = 0;
  int n_folded = 0;
  int n_singular = 0;
  for (int number = 0; number < 10000; ++number) {
    const int degree = number % 100 == 1 || number % 100 == 2 ? 3 : number % 10 < 2 ? 2 : 1;
    const auto points = random_points(degree, number / 2, random);
    nets.determinant(rounded_patch(degree, points, kFactors), {}, 0, polynomial);
    const Positivity found = positivity(polynomial, 32);
    const ExactNet exact = exact_determinant(degree, points);
    if (found.verdict == Verdict::Certified) {
      ++n_certified;
      for (int a = 0; a <= 4; a += degree == 3 ? 4 : 2) {
        for (int b = 0; b <= 4; b += degree == 3 ? 4 : 2) {
          for (int c = 0; c <= 4; c += degree == 3 ? 4 : 2) {
            ASSERT_GT(exact_value(exact, {a, b, c}), 0) << "pose " << number;
          }
        }
      }
    }
    n_singular += exact.values[0] == 0 ? 1 : 0;
    if (found.verdict == Verdict::Folded) {
      ++n_folded;
      ASSERT_TRUE(std::any_of(exact.values.begin(), exact.values.end(),
                              [](Integer value) { return value < 0; }))
          << "pose " << number;
    }
  }
  EXPECT_GT(n_certified, 1500);
  EXPECT_GT(n_folded, 500);
  EXPECT_GT(n_singular, 2500);
}

TEST(DeterminantNets, of_pyramids_stay_regular_at_the_apex) {
  const BezierPatch pyramid = test::warped_cube({2, 3, 2}, 0.02, 4, true);
  const Collapse collapse = common_collapse(pyramid, pyramid);
  EXPECT_TRUE(collapse.has(0, 2, 1));
  EXPECT_TRUE(collapse.has(1, 2, 1));
  EXPECT_FALSE(collapse.has(2, 2, 1));
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  nets.determinant(pyramid, collapse, 0, polynomial);
  EXPECT_EQ(polynomial.shape.size, (std::array<int, 3>{6, 9, 4}));
  const BernsteinPolynomial determinant{{5, 8, 3}, polynomial.coefficients};
  for (const glm::dvec3 uvw : {glm::dvec3(0.3, 0.7, 0.2), glm::dvec3(0.5, 0.1, 1)}) {
    EXPECT_NEAR(determinant.value(uvw), glm::determinant(pyramid.derivative(uvw)), 1e-13);
  }
  EXPECT_EQ(positivity(polynomial, 500).verdict, Verdict::Certified);
}

TEST(DeterminantNets, of_moving_patches_are_cubic_in_time) {
  const BezierPatch start = test::warped_cube({3, 2, 3}, 0.05, 1);
  BezierPatch motion = test::warped_cube({3, 2, 3}, 0.3, 2);
  DeterminantNets nets;
  std::array<BoundedPolynomial, 4> powers;
  nets.moving_determinant({start, motion, false, 0, 0}, {}, powers);
  const glm::dvec3 uvw(0.3, 0.8, 0.45);
  for (const double t : {-0.7, 0.4, 2.0}) {
    double value = 0;
    for (std::size_t k = 4; k-- > 0;) {
      value = value * t + BernsteinPolynomial{{8, 5, 8}, powers[k].coefficients}.value(uvw);
    }
    const glm::dmat3 moved = start.derivative(uvw) + t * motion.derivative(uvw);
    EXPECT_NEAR(value, glm::determinant(moved), 1e-12 * (1 + std::abs(t * t * t)));
  }
}

}  // namespace
}  // namespace espalier
