#include "deform/evaluate/axis_polynomial.h"

#include <cassert>

#include "lattice/volume/bernstein_lines.h"

namespace espalier {

bool is_kernel_axis(const Extraction& extraction) {
  return extraction.degree >= 1 && extraction.degree <= kMaxKernelDegree &&
         extraction.n_coefficients >= 1 && extraction.n_coefficients <= kMaxKernelDegree + 1;
}

template <class Real>
AxisPolynomial<Real> axis_polynomial(const Extraction& extraction, bool from_far_end) {
  assert(is_kernel_axis(extraction));
  const int n = extraction.degree;
  AxisPolynomial<Real> polynomial{n, extraction.n_coefficients, {}};
  for (int power = 0; power <= n; ++power) {
    for (int k = 0; k < extraction.n_coefficients; ++k) {
      double sum = 0;  // of the Bézier points' differences of this order
      for (int i = 0; i <= power; ++i) {
        const double sign = (power - i) % 2 == 0 ? 1 : -1;
        sum += sign * binomial(power, i) * extraction.row(from_far_end ? n - i : i, k);
      }
      polynomial.rows[power][k] = static_cast<Real>(binomial(n, power) * sum);
    }
  }
  return polynomial;
}

template <class Real>
std::vector<AxisPolynomial<Real>> axis_polynomials(const std::vector<Extraction>& extractions) {
  std::vector<AxisPolynomial<Real>> polynomials(2 * extractions.size());
  for (std::size_t i = 0; i < extractions.size(); ++i) {
    if (is_kernel_axis(extractions[i])) {
      polynomials[2 * i] = axis_polynomial<Real>(extractions[i], false);
      polynomials[2 * i + 1] = axis_polynomial<Real>(extractions[i], true);
    }
  }
  return polynomials;
}

template AxisPolynomial<float> axis_polynomial(const Extraction&, bool);
template AxisPolynomial<double> axis_polynomial(const Extraction&, bool);
template std::vector<AxisPolynomial<float>> axis_polynomials(const std::vector<Extraction>&);
template std::vector<AxisPolynomial<double>> axis_polynomials(const std::vector<Extraction>&);

}  // namespace espalier
