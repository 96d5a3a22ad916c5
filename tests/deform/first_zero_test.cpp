#include "deform/evaluate/first_zero.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

/// Of scale (t − a)(t − b)(t − c).
std::array<double, 4> cubic(double a, double b, double c, double scale) {
  return {-scale * a * b * c, scale * (a * b + b * c + c * a), -scale * (a + b + c), scale};
}

TEST(FirstZero, is_the_least_of_a_cubics_zeros_in_the_unit_interval) {
  EXPECT_NEAR(first_zero(cubic(0.25, 0.5, 0.75, -1)).value(), 0.25, 1e-14);
  EXPECT_NEAR(first_zero(cubic(-0.5, 0.375, 0.9, 1)).value(), 0.375, 1e-14);
  EXPECT_NEAR(first_zero(cubic(1e-9, 3, 5, -1)).value(), 1e-9, 1e-20);
  EXPECT_FALSE(first_zero(cubic(-1, 1.01, 2, 1)));
  EXPECT_NEAR(first_zero({1, 0, 0, -8}).value(), 0.5, 1e-14);
}

TEST(FirstZero, knows_quadratics_lines_and_constants) {
  EXPECT_NEAR(first_zero({0.125, -0.75, 1, 0}).value(), 0.25, 1e-14);
  EXPECT_EQ(first_zero({1, -2, 0, 0}), 0.5);
  EXPECT_EQ(first_zero({1, -1, 0, 0}), 1);
  EXPECT_FALSE(first_zero({1, -0.999, 0, 0}));
  EXPECT_FALSE(first_zero({1, 0, 0, 0}));
  EXPECT_FALSE(first_zero({1, 0, -0.5, 0}));
  EXPECT_EQ(first_zero({0, 1, 0, 0}), 0);
}

}  // namespace
}  // namespace espalier
