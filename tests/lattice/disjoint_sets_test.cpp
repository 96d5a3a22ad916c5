#include "lattice/core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(DisjointSets, are_named_by_their_smallest_number_however_they_were_joined) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.join(5, 3));
  EXPECT_TRUE(sets.join(2, 4));
  EXPECT_TRUE(sets.join(4, 5));
  EXPECT_FALSE(sets.join(3, 2));
  for (const std::size_t i : {2, 3, 4, 5}) {
    EXPECT_EQ(sets.first(i), 2U);
  }
  EXPECT_EQ(sets.first(0), 0U);
  EXPECT_EQ(sets.first(1), 1U);
  sets.reset(3);
  EXPECT_EQ(sets.first(2), 2U);
}

}  // namespace
}  // namespace espalier
