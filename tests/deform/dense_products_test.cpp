#include "deform/direct/dense_products.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace espalier {
namespace {

/// A matrix that is part of a larger one.
struct Part {
  std::size_t n_rows;
  std::size_t n_columns;
  std::size_t stride;
  std::vector<double> values;

  Part(std::size_t rows, std::size_t columns, unsigned seed)
      : n_rows(rows), n_columns(columns), stride(rows + 3) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    for (std::size_t i = 0; i < stride * columns; ++i) {
      values.push_back(number(random));
    }
  }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return values[column * stride + row];
  }
  [[nodiscard]] MatrixPart<const double> read() const {
    return {values.data(), n_rows, n_columns, stride};
  }
  [[nodiscard]] MatrixPart<double> written() { return {values.data(), n_rows, n_columns, stride}; }
};

TEST(DenseProducts, are_sums_of_products_with_all_instruction_sets) {
  for (const InstructionSet set : available_instruction_sets()) {
    const DenseProducts& products = dense_products(set);
    for (const auto& [m, k, n] : {std::array<std::size_t, 3>{1, 1, 1}, {7, 5, 3}, {67, 130, 41}}) {
      const Part A(m, k, 1);
      const Part B(k, n, 2);
      const Part before(m, n, 3);
      Part C = before;
      products.add(A.read(), B.read(), -0.5, C.written());
      const Part At(k, m, 4);
      Part D = before;
      products.add_transposed(At.read(), B.read(), 2, D.written());
      for (std::size_t column = 0; column < n; ++column) {
        for (std::size_t row = 0; row < C.stride; ++row) {
          double c = before.at(row, column);
          double d = c;
          for (std::size_t i = 0; row < m && i < k; ++i) {
            c -= 0.5 * A.at(row, i) * B.at(i, column);
            d += 2 * At.at(i, row) * B.at(i, column);
          }
          EXPECT_NEAR(C.at(row, column), c, 1e-13);
          EXPECT_NEAR(D.at(row, column), d, 1e-13);
        }
      }
    }
  }
}

}  // namespace
}  // namespace espalier
