#include "lattice/io/matrix_market.h"

#include <fmt/format.h>

#include "lattice/io/number_text.h"

namespace espalier {

std::string matrix_market_text(const StencilTable& table, const std::string& comment) {
  std::string text = "%%MatrixMarket matrix coordinate real general\n";
  if (!comment.empty()) {
    text += "% " + comment + "\n";
  }
  text += fmt::format("{} {} {}\n", table.n_rows(), table.n_controls(), table.n_weights());
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const StencilTable::Row row = table[i];
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      append_number(text, i + 1);
      text += ' ';
      append_number(text, row.indices[k] + 1);
      text += ' ';
      append_number(text, row.weights[k]);
      text += '\n';
    }
  }
  return text;
}

}  // namespace espalier
