#include "lattice/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace espalier {
namespace {

/// Sets the number of threads for one scope.
class Threads {
 public:
  explicit Threads(int n) { set_thread_count(n); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() { set_thread_count(0); }
};

TEST(ParallelFor, visits_every_index_once) {
  for (const int threads : {1, 4}) {
    const Threads scope(threads);
    for (const std::size_t n : {0u, 1u, 7u, 1024u, 1025u, 100000u}) {
      std::vector<int> n_visits(n, 0);
      parallel_for(n, [&](std::size_t i) { ++n_visits[i]; });
      EXPECT_EQ(n_visits, std::vector<int>(n, 1));
    }
  }
}

TEST(ParallelRanges, cuts_at_multiples_of_the_grain) {
  for (const int threads : {1, 4}) {
    const Threads scope(threads);
    std::vector<std::size_t> end_of(4, 0);
    parallel_ranges(10, 3, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 3, 0u);
      end_of[begin / 3] = end;
    });
    EXPECT_EQ(end_of, (std::vector<std::size_t>{3, 6, 9, 10}));
  }
}

TEST(ParallelRanges, treats_a_grain_of_zero_as_one) {
  std::atomic<int> n = 0;
  parallel_ranges(3, 0, [&](std::size_t begin, std::size_t end) {
    EXPECT_EQ(end, begin + 1);
    ++n;
  });
  EXPECT_EQ(n, 3);
}

TEST(ParallelRanges, rethrows_the_lowest_range_s_exception) {
  for (const int threads : {1, 4}) {
    const Threads scope(threads);
    for (int repeat = 0; repeat < 20; ++repeat) {
      try {
        parallel_for(
            1000,
            [](std::size_t i) {
              if (i % 100 == 37) {
                throw std::runtime_error(std::to_string(i));
              }
            },
            10);
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "37");
      }
    }
  }
}

TEST(ParallelFor, may_be_nested) {
  const Threads scope(4);
  std::vector<std::vector<int>> values(50, std::vector<int>(3000, 0));
  parallel_for(
      50, [&](std::size_t i) { parallel_for(3000, [&](std::size_t j) { values[i][j] += 1; }); }, 1);
  EXPECT_EQ(values, std::vector<std::vector<int>>(50, std::vector<int>(3000, 1)));
}

TEST(SetThreadCount, sets_and_restores_the_number_of_threads) {
  const int before = thread_count();
  set_thread_count(3);
  EXPECT_EQ(thread_count(), 3);
  set_thread_count(0);
  EXPECT_EQ(thread_count(), before);
}

}  // namespace
}  // namespace espalier
