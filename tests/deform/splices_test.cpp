#include "deform/model/splices.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(Splices, leave_the_bytes_alone_when_there_are_none) {
  Splices splices;
  EXPECT_TRUE(splices.empty());
  EXPECT_EQ(splices.apply("abc"), "abc");
}

TEST(Splices, replace_and_insert_at_places_added_in_any_order) {
  Splices splices;
  splices.replace({4, 1}, "EEE");
  splices.insert(0, "<");
  splices.replace({1, 2}, "");
  splices.insert(6, "1");
  splices.insert(6, "2");
  EXPECT_EQ(splices.apply("abcdef"), "<adEEEf12");
}

TEST(Splices, insert_before_what_is_replaced_at_the_same_place) {
  Splices splices;
  splices.insert(1, "x");
  splices.replace({1, 1}, "y");
  EXPECT_EQ(splices.apply("abc"), "axyc");
}

}  // namespace
}  // namespace espalier
