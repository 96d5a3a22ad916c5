#pragma once

/// Tables made of the rows of others.

#include <cstddef>
#include <span>

#include "lattice/volume/stencil_table.h"

namespace espalier {

/// These rows of a table, in this order.
[[nodiscard]] StencilTable selected_rows(const StencilTable& table,
                                         std::span<const std::size_t> which);

/// Its rows [begin, end).
[[nodiscard]] StencilTable row_range(const StencilTable& table, std::size_t begin, std::size_t end);

/// The rows of one table, then those of another over the same control points.
[[nodiscard]] StencilTable stacked_rows(const StencilTable& first, const StencilTable& second);

/// Adds `weight` times a row to one that is summed up.
void add_row(const StencilTable::Row& source, double weight, StencilRow& row);

}  // namespace espalier
