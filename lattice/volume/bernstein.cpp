// Algebra of trivariate Bernstein polynomials, axis by axis.

#include "lattice/volume/bernstein.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "lattice/volume/bernstein_lines.h"

namespace espalier {
namespace {

template <class Operation>
BernsteinPolynomial combined(const BernsteinPolynomial& a, const BernsteinPolynomial& b,
                             const Operation& operation) {
  assert(a.degree == b.degree);
  BernsteinPolynomial result = a;
  std::transform(a.coefficients.begin(), a.coefficients.end(), b.coefficients.begin(),
                 result.coefficients.begin(), operation);
  return result;
}

template <class Make>
BernsteinPolynomial on_lines(const BernsteinPolynomial& polynomial, int axis, const Make& make) {
  BernsteinPolynomial result;
  result.degree = polynomial.degree;
  result.coefficients = with_lines<double>(result.degree, polynomial.coefficients, axis, make);
  return result;
}

/// The coefficients times (power 1) or divided by (power −1) the binomials of their places: with
/// them in, a product of polynomials is a plain convolution.
std::vector<double> with_binomials(const BernsteinPolynomial& polynomial, int power) {
  const auto& [p, q, r] = polynomial.degree;
  std::vector<double> scaled = polynomial.coefficients;
  std::size_t at = 0;
  for (int k = 0; k <= r; ++k) {
    for (int j = 0; j <= q; ++j) {
      for (int i = 0; i <= p; ++i, ++at) {
        const double factor = binomial(p, i) * binomial(q, j) * binomial(r, k);
        scaled[at] = power > 0 ? scaled[at] * factor : scaled[at] / factor;
      }
    }
  }
  return scaled;
}

/// Calls visit(i, j, k, value) for all coefficients.
template <class Visit>
void for_each_coefficient(const std::array<int, 3>& degree, const std::vector<double>& values,
                          const Visit& visit) {
  std::size_t at = 0;
  for (int k = 0; k <= degree[2]; ++k) {
    for (int j = 0; j <= degree[1]; ++j) {
      for (int i = 0; i <= degree[0]; ++i, ++at) {
        visit(i, j, k, values[at]);
      }
    }
  }
}

}  // namespace

double BernsteinPolynomial::value(const glm::dvec3& uvw) const {
  BernsteinPolynomial reduced = *this;
  for (int axis = 0; axis < 3; ++axis) {
    reduced = on_lines(reduced, axis, [&](std::span<const double> line) {
      return std::vector<double>{part_of_line(line, uvw[axis], uvw[axis]).front()};
    });
  }
  return reduced.coefficients.front();
}

std::pair<double, double> BernsteinPolynomial::bounds() const {
  const auto [least, largest] = std::minmax_element(coefficients.begin(), coefficients.end());
  return {*least, *largest};
}

BernsteinPolynomial operator+(const BernsteinPolynomial& a, const BernsteinPolynomial& b) {
  return combined(a, b, std::plus<>());
}

BernsteinPolynomial operator-(const BernsteinPolynomial& a, const BernsteinPolynomial& b) {
  return combined(a, b, std::minus<>());
}

BernsteinPolynomial operator*(const BernsteinPolynomial& a, const BernsteinPolynomial& b) {
  BernsteinPolynomial result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.degree[axis] = a.degree[axis] + b.degree[axis];
  }
  const int nu = result.degree[0] + 1;
  const int nv = result.degree[1] + 1;
  result.coefficients.assign(n_coefficients(result.degree), 0.0);
  const std::vector<double> b_scaled = with_binomials(b, 1);
  for_each_coefficient(a.degree, with_binomials(a, 1), [&](int ia, int ja, int ka, double a_value) {
    for_each_coefficient(b.degree, b_scaled, [&](int ib, int jb, int kb, double b_value) {
      const int at = ia + ib + nu * (ja + jb + nv * (ka + kb));
      result.coefficients[static_cast<std::size_t>(at)] += a_value * b_value;
    });
  });
  result.coefficients = with_binomials(result, -1);
  return result;
}

BernsteinPolynomial derivative(const BernsteinPolynomial& polynomial, int axis) {
  return on_lines(polynomial, axis, [](std::span<const double> line) {
    std::vector<double> slopes(std::max<std::size_t>(line.size() - 1, 1), 0.0);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      slopes[i] = static_cast<double>(line.size() - 1) * (line[i + 1] - line[i]);
    }
    return slopes;
  });
}

BernsteinPolynomial elevated(BernsteinPolynomial polynomial, int axis, int new_degree) {
  while (polynomial.degree[static_cast<std::size_t>(axis)] < new_degree) {
    polynomial = on_lines(polynomial, axis, elevated_line<double>);
  }
  return polynomial;
}

std::pair<BernsteinPolynomial, BernsteinPolynomial> halves(const BernsteinPolynomial& polynomial,
                                                           int axis) {
  const auto half = [&](double low, double high) {
    return on_lines(polynomial, axis,
                    [&](std::span<const double> line) { return part_of_line(line, low, high); });
  };
  return {half(0, 0.5), half(0.5, 1)};
}

}  // namespace espalier
