#include "lattice/core/streamed_copy.h"

#include <emmintrin.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

namespace espalier {
namespace {

constexpr std::size_t kUsualCache = std::size_t{32} << 20;
constexpr std::size_t kVectorBytes = 16;
constexpr std::size_t kLineBytes = 64;

void stream(const float* from, float* to) {
  _mm_stream_ps(to, _mm_loadu_ps(from));
}
void stream(const double* from, double* to) {
  _mm_stream_pd(to, _mm_loadu_pd(from));
}

/// Lines that are written in part would cost a read and two writes: they are stored as usual.
template <class Real>
void copy(const Real* from, std::size_t n, Real* to) {
  constexpr std::size_t kWidth = kVectorBytes / sizeof(Real);
  constexpr std::size_t kLine = kLineBytes / sizeof(Real);
  const std::size_t past = reinterpret_cast<std::uintptr_t>(to) % kLineBytes / sizeof(Real);
  std::size_t i = std::min(n, (kLine - past) % kLine);
  std::copy_n(from, i, to);
  for (; i + kLine <= n; i += kLine) {
#pragma GCC unroll 4
    for (std::size_t j = i; j < i + kLine; j += kWidth) {
      stream(from + j, to + j);
    }
  }
  std::copy(from + i, from + n, to + i);
}

}  // namespace

std::size_t last_cache_bytes() {
  static const long found = ::sysconf(_SC_LEVEL3_CACHE_SIZE);
  return found > 0 ? static_cast<std::size_t>(found) : kUsualCache;
}

void streamed_copy(const float* from, std::size_t n, float* to) {
  copy(from, n, to);
}

void streamed_copy(const double* from, std::size_t n, double* to) {
  copy(from, n, to);
}

void finish_streaming() {
  _mm_sfence();
}

}  // namespace espalier
