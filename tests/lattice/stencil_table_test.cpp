#include "lattice/volume/stencil_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "lattice/core/parallel.h"

namespace espalier {
namespace {

using Dense = std::vector<std::vector<double>>;

/// About one weight in three; sums of products of these are exact.
Dense random_matrix(std::size_t n_rows, std::size_t n_columns, unsigned seed) {
  std::mt19937 random(seed);
  Dense matrix(n_rows, std::vector<double>(n_columns));
  for (auto& row : matrix) {
    for (double& weight : row) {
      weight = random() % 3 == 0 ? static_cast<double>(random() % 64) / 16 - 2 : 0.0;
    }
  }
  return matrix;
}

/// The table of a matrix; rows are filled from the last column to the first.
StencilTable table_of(const Dense& matrix) {
  return StencilTable::build(matrix.size(), matrix[0].size(), [&](std::size_t i, StencilRow& row) {
    for (std::size_t j = matrix[i].size(); j-- > 0;) {
      row.add(static_cast<std::int32_t>(j), matrix[i][j]);
    }
  });
}

Dense dense(const StencilTable& table) {
  Dense matrix(table.n_rows(), std::vector<double>(table.n_controls()));
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const StencilTable::Row row = table[i];
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      matrix[i][static_cast<std::size_t>(row.indices[k])] = row.weights[k];
    }
  }
  return matrix;
}

Dense product(const Dense& a, const Dense& b) {
  Dense result(a.size(), std::vector<double>(b[0].size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      for (std::size_t j = 0; j < b[0].size(); ++j) {
        result[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return result;
}

std::vector<glm::dvec3> some_points(std::size_t n) {
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    points.emplace_back(x, x * x, 1 - x);
  }
  return points;
}

TEST(StencilTable, holds_the_weights_of_a_dense_matrix_ascending) {
  const Dense matrix = random_matrix(5000, 17, 1);
  const StencilTable table = table_of(matrix);
  EXPECT_EQ(table.n_rows(), 5000u);
  EXPECT_EQ(table.n_controls(), 17u);
  EXPECT_EQ(dense(table), matrix);
  std::size_t n_weights = 0;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const auto indices = table[i].indices;
    EXPECT_TRUE(std::adjacent_find(indices.begin(), indices.end(), std::greater_equal()) ==
                indices.end());
    n_weights += indices.size();
  }
  EXPECT_EQ(table.n_weights(), n_weights);
  EXPECT_GE(table.bytes(), n_weights * 12 + 5001 * 4);
}

TEST(StencilTable, sums_repeated_weights_and_leaves_out_exact_zeros) {
  const StencilTable table = StencilTable::build(3, 4, [](std::size_t i, StencilRow& row) {
    row.add(3, 0.5);
    row.add(1, 0.25);
    if (i == 1) {
      row.add(3, -0.5);
      row.add(1, 0.75);
    }
    if (i == 2) {
      row.add(1, -0.25);
      row.add(1, 0.25);
      row.add(0, 0.0);
    }
  });
  EXPECT_EQ(dense(table), (Dense{{0, 0.25, 0, 0.5}, {0, 1, 0, 0}, {0, 0.25, 0, 0.5}}));
  EXPECT_EQ(table.n_weights(), 5u);
}

TEST(StencilTable, applies_like_a_dense_matrix) {
  const Dense matrix = random_matrix(10000, 17, 2);
  const std::vector<glm::dvec3> controls = some_points(17);
  const std::vector<glm::dvec3> points = table_of(matrix).apply(controls);
  ASSERT_EQ(points.size(), 10000u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    glm::dvec3 expected(0);
    for (std::size_t j = 0; j < controls.size(); ++j) {
      expected += matrix[i][j] * controls[j];
    }
    ASSERT_EQ(points[i], expected);
  }
}

TEST(StencilTable, composes_like_dense_matrices) {
  const Dense first = random_matrix(40, 9, 3);
  const Dense second = random_matrix(3000, 40, 4);
  const StencilTable both = compose(table_of(first), table_of(second));
  EXPECT_EQ(dense(both), product(second, first));
  EXPECT_EQ(both.apply(some_points(9)),
            table_of(second).apply(table_of(first).apply(some_points(9))));
}

TEST(StencilTable, transposes_like_a_dense_matrix_and_back) {
  const Dense matrix = random_matrix(300, 17, 5);
  const StencilTable table = table_of(matrix);
  const StencilTable transposed = table.transpose();
  EXPECT_EQ(transposed.n_rows(), 17u);
  EXPECT_EQ(transposed.n_controls(), 300u);
  Dense expected(17, std::vector<double>(300));
  for (std::size_t i = 0; i < 300; ++i) {
    for (std::size_t j = 0; j < 17; ++j) {
      expected[j][i] = matrix[i][j];
    }
  }
  EXPECT_EQ(dense(transposed), expected);
  for (std::size_t j = 0; j < 17; ++j) {
    EXPECT_TRUE(std::ranges::is_sorted(transposed[j].indices));
  }
  const StencilTable back = transposed.transpose();
  EXPECT_EQ(dense(back), matrix);
  EXPECT_EQ(back.n_weights(), table.n_weights());
  EXPECT_EQ(StencilTable().transpose().n_rows(), 0u);
}

TEST(StencilTable, transpose_is_the_adjoint) {
  const StencilTable table = table_of(random_matrix(300, 17, 6));
  const std::vector<glm::dvec3> x = some_points(17);
  const std::vector<glm::dvec3> y = some_points(300);
  const auto inner = [](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += a[i] * b[i];
    }
    return sum;
  };
  EXPECT_EQ(inner(table.apply(x), y), inner(x, table.transpose().apply(y)));  // sums are exact
}

/// 10,000 rows of up to four weights each over 200 control points, neighbours over neighbours.
StencilTable banded_table() {
  return StencilTable::build(10000, 200, [](std::size_t i, StencilRow& row) {
    for (std::size_t k = 0; k < i % 5; ++k) {
      row.add(static_cast<std::int32_t>(std::min<std::size_t>(i / 50 + k, 199)),
              1 / (1.0 + static_cast<double>(i + 3 * k)));
    }
  });
}

TEST(ReachedRows, are_those_with_a_weight_for_a_control_point_ascending) {
  const StencilTable table = banded_table();
  ReachedRows reached(table);
  const std::vector<std::vector<std::int32_t>> choices = {
      {}, {0}, {199}, {7}, {150, 3, 3, 4}, {0, 199, 100}};
  for (const std::vector<std::int32_t>& controls : choices) {
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < table.n_rows(); ++i) {
      const auto indices = table[i].indices;
      if (std::ranges::find_first_of(indices, controls) != indices.end()) {
        expected.push_back(static_cast<std::int32_t>(i));
      }
    }
    const auto rows = reached.of(controls);
    EXPECT_EQ(std::vector(rows.begin(), rows.end()), expected);
  }
}

TEST(ReachedRows, applied_alone_give_the_bits_of_the_whole_product_and_leave_other_rows) {
  const StencilTable table = banded_table();
  ReachedRows reached(table);
  std::vector<glm::dvec3> controls = some_points(200);
  std::vector<glm::dvec3> points = table.apply(controls);
  const std::vector<std::int32_t> moved = {17, 120, 18};
  for (const std::int32_t control : moved) {
    controls[static_cast<std::size_t>(control)] += glm::dvec3(0.1, -0.3, 0.7);
  }
  const auto rows = reached.of(moved);
  EXPECT_LT(rows.size(), 600u);
  table.apply(controls, rows, points);
  EXPECT_EQ(points, table.apply(controls));

  const glm::dvec3 mark(-1e300);
  std::vector<glm::dvec3> marked(table.n_rows(), mark);
  table.apply(controls, rows, marked);
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const bool is_reached = std::ranges::binary_search(rows, static_cast<std::int32_t>(i));
    ASSERT_EQ(marked[i], is_reached ? points[i] : mark) << i;
  }
}

TEST(StencilTable, has_the_same_bits_for_any_number_of_threads) {
  const auto build = [] {
    return StencilTable::build(20000, 100, [](std::size_t i, StencilRow& row) {
      for (std::size_t k = 0; k < i % 23; ++k) {
        row.add(static_cast<std::int32_t>((i * 7 + k * k) % 100),
                1 / (1.0 + static_cast<double>(i + 3 * k)));
      }
    });
  };
  set_thread_count(1);
  const StencilTable one = build();
  const auto points_one = one.apply(some_points(100));
  set_thread_count(4);
  const StencilTable four = build();
  const auto points_four = four.apply(some_points(100));
  set_thread_count(0);
  EXPECT_EQ(dense(one), dense(four));
  EXPECT_EQ(points_one, points_four);
}

TEST(StencilTable, starts_clean_after_a_row_that_threw) {
  const auto throwing = [] {
    return StencilTable::build(1, 2, [](std::size_t, StencilRow& row) {
      row.add(0, 1);
      throw std::runtime_error("no");
    });
  };
  EXPECT_THROW((void)throwing(), std::runtime_error);
  const StencilTable table =
      StencilTable::build(1, 2, [](std::size_t, StencilRow& row) { row.add(1, 1); });
  EXPECT_EQ(dense(table), (Dense{{0, 1}}));
}

TEST(StencilTable, may_be_empty) {
  const StencilTable table;
  EXPECT_EQ(table.n_rows(), 0u);
  EXPECT_TRUE(table.apply({}).empty());
}

}  // namespace
}  // namespace espalier
