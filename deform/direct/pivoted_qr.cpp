#include "deform/direct/pivoted_qr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lattice/core/parallel.h"

namespace espalier {
namespace {

double dot(const double* a, const double* b, std::size_t n) {
  std::array<double, 8> sums{};  // the order of summation that compilers can turn into vectors
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    for (std::size_t lane = 0; lane < 8; ++lane) {
      sums[lane] += a[i + lane] * b[i + lane];
    }
  }
  double sum = 0;
  for (; i < n; ++i) {
    sum += a[i] * b[i];
  }
  return std::accumulate(sums.begin(), sums.end(), sum);
}

}  // namespace

PivotedQr pivoted_qr(std::vector<double> columns, std::size_t n_rows, std::size_t n_columns,
                     double tolerance) {
  PivotedQr result;
  result.order.resize(n_columns);
  std::iota(result.order.begin(), result.order.end(), std::size_t{0});
  std::vector<double> squares(n_columns);  // of what is left of each column
  const auto column = [&](std::size_t place) {
    return columns.data() + result.order[place] * n_rows;
  };
  for (std::size_t i = 0; i < n_columns; ++i) {
    squares[i] = dot(column(i), column(i), n_rows);
  }
  std::vector<double> known = squares;  // as they were when they were last summed up
  double first = 0;
  std::vector<double> reflector(n_rows);
  for (std::size_t k = 0; k < std::min(n_rows, n_columns); ++k) {
    const auto longest =
        std::max_element(squares.begin() + static_cast<std::ptrdiff_t>(k), squares.end());
    const auto pivot = static_cast<std::size_t>(longest - squares.begin());
    std::swap(result.order[k], result.order[pivot]);
    std::swap(squares[k], squares[pivot]);
    std::swap(known[k], known[pivot]);
    double* a = column(k);
    const std::size_t n = n_rows - k;
    const double length = std::sqrt(dot(a + k, a + k, n));
    first = k == 0 ? length : first;
    if (!(length > tolerance * first)) {
      break;
    }
    std::copy(a + k, a + n_rows, reflector.begin());
    const double end = a[k] > 0 ? -length : length;
    reflector[0] -= end;
    const double scale = 2 / dot(reflector.data(), reflector.data(), n);
    a[k] = end;
    const std::size_t n_left = n_columns - k - 1;
    parallel_for(
        n_left,
        [&](std::size_t i) {
          double* b = column(k + 1 + i) + k;
          const double by = scale * dot(reflector.data(), b, n);
          for (std::size_t row = 0; row < n; ++row) {
            b[row] -= by * reflector[row];
          }
          // Taking away what went into R saves a pass, until too few digits are left.
          double& square = squares[k + 1 + i];
          square -= b[0] * b[0];
          if (square < 1e-6 * known[k + 1 + i]) {
            square = known[k + 1 + i] = n > 1 ? dot(b + 1, b + 1, n - 1) : 0;
          }
        },
        1 + 65536 / n);
    ++result.rank;
  }
  result.R.assign(result.rank * n_columns, 0.0);
  for (std::size_t row = 0; row < result.rank; ++row) {
    for (std::size_t i = row; i < n_columns; ++i) {
      result.R[row * n_columns + i] = column(i)[row];
    }
  }
  return result;
}

}  // namespace espalier
