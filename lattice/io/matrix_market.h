#pragma once

#include <string>

#include "lattice/volume/stencil_table.h"

namespace espalier {

/// The table as MatrixMarket text, "coordinate real general": a line with the numbers of rows,
/// columns and weights, then one line a weight, "row column weight", row by row. Rows and columns
/// count from 1, as the format demands; weights in their shortest exact form. comment: one line
/// below the header, without its '%'; empty: none.
[[nodiscard]] std::string matrix_market_text(const StencilTable& table,
                                             const std::string& comment = "");

}  // namespace espalier
