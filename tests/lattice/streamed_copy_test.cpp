#include "lattice/core/streamed_copy.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "lattice/core/cache_aligned.h"

namespace espalier {
namespace {

template <class Real>
void expect_copies_of_any_length_from_and_to_any_place() {
  std::vector<Real> from(80);
  std::iota(from.begin(), from.end(), Real{1});
  for (std::size_t first = 0; first < 9; ++first) {
    for (std::size_t target = 0; target < 9; ++target) {
      for (std::size_t n = 0; n < 60; ++n) {
        AlignedVector<Real> to(80, Real{-1});
        streamed_copy(&from[first], n, &to[target]);
        finish_streaming();
        for (std::size_t i = 0; i < to.size(); ++i) {
          const bool is_copied = i >= target && i < target + n;
          ASSERT_EQ(to[i], is_copied ? from[first + i - target] : Real{-1})
              << first << " " << target << " " << n;
        }
      }
    }
  }
}

TEST(StreamedCopy, copies_numbers_of_any_length_from_and_to_any_place) {
  expect_copies_of_any_length_from_and_to_any_place<float>();
  expect_copies_of_any_length_from_and_to_any_place<double>();
}

TEST(StreamedCopy, knows_a_cache_of_a_size_that_processors_have) {
  EXPECT_GE(last_cache_bytes(), std::size_t{1} << 18);
  EXPECT_LE(last_cache_bytes(), std::size_t{1} << 34);
}

TEST(AlignedVector, begins_with_a_line_and_where_it_is_large_with_a_large_page) {
  const auto address = [](const auto& vector) {
    return reinterpret_cast<std::uintptr_t>(vector.data());
  };
  EXPECT_EQ(address(AlignedVector<float>(7)) % 64, 0u);
  AlignedVector<float> large(std::size_t{3} << 20, 1.0F);
  EXPECT_EQ(address(large) % (std::uintptr_t{1} << 21), 0u);
  large.resize(5);
  large.shrink_to_fit();
  EXPECT_EQ(large, AlignedVector<float>(5, 1.0F));
}

}  // namespace
}  // namespace espalier
