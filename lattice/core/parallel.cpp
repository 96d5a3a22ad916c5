#include "lattice/core/parallel.h"

#include <omp.h>

#include <exception>
#include <mutex>

namespace espalier {

void set_thread_count(int n) {
  static const int default_count = omp_get_max_threads();  // nobody else changes it
  omp_set_num_threads(n > 0 ? n : default_count);
}

int thread_count() {
  return omp_get_max_threads();
}

void parallel_ranges(std::size_t n, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t n_ranges = (n + grain - 1) / grain;
  if (n_ranges <= 1 || thread_count() == 1 || omp_in_parallel()) {
    for (std::size_t begin = 0; begin < n; begin += grain) {
      body(begin, std::min(begin + grain, n));
    }
    return;
  }
  std::exception_ptr first_error;
  std::size_t first_range = n_ranges;
  std::mutex error_mutex;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t range = 0; range < n_ranges; ++range) {
    try {
      body(range * grain, std::min((range + 1) * grain, n));
    } catch (...) {
      const std::lock_guard lock(error_mutex);
      if (range < first_range) {
        first_range = range;
        first_error = std::current_exception();
      }
    }
  }
  if (first_error) {
    std::rethrow_exception(first_error);
  }
}

}  // namespace espalier
