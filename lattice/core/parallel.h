#pragma once

/// The one wrapper over OpenMP. Bodies gather only (each writes its own results), so the results
/// have the same bits for any number of threads.

#include <algorithm>
#include <cstddef>
#include <functional>

namespace espalier {

/// Threads that parallel loops may use; 0 restores the default (all cores, or OMP_NUM_THREADS).
void set_thread_count(int n);
[[nodiscard]] int thread_count();

/// Calls body(begin, end) over consecutive ranges of at most `grain` indices that cover [0, n).
/// Serial when one range suffices. The exception of the lowest range that threw is rethrown, after
/// all ranges that began have ended.
void parallel_ranges(std::size_t n, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body);

/// Calls body(i) for every i in [0, n), `grain` of them at a time.
template <class Body>
void parallel_for(std::size_t n, const Body& body, std::size_t grain = 1024) {
  parallel_ranges(n, grain, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      body(i);
    }
  });
}

}  // namespace espalier
