#include "deform/model/encoded_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace espalier {
namespace {

TEST(EncodedNumber, is_the_shortest_at_the_precision_of_the_file) {
  EXPECT_EQ(EncodedNumber(0.1, NumberEncoding::FloatText).view(), "0.1");
  EXPECT_EQ(EncodedNumber(1.0 / 3.0, NumberEncoding::FloatText).view(), "0.33333334");
  EXPECT_EQ(EncodedNumber(1.0 / 3.0, NumberEncoding::DoubleText).view(), "0.3333333333333333");
  EXPECT_EQ(EncodedNumber(-2.0, NumberEncoding::DoubleText).view(), "-2");
}

TEST(EncodedNumber, reads_back_as_the_same_number) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 10000; ++i) {
    const double number =
        std::ldexp(static_cast<double>(random()), static_cast<int>(i % 120) - 120);
    const std::string as_double(EncodedNumber(number, NumberEncoding::DoubleText).view());
    EXPECT_EQ(std::strtod(as_double.c_str(), nullptr), number);
    const std::string as_float(EncodedNumber(number, NumberEncoding::FloatText).view());
    EXPECT_EQ(std::strtof(as_float.c_str(), nullptr), static_cast<float>(number));
  }
}

TEST(SignificantDigits, count_from_the_first_that_is_not_zero) {
  EXPECT_EQ(significant_digits("0.000"), 0);
  EXPECT_EQ(significant_digits("-0.00120"), 3);
  EXPECT_EQ(significant_digits("105.342712"), 9);
  EXPECT_EQ(significant_digits("+1.5e-123"), 2);
}

TEST(IsSameNumber, compares_at_the_precision_of_the_file) {
  EXPECT_TRUE(is_same_number(1.0, 1.0 + 1e-12, NumberEncoding::FloatText));
  EXPECT_FALSE(is_same_number(1.0, 1.0 + 1e-12, NumberEncoding::DoubleText));
  EXPECT_TRUE(is_same_number(0.0, -0.0, NumberEncoding::DoubleText));
}

}  // namespace
}  // namespace espalier
