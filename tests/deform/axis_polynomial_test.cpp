#include "deform/evaluate/axis_polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "lattice/volume/bernstein_lines.h"

namespace espalier {
namespace {

std::vector<Extraction> kernel_extractions() {
  std::vector<Extraction> extractions;
  for (int degree = 1; degree <= kMaxKernelDegree; ++degree) {
    extractions.push_back(bezier_extraction(degree));
  }
  for (const bool begin : {false, true}) {
    for (const bool end : {false, true}) {
      extractions.push_back(uniform_cubic_extraction(begin, end));
    }
  }
  return extractions;
}

/// By de Casteljau's algorithm on the Bézier points.
double bezier_value(const Extraction& extraction, const std::array<double, 4>& coefficients,
                    double u) {
  std::vector<double> line(static_cast<std::size_t>(extraction.degree) + 1, 0.0);
  for (int i = 0; i <= extraction.degree; ++i) {
    for (int k = 0; k < extraction.n_coefficients; ++k) {
      line[static_cast<std::size_t>(i)] +=
          extraction.row(i, k) * coefficients[static_cast<std::size_t>(k)];
    }
  }
  for (std::size_t left = line.size(); left > 1; --left) {
    de_casteljau_step(std::span(line).first(left), u);
  }
  return line[0];
}

double value(const AxisPolynomial<double>& axis, const std::array<double, 4>& coefficients,
             double t) {
  double result = 0;
  for (int power = axis.degree; power >= 0; --power) {
    result *= t;
    for (int k = 0; k < axis.n_coefficients; ++k) {
      result += axis.rows[power][k] * coefficients[static_cast<std::size_t>(k)];
    }
  }
  return result;
}

TEST(AxisPolynomial, equals_the_bezier_form_seen_from_either_end) {
  const std::array<double, 4> coefficients = {0.3, -1.2, 2.5, 0.7};
  for (const Extraction& extraction : kernel_extractions()) {
    for (const double u : {-0.05, 0.0, 0.2, 0.5, 0.9, 1.0, 1.05}) {
      const double expected = bezier_value(extraction, coefficients, u);
      EXPECT_NEAR(value(axis_polynomial<double>(extraction, false), coefficients, u), expected,
                  4e-15);
      EXPECT_NEAR(value(axis_polynomial<double>(extraction, true), coefficients, 1 - u), expected,
                  4e-15);
    }
  }
}

TEST(AxisPolynomial, begins_with_the_bezier_point_of_its_end_to_the_bit) {
  for (const Extraction& extraction : kernel_extractions()) {
    for (const bool from_far_end : {false, true}) {
      const auto axis = axis_polynomial<double>(extraction, from_far_end);
      for (int k = 0; k < extraction.n_coefficients; ++k) {
        EXPECT_EQ(axis.rows[0][k], extraction.row(from_far_end ? extraction.degree : 0, k));
      }
    }
  }
}

TEST(AxisPolynomial, of_a_cubic_has_the_binomial_powers) {
  const auto axis = axis_polynomial<float>(bezier_extraction(3), false);
  const float expected[4][4] = {{1, 0, 0, 0}, {-3, 3, 0, 0}, {3, -6, 3, 0}, {-1, 3, -3, 1}};
  for (int power = 0; power < 4; ++power) {
    EXPECT_TRUE(std::equal(expected[power], expected[power] + 4, axis.rows[power])) << power;
  }
}

TEST(AxisPolynomial, exists_for_degrees_one_to_three) {
  EXPECT_FALSE(is_kernel_axis(bezier_extraction(0)));
  EXPECT_FALSE(is_kernel_axis(bezier_extraction(4)));
  for (const Extraction& extraction : kernel_extractions()) {
    EXPECT_TRUE(is_kernel_axis(extraction));
  }
}

TEST(AxisPolynomials, stand_in_pairs_and_are_empty_where_kernels_know_none) {
  const auto axes = axis_polynomials<double>({bezier_extraction(2), bezier_extraction(4)});
  ASSERT_EQ(axes.size(), 4u);
  EXPECT_EQ(axes[0].degree, 2);
  EXPECT_EQ(axes[0].rows[1][0], -2);  // (1 − t)² from the near end
  EXPECT_EQ(axes[1].rows[1][0], 0);   // t² from the far end
  EXPECT_EQ(axes[1].rows[2][0], 1);
  for (const double entry : axes[3].rows[0]) {
    EXPECT_EQ(entry, 0);
  }
}

}  // namespace
}  // namespace espalier
