#include "lattice/volume/extraction.h"

#include <gtest/gtest.h>

#include <array>

namespace espalier {
namespace {

/// The weight of a coefficient at t: a Bézier polynomial.
double weight(const Extraction& extraction, int coefficient, double t) {
  const double s = 1 - t;
  const std::array<double, 4> basis = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    sum += basis[static_cast<std::size_t>(i)] * extraction.row(i, coefficient);
  }
  return sum;
}

constexpr std::array<double, 5> kTimes = {0, 0.2, 0.5, 0.75, 1};

TEST(UniformCubicExtraction, is_the_uniform_b_spline_inside) {
  const Extraction inside = uniform_cubic_extraction(false, false);
  ASSERT_EQ(inside.n_coefficients, 4);
  for (const double t : kTimes) {
    const double s = 1 - t;
    EXPECT_NEAR(weight(inside, 0, t), s * s * s / 6, 1e-16);
    EXPECT_NEAR(weight(inside, 1, t), (3 * t * t * t - 6 * t * t + 4) / 6, 4e-16);
    EXPECT_NEAR(weight(inside, 2, t), (3 * s * s * s - 6 * s * s + 4) / 6, 4e-16);
    EXPECT_NEAR(weight(inside, 3, t), t * t * t / 6, 1e-16);
  }
}

TEST(UniformCubicExtraction, folds_the_phantom_point_into_a_natural_end) {
  const Extraction begin = uniform_cubic_extraction(true, false);
  const Extraction end = uniform_cubic_extraction(false, true);
  const Extraction both = uniform_cubic_extraction(true, true);
  ASSERT_EQ(begin.n_coefficients, 3);
  ASSERT_EQ(end.n_coefficients, 3);
  ASSERT_EQ(both.n_coefficients, 2);
  for (const double t : kTimes) {
    const std::array<double, 3> expected = {1 - t + t * t * t / 6, t - t * t * t / 3,
                                            t * t * t / 6};
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(weight(begin, i, t), expected[static_cast<std::size_t>(i)], 3e-16);
      EXPECT_NEAR(weight(end, 2 - i, 1 - t), expected[static_cast<std::size_t>(i)], 3e-16);
    }
    EXPECT_NEAR(weight(both, 0, t), 1 - t, 3e-16);
    EXPECT_NEAR(weight(both, 1, t), t, 3e-16);
  }
}

TEST(Extraction, rows_sum_to_one) {
  for (const Extraction& extraction :
       {bezier_extraction(0), bezier_extraction(1), bezier_extraction(4),
        uniform_cubic_extraction(false, false), uniform_cubic_extraction(true, false),
        uniform_cubic_extraction(false, true), uniform_cubic_extraction(true, true)}) {
    for (int i = 0; i <= extraction.degree; ++i) {
      double sum = 0;
      for (int k = 0; k < extraction.n_coefficients; ++k) {
        sum += extraction.row(i, k);
      }
      EXPECT_NEAR(sum, 1, 3e-16);
    }
  }
}

TEST(UniformCubicExtraction, joins_neighbouring_intervals_twice_differentiably) {
  // Bézier points of two intervals over five coefficients; the first may begin naturally, the
  // second end so.
  for (const bool natural : {false, true}) {
    const Extraction before = uniform_cubic_extraction(natural, false);
    const Extraction after = uniform_cubic_extraction(false, natural);
    const auto left = [&](int point, int k) {  // coefficients 0 … 3, or 1 … 3
      const int column = natural ? k - 1 : k;
      return column >= 0 && column < before.n_coefficients ? before.row(point, column) : 0;
    };
    const auto right = [&](int point, int k) {  // coefficients 1 … 4, or 1 … 3
      return k >= 1 && k - 1 < after.n_coefficients ? after.row(point, k - 1) : 0;
    };
    for (int k = 0; k < 5; ++k) {
      EXPECT_NEAR(left(3, k), right(0, k), 1e-16);
      EXPECT_NEAR(left(3, k) - left(2, k), right(1, k) - right(0, k), 1e-16);
      EXPECT_NEAR(left(3, k) - 2 * left(2, k) + left(1, k),
                  right(2, k) - 2 * right(1, k) + right(0, k), 4e-16);
    }
  }
}

TEST(BezierExtraction, is_the_identity) {
  const Extraction extraction = bezier_extraction(3);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(extraction.row(i, k), i == k ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace espalier
