#pragma once

/// Timing and printing for the benchmarks.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "lattice/core/parallel.h"

namespace espalier::bench {

inline double clock_seconds(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// With one thread the time of the processor, which other programs hardly disturb; with more the
/// time that passes.
inline double now() {
  return clock_seconds(thread_count() == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC);
}

/// Seconds that `work` takes: the best of `repeats`.
template <class Work>
double seconds(const Work& work, int repeats = 3) {
  double best = 1e300;
  for (int i = 0; i < repeats; ++i) {
    const double start = now();
    work();
    best = std::min(best, now() - start);
  }
  return best;
}

/// The least seconds of several works, taken in turn, so that what else the machine does hits all
/// alike; each runs three times in its turn, the first to bring its data into the caches.
template <class... Works>
std::array<double, sizeof...(Works)> best_seconds(int rounds, const Works&... works) {
  std::array<double, sizeof...(Works)> best;
  best.fill(1e300);
  for (int round = 0; round < rounds; ++round) {
    std::size_t at = 0;
    const auto time = [&](const auto& work) {
      best[at] = std::min(best[at], seconds(work, 3));
      ++at;
    };
    (time(works), ...);
  }
  return best;
}

/// How many times as fast `work` is with two threads as with one, both by the time that passes,
/// taken in turn.
template <class Work>
double two_thread_gain(int rounds, const Work& work) {
  double best[2] = {1e300, 1e300};
  for (int i = 0; i < 6 * rounds; ++i) {
    const int threads = i / 3 % 2 + 1;
    set_thread_count(threads);
    const double start = clock_seconds(CLOCK_MONOTONIC);
    work();
    double& least = best[threads - 1];
    least = std::min(least, clock_seconds(CLOCK_MONOTONIC) - start);
  }
  set_thread_count(1);
  return best[0] / best[1];
}

/// Seconds to copy `bytes` once, out of and into memory that is too large for a cache.
inline double copy_seconds(std::size_t bytes) {
  static constexpr std::size_t kBlock = std::size_t{1} << 28;
  static std::vector<char> from(kBlock, 1);
  static std::vector<char> to(kBlock, 2);
  const double a_byte = seconds([] { std::memcpy(to.data(), from.data(), kBlock); }) / kBlock;
  return a_byte * static_cast<double>(bytes);
}

inline void print(const std::string& what, double value, const std::string& unit) {
  fmt::print("  {:<66} {:>9.3g} {}\n", what, value, unit);
}

/// A ratio, and whether it is at most ('<') or at least ('>') the mark.
inline void print_mark(const std::string& what, double value, char relation, double mark) {
  const bool is_reached = relation == '<' ? value <= mark : value >= mark;
  fmt::print("  {:<66} {:>9.3g} {} {:<5} {}\n", what, value, relation == '<' ? "≤" : "≥", mark,
             is_reached ? "reached" : "missed");
}

}  // namespace espalier::bench
