#include "deform/injectivity/determinant_nets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <random>

#include "deform/injectivity/positivity.h"
#include "lattice/volume/bernstein.h"
#include "lattice/volume/bernstein_lines.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

__extension__ using Integer = __int128;

/// Integer Bernstein coefficients times binomials; products are exact.
struct ExactNet {
  std::array<int, 3> size;
  std::vector<Integer> values;

  [[nodiscard]] std::size_t at(int i, int j, int k) const {
    return static_cast<std::size_t>(i + size[0] * (j + size[1] * k));
  }
};

using IntegerPoint = std::array<std::int64_t, 3>;

ExactNet operator*(const ExactNet& a, const ExactNet& b) {
  ExactNet out{{a.size[0] + b.size[0] - 1, a.size[1] + b.size[1] - 1, a.size[2] + b.size[2] - 1},
               {}};
  out.values.assign(static_cast<std::size_t>(out.size[0] * out.size[1] * out.size[2]), 0);
  for (int k = 0; k < a.size[2]; ++k) {
    for (int j = 0; j < a.size[1]; ++j) {
      for (int i = 0; i < a.size[0]; ++i) {
        for (int c = 0; c < b.size[2]; ++c) {
          for (int m = 0; m < b.size[1]; ++m) {
            for (int l = 0; l < b.size[0]; ++l) {
              out.values[out.at(i + l, j + m, k + c)] +=
                  a.values[a.at(i, j, k)] * b.values[b.at(l, m, c)];
            }
          }
        }
      }
    }
  }
  return out;
}

ExactNet sum(ExactNet a, const ExactNet& b, int sign) {
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    a.values[i] += sign * b.values[i];
  }
  return a;
}

Integer exact_binomial(int n, int k) {
  return static_cast<Integer>(binomial(n, k));
}

/// Component c of the derivative along an axis.
ExactNet exact_derivative(int degree, const std::vector<IntegerPoint>& points, std::size_t c,
                          std::size_t axis) {
  ExactNet net{{degree + 1, degree + 1, degree + 1}, {}};
  const std::array<int, 3> stride = {1, degree + 1, (degree + 1) * (degree + 1)};
  --net.size[axis];
  for (int k = 0; k < net.size[2]; ++k) {
    for (int j = 0; j < net.size[1]; ++j) {
      for (int i = 0; i < net.size[0]; ++i) {
        const int at = i + stride[1] * j + stride[2] * k;
        const Integer difference = points[static_cast<std::size_t>(at + stride[axis])][c] -
                                   points[static_cast<std::size_t>(at)][c];
        net.values.push_back(degree * difference * exact_binomial(net.size[0] - 1, i) *
                             exact_binomial(net.size[1] - 1, j) *
                             exact_binomial(net.size[2] - 1, k));
      }
    }
  }
  return net;
}

ExactNet exact_determinant(int degree, const std::vector<IntegerPoint>& points) {
  std::array<std::array<ExactNet, 3>, 3> d;  // by axis, component
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < 3; ++c) {
      d[axis][c] = exact_derivative(degree, points, c, axis);
    }
  }
  ExactNet out;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t y = (c + 1) % 3;
    const std::size_t z = (c + 2) % 3;
    const ExactNet term = d[0][c] * sum(d[1][y] * d[2][z], d[1][z] * d[2][y], -1);
    out = c == 0 ? term : sum(std::move(out), term, 1);
  }
  return out;
}

/// The polynomial at (a, b, c) / 4, times a positive number.
Integer exact_value(const ExactNet& net, const std::array<int, 3>& quarter) {
  const auto power = [](int base, int exponent) {
    Integer result = 1;
    for (int i = 0; i < exponent; ++i) {
      result *= base;
    }
    return result;
  };
  Integer result = 0;
  for (int k = 0; k < net.size[2]; ++k) {
    for (int j = 0; j < net.size[1]; ++j) {
      for (int i = 0; i < net.size[0]; ++i) {
        Integer term = net.values[net.at(i, j, k)];
        const std::array<int, 3> index = {i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          term *= power(quarter[axis], index[axis]) *
                  power(4 - quarter[axis], net.size[axis] - 1 - index[axis]);
        }
        result += term;
      }
    }
  }
  return result;
}

/// A warped cube on a 10-bit grid; every other one is singular at a corner, or one step beside it.
std::vector<IntegerPoint> random_points(int degree, int number, std::mt19937& random) {
  const int room = 700 / degree;
  std::uniform_int_distribution<int> noise(0, number % 3 == 0 ? room : room / 3);
  std::vector<IntegerPoint> points;
  const auto n = static_cast<std::size_t>(degree + 1);
  for (const glm::dvec3& p : test::grid_points({degree, degree, degree})) {
    points.push_back({static_cast<int>(p.x) * room + noise(random),
                      static_cast<int>(p.y) * room + noise(random),
                      static_cast<int>(p.z) * room + noise(random)});
  }
  if (number % 2 == 0) {  // the third edge at a corner in the plane of the others
    std::uniform_int_distribution<int> step(-1, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      points[n * n][c] = points[1][c] + points[n][c] - points[0][c];
    }
    points[n * n][2] += number % 4 == 0 ? 0 : step(random);
  }
  return points;
}

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
      const int d = 3 * degree - 1;
      for (int k = 0; k <= d; ++k) {
        for (int j = 0; j <= d; ++j) {
          for (int i = 0; i <= d; ++i) {
            const std::size_t at = exact.at(i, j, k);
            const long double expected =
                static_cast<long double>(exact.values[at]) * factor /
                static_cast<long double>(binomial(d, i) * binomial(d, j) * binomial(d, k));
            const auto error = std::abs(
                static_cast<double>(static_cast<long double>(found.coefficients[at]) - expected));
            ASSERT_LE(error, found.error);
            largest_use = std::max(largest_use, error / found.error);
          }
        }
      }
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

TEST(DeterminantNets, of_rational_patches_are_the_fourth_power_of_the_weight_times_the_jacobian) {
  const BezierPatch shape = test::warped_cube({2, 3, 1}, 0.1, 7);
  std::vector<glm::dvec4> points;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> weight(0.5, 2);
  BezierPatch weighted = shape;
  BezierPatch weights = shape;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const double w = weight(random);
    weighted.points[i] *= w;
    weights.points[i] = glm::dvec3(w, 0, 0);
    points.emplace_back(weighted.points[i], w);
  }
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  nets.rational_determinant(shape.degree, points, 0, polynomial);
  EXPECT_EQ(polynomial.shape.size, (std::array<int, 3>{8, 12, 4}));
  const BernsteinPolynomial determinant{{7, 11, 3}, polynomial.coefficients};
  for (const glm::dvec3 uvw : {glm::dvec3(0.2, 0.3, 0.9), glm::dvec3(0, 1, 0.5)}) {
    const double w = weights.value(uvw).x;
    const glm::dvec3 slopes = glm::transpose(weights.derivative(uvw))[0];
    const glm::dvec3 place = weighted.value(uvw) / w;
    glm::dmat3 jacobian = weighted.derivative(uvw);
    for (int axis = 0; axis < 3; ++axis) {
      jacobian[axis] = (jacobian[axis] - slopes[axis] * place) / w;
    }
    EXPECT_NEAR(determinant.value(uvw), std::pow(w, 4) * glm::determinant(jacobian), 1e-12);
  }
}

}  // namespace
}  // namespace espalier
