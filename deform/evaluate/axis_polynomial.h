#pragma once

/// From a patch's coefficients to plain powers, along one axis: what the evaluation kernels read.

#include <array>
#include <cstddef>
#include <vector>

#include "lattice/volume/extraction.h"

namespace espalier {

/// The largest degree and number of coefficients of an axis that kernels know.
inline constexpr int kMaxKernelDegree = 3;

/// An extraction followed by the change from Bernstein polynomials to powers of t:
/// Σ_k tᵏ Σ_i rows[k][i] · coefficient i. Seen from the far end t stands for 1 − u.
template <class Real>
struct AxisPolynomial {
  int degree = 1;
  int n_coefficients = 2;
  Real rows[kMaxKernelDegree + 1][kMaxKernelDegree + 1] = {};
};

/// Whether an AxisPolynomial holds it: degree 1 to kMaxKernelDegree, as many coefficients at most.
[[nodiscard]] bool is_kernel_axis(const Extraction& extraction);

/// is_kernel_axis(extraction) must hold. Row 0 is that of the Bézier point at t = 0, without
/// round-off: at that end the polynomial sees what the Bézier form sees, and nothing else.
template <class Real>
[[nodiscard]] AxisPolynomial<Real> axis_polynomial(const Extraction& extraction, bool from_far_end);

/// Those of all extractions: 2 i from the near end, 2 i + 1 from the far end. An extraction that
/// kernels do not know gets empty rows.
template <class Real>
[[nodiscard]] std::vector<AxisPolynomial<Real>> axis_polynomials(
    const std::vector<Extraction>& extractions);

}  // namespace espalier
