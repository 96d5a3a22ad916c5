#pragma once

/// Polynomials of integers, exact: what certificates in floating point are held against.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "lattice/volume/bernstein_lines.h"
#include "tests/support/spline_volume.h"

namespace espalier::test {

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

inline ExactNet operator*(const ExactNet& a, const ExactNet& b) {
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

inline ExactNet sum(ExactNet a, const ExactNet& b, int sign) {
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    a.values[i] += sign * b.values[i];
  }
  return a;
}

inline Integer exact_binomial(int n, int k) {
  return static_cast<Integer>(binomial(n, k));
}

/// Component c of the derivative along an axis.
template <class Point>
ExactNet exact_derivative(int degree, const std::vector<Point>& points, std::size_t c,
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

inline ExactNet exact_determinant(int degree, const std::vector<IntegerPoint>& points) {
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
inline Integer exact_value(const ExactNet& net, const std::array<int, 3>& quarter) {
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
inline std::vector<IntegerPoint> random_points(int degree, int number, std::mt19937& random) {
  const int room = 700 / degree;
  std::uniform_int_distribution<int> noise(0, number % 3 == 0 ? room : room / 3);
  std::vector<IntegerPoint> points;
  const auto n = static_cast<std::size_t>(degree + 1);
  for (const glm::dvec3& p : grid_points({degree, degree, degree})) {
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

/// The largest error of Bernstein coefficients, beside the exact ones times `factor`, as a part of
/// the error that is claimed: above 1 the claim is wrong.
inline double used_part_of_error(const ExactNet& exact, long double factor,
                                 std::span<const double> coefficients, double claimed) {
  double most = 0;
  const std::array<int, 3>& size = exact.size;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const std::size_t at = exact.at(i, j, k);
        const long double expected =
            static_cast<long double>(exact.values[at]) * factor /
            static_cast<long double>(binomial(size[0] - 1, i) * binomial(size[1] - 1, j) *
                                     binomial(size[2] - 1, k));
        const long double error = static_cast<long double>(coefficients[at]) - expected;
        most = std::max(most, std::abs(static_cast<double>(error)) / claimed);
      }
    }
  }
  return most;
}

}  // namespace espalier::test
