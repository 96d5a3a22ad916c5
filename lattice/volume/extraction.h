#pragma once

/// From B-spline coefficients to Bézier points, along one axis.

#include <array>
#include <cstdint>
#include <vector>

namespace espalier {

/// The Bézier points of one interval as combinations of a few coefficients: points = rows ·
/// coefficients. Rows sum to 1.
struct Extraction {
  int degree = 1;
  int n_coefficients = 2;
  std::vector<double> rows;  ///< (degree + 1) × n_coefficients

  [[nodiscard]] double row(int point, int coefficient) const {
    return rows[static_cast<std::size_t>(point * n_coefficients + coefficient)];
  }
  bool operator==(const Extraction&) const = default;
};

/// The coefficients are the Bézier points themselves.
[[nodiscard]] Extraction bezier_extraction(int degree);

/// One interval of the uniform cubic B-spline. An end is natural where no coefficient lies beyond
/// it: the phantom point 2 P0 − P1 is folded in. Coefficients: four, three at one natural end, two
/// at both.
[[nodiscard]] Extraction uniform_cubic_extraction(bool natural_begin, bool natural_end);

}  // namespace espalier
