#include "deform/direct/table_rows.h"

namespace espalier {

StencilTable selected_rows(const StencilTable& table, std::span<const std::size_t> which) {
  return StencilTable::build(which.size(), table.n_controls(), [&](std::size_t i, StencilRow& row) {
    add_row(table[which[i]], 1, row);
  });
}

StencilTable row_range(const StencilTable& table, std::size_t begin, std::size_t end) {
  return StencilTable::build(end - begin, table.n_controls(), [&](std::size_t i, StencilRow& row) {
    add_row(table[begin + i], 1, row);
  });
}

StencilTable stacked_rows(const StencilTable& first, const StencilTable& second) {
  const std::size_t n = first.n_rows();
  return StencilTable::build(
      n + second.n_rows(), second.n_controls(),
      [&](std::size_t i, StencilRow& row) { add_row(i < n ? first[i] : second[i - n], 1, row); });
}

void add_row(const StencilTable::Row& source, double weight, StencilRow& row) {
  for (std::size_t k = 0; k < source.indices.size(); ++k) {
    row.add(source.indices[k], weight * source.weights[k]);
  }
}

}  // namespace espalier
