#include "lattice/core/text_scanner.h"

#include <gtest/gtest.h>

#include <cmath>

namespace espalier {
namespace {

TEST(TextScanner, splits_lines_at_every_kind_of_end) {
  TextScanner scanner("f", "a b\r\nc\rd\n\ne");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "a b");
  EXPECT_EQ(scanner.next_word(), "a");
  EXPECT_EQ(scanner.next_word(), "b");
  EXPECT_EQ(scanner.next_word(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "c");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "d");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "e");
  EXPECT_EQ(scanner.line_number(), 5u);
  EXPECT_FALSE(scanner.next_line());
}

TEST(TextScanner, refuses_what_is_no_finite_coordinate) {
  for (const char* bad : {"nan", "inf", "-inf", "1e300", "1e999", "0x10", "1.0abc", "--1", ""}) {
    const std::string text = bad + std::string("\n");
    TextScanner scanner("model.obj", text);
    scanner.next_line();
    EXPECT_THROW((void)scanner.next_coordinate("x"), FileError) << bad;
  }
}

TEST(TextScanner, names_file_and_line_in_errors) {
  TextScanner scanner("model.obj", "1 2\nx y\n");
  scanner.next_line();
  scanner.next_line();
  try {
    (void)scanner.next_number("the x coordinate");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "model.obj:2: the x coordinate is 'x', not a number");
  }
}

TEST(TextScanner, joins_lines_that_end_in_a_backslash) {
  TextScanner scanner("f", "a b\\\r\nc \\\n d\ne\\", {.joins_lines = true});
  ASSERT_TRUE(scanner.next_line());
  for (const char* word : {"a", "b", "c", "d", ""}) {
    EXPECT_EQ(scanner.next_word(), word);
  }
  EXPECT_EQ(scanner.line_number(), 3u);
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line_number(), 4u);
  EXPECT_EQ(scanner.next_word(), "e");
  EXPECT_EQ(scanner.next_word(), "");
  EXPECT_FALSE(scanner.next_line());
}

TEST(TextScanner, names_the_line_of_the_word_within_joined_lines) {
  TextScanner scanner("f", "1 \\\n2 \\\nx\n", {.joins_lines = true});
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.next_number("a"), 1);
  EXPECT_EQ(scanner.next_number("b"), 2);
  try {
    (void)scanner.next_number("c");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "f:3: c is 'x', not a number");
  }
}

TEST(TextScanner, ends_a_line_at_a_comment_which_joins_nothing) {
  TextScanner scanner("f", "a# b \\\n#c\nname#1 # d\n", {.comment = '#', .joins_lines = true});
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.next_word(), "a");
  EXPECT_EQ(scanner.next_word(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.next_word(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.next_name(), "name#1");
  EXPECT_EQ(scanner.next_name(), "");
  EXPECT_FALSE(scanner.next_line());
}

TEST(TextScanner, takes_bytes_across_line_ends) {
  TextScanner scanner("f", "3:a\nb\n12:\nx y\n\nlast");
  EXPECT_EQ(scanner.bytes_left(), 19u);
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.next_bytes(2), "3:");
  EXPECT_EQ(scanner.next_bytes(3), "a\nb");
  EXPECT_EQ(scanner.line_number(), 2u);
  EXPECT_EQ(scanner.next_word(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.next_bytes(3), "12:");
  EXPECT_EQ(scanner.next_bytes(2), "\nx");
  EXPECT_EQ(scanner.next_word(), "y");
  EXPECT_EQ(scanner.line_number(), 4u);
  EXPECT_EQ(scanner.bytes_left(), 6u);
  EXPECT_EQ(scanner.next_bytes(6), "\n\nlast");
  EXPECT_EQ(scanner.bytes_left(), 0u);
  EXPECT_EQ(scanner.next_word(), "");
  EXPECT_FALSE(scanner.next_line());
}

TEST(ParseNumber, reads_signs_exponents_and_numbers_beyond_the_range) {
  double number = 0;
  EXPECT_TRUE(parse_number("+1.5e2", number));
  EXPECT_EQ(number, 150.0);
  EXPECT_TRUE(parse_number("1e-999", number));
  EXPECT_EQ(number, 0.0);
  EXPECT_TRUE(parse_number("1e999", number));
  EXPECT_TRUE(std::isinf(number));
  EXPECT_FALSE(parse_number("+-1", number));
  EXPECT_FALSE(parse_number("", number));
}

}  // namespace
}  // namespace espalier
