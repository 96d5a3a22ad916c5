#include "lattice/volume/bernstein.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lattice/volume/bernstein_lines.h"

namespace espalier {
namespace {

BernsteinPolynomial random_polynomial(const std::array<int, 3>& degree, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  BernsteinPolynomial polynomial{degree, std::vector<double>(n_coefficients(degree))};
  for (double& coefficient : polynomial.coefficients) {
    coefficient = unit(random);
  }
  return polynomial;
}

const std::vector<glm::dvec3> kPlaces = {{0, 0, 0},       {1, 1, 1},      {0.3, 0.6, 0.2},
                                         {0.9, 0.1, 0.5}, {0.25, 1, 0.7}, {-0.2, 1.1, 0.4}};

TEST(Binomial, is_that_of_pascals_triangle) {
  EXPECT_EQ(binomial(0, 0), 1);
  for (int n = 1; n <= 30; ++n) {
    for (int k = 1; k < n; ++k) {
      EXPECT_EQ(binomial(n, k), binomial(n - 1, k - 1) + binomial(n - 1, k));
    }
  }
}

TEST(Bernstein, value_is_the_sum_of_weighted_coefficients) {
  const BernsteinPolynomial a = random_polynomial({2, 1, 3}, 1);
  for (const glm::dvec3& at : kPlaces) {
    double sum = 0;
    for (int k = 0; k <= 3; ++k) {
      for (int j = 0; j <= 1; ++j) {
        for (int i = 0; i <= 2; ++i) {
          const auto basis = [](int n, int l, double t) {
            return binomial(n, l) * std::pow(t, l) * std::pow(1 - t, n - l);
          };
          sum += a.coefficients[static_cast<std::size_t>(i + 3 * (j + 2 * k))] * basis(2, i, at.x) *
                 basis(1, j, at.y) * basis(3, k, at.z);
        }
      }
    }
    EXPECT_NEAR(a.value(at), sum, 1e-14);
  }
}

TEST(Bernstein, sums_and_products_are_those_of_the_values) {
  const BernsteinPolynomial a = random_polynomial({2, 1, 3}, 1);
  const BernsteinPolynomial b = random_polynomial({2, 1, 3}, 2);
  const BernsteinPolynomial c = random_polynomial({1, 4, 0}, 3);
  const BernsteinPolynomial product = a * c;
  EXPECT_EQ(product.degree, (std::array<int, 3>{3, 5, 3}));
  for (const glm::dvec3& at : kPlaces) {
    EXPECT_NEAR((a + b).value(at), a.value(at) + b.value(at), 1e-14);
    EXPECT_NEAR((a - b).value(at), a.value(at) - b.value(at), 1e-14);
    EXPECT_NEAR(product.value(at), a.value(at) * c.value(at), 1e-14);
  }
}

TEST(Bernstein, derivative_is_the_difference_quotient) {
  const BernsteinPolynomial a = random_polynomial({3, 0, 2}, 4);
  for (int axis = 0; axis < 3; ++axis) {
    const BernsteinPolynomial slope = derivative(a, axis);
    const int degree = a.degree[static_cast<std::size_t>(axis)];
    EXPECT_EQ(slope.degree[static_cast<std::size_t>(axis)], std::max(degree - 1, 0));
    for (const glm::dvec3& at : kPlaces) {
      glm::dvec3 step(0);
      step[axis] = 1e-5;
      EXPECT_NEAR(slope.value(at), (a.value(at + step) - a.value(at - step)) / 2e-5, 1e-8);
    }
  }
}

TEST(Bernstein, elevation_and_halves_keep_the_values) {
  const BernsteinPolynomial a = random_polynomial({3, 0, 2}, 5);
  for (int axis = 0; axis < 3; ++axis) {
    const BernsteinPolynomial higher = elevated(a, axis, 5);
    EXPECT_EQ(higher.degree[static_cast<std::size_t>(axis)], 5);
    const auto [lower, upper] = halves(a, axis);
    for (const glm::dvec3& at : kPlaces) {
      EXPECT_NEAR(higher.value(at), a.value(at), 1e-14);
      glm::dvec3 in_lower = at;
      in_lower[axis] = at[axis] / 2;
      EXPECT_NEAR(lower.value(at), a.value(in_lower), 1e-14);
      glm::dvec3 in_upper = at;
      in_upper[axis] = 0.5 + at[axis] / 2;
      EXPECT_NEAR(upper.value(at), a.value(in_upper), 1e-14);
    }
  }
}

TEST(Bernstein, bounds_hold_all_values_and_tighten_by_halving) {
  const BernsteinPolynomial a = random_polynomial({3, 3, 3}, 6);
  const auto [least, most] = a.bounds();
  for (double t = 0; t <= 1; t += 0.125) {
    const double value = a.value({t, 1 - t, 0.5 * t});
    EXPECT_GE(value, least);
    EXPECT_LE(value, most);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto [lower, upper] = halves(a, axis);
    for (const auto& half : {lower, upper}) {
      EXPECT_GE(half.bounds().first, least);
      EXPECT_LE(half.bounds().second, most);
    }
  }
}

}  // namespace
}  // namespace espalier
