#pragma once

/// Rank-revealing QR factorisation of dense matrices.

#include <cstddef>
#include <vector>

namespace espalier {

/// A P = Q R with Q left out. R is what Householder's reflections make of A with the longest column
/// that is left taken first.
struct PivotedQr {
  std::size_t rank = 0;
  std::vector<std::size_t> order;  ///< #columns: which column of A comes first, …
  std::vector<double> R;           ///< rank × #columns, row-major, upper trapezoidal
};

/// columns: column-major, n_rows each, used up. The rank ends where no column that is left is
/// longer than `tolerance` times the first. O(#rows · #columns · rank).
[[nodiscard]] PivotedQr pivoted_qr(std::vector<double> columns, std::size_t n_rows,
                                   std::size_t n_columns, double tolerance);

}  // namespace espalier
