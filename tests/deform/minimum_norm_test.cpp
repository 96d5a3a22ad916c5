#include "deform/direct/minimum_norm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

DenseMatrix random_matrix(std::size_t n_rows, std::size_t n_columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  DenseMatrix matrix{n_rows, n_columns, {}};
  for (std::size_t i = 0; i < n_rows * n_columns; ++i) {
    matrix.values.push_back(number(random));
  }
  return matrix;
}

std::vector<glm::dvec3> random_vectors(std::size_t n, unsigned seed) {
  std::vector<glm::dvec3> vectors;
  const DenseMatrix numbers = random_matrix(3, n, seed);
  for (std::size_t i = 0; i < n; ++i) {
    vectors.emplace_back(numbers.values[3 * i], numbers.values[3 * i + 1],
                         numbers.values[3 * i + 2]);
  }
  return vectors;
}

/// A y for Aᵀ.
std::vector<glm::dvec3> product(const DenseMatrix& transposed, std::span<const glm::dvec3> y) {
  std::vector<glm::dvec3> result(transposed.n_columns, glm::dvec3(0));
  for (std::size_t i = 0; i < transposed.n_columns; ++i) {
    for (std::size_t k = 0; k < transposed.n_rows; ++k) {
      result[i] += transposed.values[i * transposed.n_rows + k] * y[k];
    }
  }
  return result;
}

/// Aᵀ x for Aᵀ.
std::vector<glm::dvec3> product_transposed(const DenseMatrix& transposed,
                                           std::span<const glm::dvec3> x) {
  std::vector<glm::dvec3> result(transposed.n_rows, glm::dvec3(0));
  for (std::size_t i = 0; i < transposed.n_columns; ++i) {
    for (std::size_t k = 0; k < transposed.n_rows; ++k) {
      result[k] += transposed.values[i * transposed.n_rows + k] * x[i];
    }
  }
  return result;
}

double largest(std::span<const glm::dvec3> vectors) {
  double most = 0;
  for (const glm::dvec3& v : vectors) {
    most = std::max(most, glm::length(v));
  }
  return most;
}

double largest(std::span<const double> numbers) {
  double most = 0;
  for (const double number : numbers) {
    most = std::max(most, std::abs(number));
  }
  return most;
}

std::vector<glm::dvec3> difference(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  std::vector<glm::dvec3> result(a.begin(), a.end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] -= b[i];
  }
  return result;
}

TEST(MinimumNorm, of_fewer_equations_meets_them_and_has_no_part_that_they_do_not_see) {
  const DenseMatrix transposed = random_matrix(70, 40, 1);
  const MinimumNorm solver(transposed);
  EXPECT_EQ(solver.rank(), 40u);
  const auto b = random_vectors(40, 2);
  const auto y = solver.solve(b).y;
  EXPECT_LT(largest(difference(product(transposed, y), b)), 1e-13);
  // The smallest solution is a combination of the equations: solving for what it gives is itself.
  EXPECT_LT(largest(difference(solver.solve(product(transposed, y)).y, y)), 1e-13);
}

TEST(MinimumNorm, of_sizes_round_those_of_its_panels_solves_as_well) {
  for (const std::size_t n : {1u, 63u, 64u, 65u, 129u, 200u}) {
    const DenseMatrix wide = random_matrix(n + 20, n, 5);
    const auto b = random_vectors(n, 6);
    const auto y = MinimumNorm(wide).solve(b).y;
    EXPECT_LT(largest(difference(product(wide, y), b)), 1e-11) << n;
    EXPECT_LT(largest(MinimumNorm(wide).independent_part(wide, {}).values), 1e-13) << n;
    const DenseMatrix tall = random_matrix(n, n + 20, 7);
    const auto c = random_vectors(n + 20, 8);
    const auto missed = difference(product(tall, MinimumNorm(tall).solve(c).y), c);
    EXPECT_LT(largest(product_transposed(tall, missed)), 1e-11) << n;
  }
}

TEST(MinimumNorm, counts_equations_that_are_others_within_round_off_as_these) {
  for (const auto& [apart, rank] : {std::pair(1e-15, 39u), std::pair(1e-7, 40u)}) {
    DenseMatrix transposed = random_matrix(70, 40, 11);
    for (std::size_t k = 0; k < 70; ++k) {  // the last: half the sum of the first two
      transposed.values[39 * 70 + k] = 0.5 * (transposed.values[k] + transposed.values[70 + k]) +
                                       apart * (k % 3 == 0 ? 1.0 : -1.0);
    }
    EXPECT_EQ(MinimumNorm(transposed).rank(), rank);
    const auto b = product(transposed, random_vectors(70, 12));
    const auto y = MinimumNorm(transposed).solve(b).y;
    EXPECT_LT(largest(difference(product(transposed, y), b)), 1e-13);
    EXPECT_LT(largest(y), 10);
  }
}

TEST(MinimumNorm, tells_how_far_it_is_and_can_be_cancelled) {
  const DenseMatrix transposed = random_matrix(300, 200, 9);
  double last = -1;
  int n_told = 0;
  const Progress progress([&](std::string_view task, double fraction) {
    EXPECT_EQ(task, "factorise");
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++n_told;
    return true;
  });
  const MinimumNorm solver(transposed, {}, progress);
  EXPECT_GE(n_told, 8);
  EXPECT_EQ(last, 1);
  const Progress cancel([](std::string_view, double fraction) { return fraction < 0.6; });
  EXPECT_THROW(MinimumNorm(transposed, {}, cancel), Cancelled);
}

TEST(MinimumNorm, of_more_equations_leaves_a_residual_without_slope) {
  const DenseMatrix transposed = random_matrix(30, 90, 3);
  const MinimumNorm solver(transposed);
  EXPECT_EQ(solver.rank(), 30u);
  const auto b = random_vectors(90, 4);
  const auto residual = difference(b, product(transposed, solver.solve(b).y));
  EXPECT_LT(largest(product_transposed(transposed, residual)), 1e-13);
  EXPECT_GT(largest(residual), 0.1);
}

TEST(MinimumNorm, shares_out_what_equal_equations_ask_for) {
  DenseMatrix transposed = random_matrix(60, 50, 5);
  std::copy_n(transposed.values.begin(), 60, transposed.values.end() - 60);  // the first once more
  const MinimumNorm solver(transposed);
  EXPECT_EQ(solver.rank(), 49u);
  const auto b = random_vectors(50, 6);
  const auto residual = difference(b, product(transposed, solver.solve(b).y));
  EXPECT_LT(glm::distance(residual.front(), 0.5 * (b.front() - b.back())), 1e-13);
  EXPECT_LT(glm::distance(residual.back(), 0.5 * (b.back() - b.front())), 1e-13);
  EXPECT_LT(largest(std::span(residual).subspan(1, 48)), 1e-13);
}

TEST(MinimumNorm, takes_what_is_free_for_all_that_the_rest_need_not_do) {
  const DenseMatrix transposed = random_matrix(20, 5, 7);
  DenseMatrix free{5, 1, {1, 1, 1, 1, 1}};
  const MinimumNorm solver(transposed, free);
  const MinimumNormSolution same = solver.solve(std::vector<glm::dvec3>(5, {1, 2, 3}));
  EXPECT_LT(largest(same.y), 1e-14);
  EXPECT_LT(glm::distance(same.a[0], {1, 2, 3}), 1e-14);
  const auto b = random_vectors(5, 8);
  const MinimumNormSolution found = solver.solve(b);
  auto done = product(transposed, found.y);
  for (glm::dvec3& v : done) {
    v += found.a[0];
  }
  EXPECT_LT(largest(difference(done, b)), 1e-13);
  // The least |y| over all a: its slope along a, yᵀ ∂y/∂a, is zero.
  const MinimumNorm fixed(transposed);
  const auto slope = fixed.solve(std::vector<glm::dvec3>(5, glm::dvec3(1))).y;
  double along = 0;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    along += slope[i].x * found.y[i].x;
  }
  EXPECT_NEAR(along, 0, 1e-13);
}

TEST(MinimumNorm, gives_the_same_bits_for_any_number_of_threads) {
  const auto solve = [](int threads) {
    set_thread_count(threads);
    return MinimumNorm(random_matrix(300, 120, 9)).solve(random_vectors(120, 10)).y;
  };
  const auto one = solve(1);
  EXPECT_EQ(solve(2), one);
  set_thread_count(0);
}

TEST(MinimumNorm, of_nothing_is_nothing) {
  EXPECT_TRUE(MinimumNorm({0, 3, {}}).solve(std::vector<glm::dvec3>(3, glm::dvec3(1))).y.empty());
  EXPECT_EQ(MinimumNorm({4, 0, {}}).solve({}).y.size(), 4u);
  EXPECT_THROW(require_solvable({std::size_t{1} << 20, std::size_t{1} << 20, {}}), ParameterError);
}

}  // namespace
}  // namespace espalier
