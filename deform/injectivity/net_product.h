#pragma once

/// Products of polynomials given by nets of coefficients.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace espalier {

/// How many coefficients a net has along each axis; u fastest in memory.
struct NetShape {
  std::array<int, 3> size = {1, 1, 1};

  [[nodiscard]] std::size_t n() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  bool operator==(const NetShape&) const = default;
};

/// The net of a product of two polynomials.
[[nodiscard]] NetShape product_shape(const NetShape& a, const NetShape& b);

/// One product: sign · a · b. a, b: as many coefficients as their shapes have.
struct NetProduct {
  const double* a;
  const double* b;
  double sign = 1;
};

/// Adds Σ sign · a · b to `out`, by plain convolution: for Bernstein coefficients times the
/// binomials of their places that is the product. terms: 1 to 3; out: of product_shape(a, b). Each
/// sum is made by at most #terms · #a additions. `room` keeps its memory from call to call.
void add_products(std::span<const NetProduct> terms, const NetShape& a, const NetShape& b,
                  double* out, std::vector<double>& room);

}  // namespace espalier
