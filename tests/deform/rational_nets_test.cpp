#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <random>

#include "deform/injectivity/determinant_nets.h"
#include "deform/injectivity/positivity.h"
#include "lattice/volume/bernstein.h"
#include "tests/support/exact_nets.h"

namespace espalier {
namespace {

using test::ExactNet;
using test::Integer;

/// Position times weight, and weight.
using WeightedPoint = std::array<std::int64_t, 4>;

ExactNet exact_component(int degree, const std::vector<WeightedPoint>& points, std::size_t c) {
  ExactNet net{{degree + 1, degree + 1, degree + 1}, {}};
  for (int k = 0; k <= degree; ++k) {
    for (int j = 0; j <= degree; ++j) {
      for (int i = 0; i <= degree; ++i) {
        net.values.push_back(points[net.at(i, j, k)][c] * test::exact_binomial(degree, i) *
                             test::exact_binomial(degree, j) * test::exact_binomial(degree, k));
      }
    }
  }
  return net;
}

/// The same polynomial of one degree less an axis, if there is one: division by (1 − t) + t.
ExactNet lowered(ExactNet net) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ExactNet low{net.size, {}};
    --low.size[axis];
    low.values.resize(static_cast<std::size_t>(low.size[0] * low.size[1] * low.size[2]));
    for (int k = 0; k < low.size[2]; ++k) {
      for (int j = 0; j < low.size[1]; ++j) {
        for (int i = 0; i < low.size[0]; ++i) {
          std::array<int, 3> before = {i, j, k};
          --before[axis];
          low.values[low.at(i, j, k)] =
              net.values[net.at(i, j, k)] -
              (before[axis] < 0 ? 0 : low.values[low.at(before[0], before[1], before[2])]);
        }
      }
    }
    net = std::move(low);
  }
  return net;
}

/// det(∂P/∂u, ∂P/∂v, ∂P/∂w, P) along the first row, of degree 4p − 2 an axis.
ExactNet exact_determinant(int degree, const std::vector<WeightedPoint>& points) {
  std::array<std::array<ExactNet, 4>, 4> d;  // by column, component
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      d[axis][c] = test::exact_derivative(degree, points, c, axis);
    }
    d[3][c] = exact_component(degree, points, c);
  }
  const auto minor = [&](std::size_t column, std::size_t a, std::size_t b) {
    return sum(d[column][a] * d[column + 1][b], d[column][b] * d[column + 1][a], -1);
  };
  ExactNet out;
  const std::array<std::array<std::size_t, 4>, 6> rows = {
      {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
  for (const auto& [a, b, e, f] : rows) {  // even permutations
    ExactNet term = minor(0, a, b) * minor(2, e, f);
    out = out.values.empty() ? std::move(term) : sum(std::move(out), term, 1);
  }
  return lowered(std::move(out));
}

std::vector<WeightedPoint> random_weighted(int degree, int number, std::mt19937& random) {
  std::uniform_int_distribution<int> weight(1, 4);
  std::vector<WeightedPoint> points;
  for (const auto& p : test::random_points(degree, number, random)) {
    const int w = number % 3 == 0 ? 3 + weight(random) % 2 : weight(random);
    points.push_back({w * p[0], w * p[1], w * p[2], w});
  }
  return points;
}

/// Large odd factors, exact in double, so that products are rounded.
constexpr WeightedPoint kFactors = {(1LL << 37) + 12345677, (1LL << 36) + 987654321,
                                    (1LL << 35) + 55555, (1LL << 33) + 7654321};

std::vector<glm::dvec4> rounded_points(const std::vector<WeightedPoint>& points) {
  std::vector<glm::dvec4> result;
  for (const WeightedPoint& p : points) {
    glm::dvec4& point = result.emplace_back();
    for (int c = 0; c < 4; ++c) {
      const auto at = static_cast<std::size_t>(c);
      point[c] = static_cast<double>(p[at] * kFactors[at]);
    }
  }
  return result;
}

HomogeneousPatch patch_of(int degree, const std::vector<glm::dvec4>& points) {
  return {{degree, degree, degree}, points, glm::dvec4(0)};
}

TEST(RationalDeterminant, holds_the_exact_coefficients_within_its_error) {
  std::mt19937 random(5);
  DeterminantNets nets;
  BoundedPolynomial found;
  const long double factor =
      static_cast<long double>(kFactors[0]) * static_cast<long double>(kFactors[1]) *
      static_cast<long double>(kFactors[2]) * static_cast<long double>(kFactors[3]);
  double largest_use = 0;
  for (const int degree : {1, 1, 1, 2, 2, 2, 3}) {
    const auto points = random_weighted(degree, static_cast<int>(random() % 12), random);
    const ExactNet exact = exact_determinant(degree, points);
    const std::vector<glm::dvec4> rounded = rounded_points(points);
    nets.rational_determinant(patch_of(degree, rounded), {}, found);
    ASSERT_EQ(found.shape.size, exact.size);
    ASSERT_EQ(found.shape.size[0], 4 * degree - 1);
    const double use = test::used_part_of_error(exact, factor, found.coefficients, found.error);
    ASSERT_LE(use, 1);
    largest_use = std::max(largest_use, use);
  }
  EXPECT_GT(largest_use, 1e-6);  // there was rounding to bound
}

TEST(RationalDeterminant, never_certifies_what_exact_integers_see_fold) {
  std::mt19937 random(17);
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  int n_certified = 0;
  int n_folded = 0;
  int n_singular = 0;
  for (int number = 0; number < 3000; ++number) {
    const int degree = number % 20 == 1 ? 2 : 1;
    const auto points = random_weighted(degree, number / 2, random);
    const std::vector<glm::dvec4> rounded = rounded_points(points);
    nets.rational_determinant(patch_of(degree, rounded), {}, polynomial);
    const Positivity found = positivity(polynomial, 32);
    const ExactNet exact = exact_determinant(degree, points);
    if (found.verdict == Verdict::Certified) {
      ++n_certified;
      for (int corner = 0; corner < 27; ++corner) {
        ASSERT_GT(
            test::exact_value(exact, {2 * (corner % 3), 2 * (corner / 3 % 3), 2 * (corner / 9)}), 0)
            << "pose " << number;
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
  EXPECT_GT(n_certified, 300);
  EXPECT_GT(n_folded, 100);
  EXPECT_GT(n_singular, 700);
}

/// A warped cube with weights, and the determinant that its derivatives make with ordinary ones.
struct Sample {
  BezierPatch patch;
  std::vector<glm::dvec4> points;

  Sample(const std::array<int, 3>& degree, double noise, unsigned seed)
      : patch(test::warped_cube(degree, noise, seed)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> weight(0.5, 2);
    for (glm::dvec3& p : patch.points) {
      patch.weights.push_back(weight(random));
      p *= patch.weights.back();
      points.emplace_back(p, patch.weights.back());
    }
  }
  [[nodiscard]] double expected(const glm::dvec3& uvw) const {
    std::vector<glm::dvec3> weights;
    for (const double w : patch.weights) {
      weights.emplace_back(w, 0, 0);
    }
    const double w = BezierView{patch.degree, weights}.value(uvw).x;
    return std::pow(w, 4) * glm::determinant(patch.derivative(uvw));
  }
};

TEST(RationalDeterminant, is_the_jacobian_times_the_fourth_power_of_the_weight) {
  const Sample sample({2, 3, 1}, 0.1, 7);
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  nets.rational_determinant({sample.patch.degree, sample.points}, {}, polynomial);
  EXPECT_EQ(polynomial.shape.size, (std::array<int, 3>{7, 11, 3}));
  const BernsteinPolynomial determinant{{6, 10, 2}, polynomial.coefficients};
  for (const glm::dvec3 uvw : {glm::dvec3(0.2, 0.3, 0.9), glm::dvec3(0, 1, 0.5)}) {
    EXPECT_NEAR(determinant.value(uvw), sample.expected(uvw), 1e-12);
  }
  const Sample cubic({3, 3, 3}, 0.1, 2);
  nets.rational_determinant({cubic.patch.degree, cubic.points}, {}, polynomial);
  EXPECT_EQ(polynomial.coefficients.size(), 1331u);
}

TEST(RationalDeterminant, of_moving_patches_is_cubic_in_time_and_linear_along_one_direction) {
  for (const bool is_parallel : {false, true}) {
    Sample sample({3, 2, 2}, 0.05, 1);
    BezierPatch motion = test::warped_cube({3, 2, 2}, 0.3, 2);
    std::vector<glm::dvec4> moves;
    for (std::size_t i = 0; i < motion.points.size(); ++i) {
      glm::dvec3& m = motion.points[i];
      m = sample.patch.weights[i] * (is_parallel ? m.x * glm::dvec3(0.5, -1, 2) : m);
      moves.emplace_back(m, 0);
    }
    DeterminantNets nets;
    std::array<BoundedPolynomial, 4> powers;
    nets.moving_rational_determinant({sample.patch.degree, sample.points},
                                     {sample.patch.degree, moves}, is_parallel, {}, powers);
    const glm::dvec3 uvw(0.3, 0.8, 0.45);
    const BezierPatch start = sample.patch;
    for (const double t : {-0.7, 0.4, 2.0}) {
      double value = 0;
      for (std::size_t k = 4; k-- > 0;) {
        value = value * t + BernsteinPolynomial{{10, 6, 6}, powers[k].coefficients}.value(uvw);
      }
      for (std::size_t i = 0; i < motion.points.size(); ++i) {
        sample.patch.points[i] = start.points[i] + t * motion.points[i];
      }
      EXPECT_NEAR(value, sample.expected(uvw), 1e-11 * (1 + std::abs(t * t * t)));
    }
  }
}

}  // namespace
}  // namespace espalier
