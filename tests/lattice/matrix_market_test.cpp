#include "lattice/io/matrix_market.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

StencilTable table() {
  return StencilTable::build(3, 4, [](std::size_t i, StencilRow& row) {
    if (i != 1) {
      row.add(static_cast<std::int32_t>(i), 0.1);
      row.add(3, -1.0 / 3);
      row.add(0, i == 0 ? 0 : 2e-300);
    }
  });
}

TEST(MatrixMarket, counts_from_one_and_writes_weights_exactly) {
  EXPECT_EQ(matrix_market_text(table(), "three rows"),
            "%%MatrixMarket matrix coordinate real general\n"
            "% three rows\n"
            "3 4 5\n"
            "1 1 0.1\n"
            "1 4 -0.3333333333333333\n"
            "3 1 2e-300\n"
            "3 3 0.1\n"
            "3 4 -0.3333333333333333\n");
}

TEST(MatrixMarket, of_an_empty_table_is_only_a_header) {
  EXPECT_EQ(matrix_market_text(StencilTable()),
            "%%MatrixMarket matrix coordinate real general\n0 0 0\n");
}

}  // namespace
}  // namespace espalier
