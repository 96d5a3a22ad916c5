#pragma once

/// Writing past the caches: results that are larger than them would first be read from memory, line
/// by line, only to be overwritten, and push out what the next frame reads.

#include <cstddef>

namespace espalier {

/// Of the processor's last cache.
[[nodiscard]] std::size_t last_cache_bytes();

/// Copies n numbers, whole cache lines of them without reading the old ones. The memory at `to` is
/// ready for other threads after finish_streaming().
void streamed_copy(const float* from, std::size_t n, float* to);
void streamed_copy(const double* from, std::size_t n, double* to);
void finish_streaming();

}  // namespace espalier
