#include "lattice/volume/extraction.h"

namespace espalier {

Extraction bezier_extraction(int degree) {
  const auto n = static_cast<std::size_t>(degree + 1);
  Extraction extraction{degree, degree + 1, std::vector<double>(n * n, 0.0)};
  for (std::size_t i = 0; i < n; ++i) {
    extraction.rows[i * n + i] = 1;
  }
  return extraction;
}

Extraction uniform_cubic_extraction(bool natural_begin, bool natural_end) {
  // Columns: the coefficients before, at the two ends of, and after the interval.
  std::array<std::array<double, 4>, 4> rows = {{{1.0 / 6, 4.0 / 6, 1.0 / 6, 0},
                                                {0, 4.0 / 6, 2.0 / 6, 0},
                                                {0, 2.0 / 6, 4.0 / 6, 0},
                                                {0, 1.0 / 6, 4.0 / 6, 1.0 / 6}}};
  for (auto& row : rows) {
    if (natural_begin) {
      row[1] += 2 * row[0];
      row[2] -= row[0];
    }
    if (natural_end) {
      row[2] += 2 * row[3];
      row[1] -= row[3];
    }
  }
  const int first = natural_begin ? 1 : 0;
  const int last = natural_end ? 2 : 3;
  Extraction extraction{3, last - first + 1, {}};
  for (const auto& row : rows) {
    extraction.rows.insert(extraction.rows.end(), row.begin() + first, row.begin() + last + 1);
  }
  return extraction;
}

}  // namespace espalier
