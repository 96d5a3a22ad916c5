#pragma once

/// Scalar polynomials on the unit cube in Bernstein form: their coefficients bound them.

#include <array>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace espalier {

/// Σ c_ijk B_i(u) B_j(v) B_k(w), of a degree per axis.
struct BernsteinPolynomial {
  std::array<int, 3> degree = {0, 0, 0};
  std::vector<double> coefficients = {0};  ///< #(p+1)(q+1)(r+1), u fastest

  /// uvw: in [0,1]³, or near it.
  [[nodiscard]] double value(const glm::dvec3& uvw) const;
  /// The least and the largest coefficient: all values on [0,1]³ lie between them, and the values
  /// at the corners are coefficients.
  [[nodiscard]] std::pair<double, double> bounds() const;
};

/// Of two polynomials of the same degree.
[[nodiscard]] BernsteinPolynomial operator+(const BernsteinPolynomial& a,
                                            const BernsteinPolynomial& b);
[[nodiscard]] BernsteinPolynomial operator-(const BernsteinPolynomial& a,
                                            const BernsteinPolynomial& b);

/// Degrees add. O(#a · #b).
[[nodiscard]] BernsteinPolynomial operator*(const BernsteinPolynomial& a,
                                            const BernsteinPolynomial& b);

/// Along one axis; its degree falls by one unless it is 0.
[[nodiscard]] BernsteinPolynomial derivative(const BernsteinPolynomial& polynomial, int axis);

/// The same polynomial with a higher degree on an axis.
[[nodiscard]] BernsteinPolynomial elevated(BernsteinPolynomial polynomial, int axis,
                                           int new_degree);

/// The halves [0, ½] and [½, 1] of an axis, each on its own unit cube.
[[nodiscard]] std::pair<BernsteinPolynomial, BernsteinPolynomial> halves(
    const BernsteinPolynomial& polynomial, int axis);

}  // namespace espalier
