#pragma once

#include <cstddef>
#include <vector>

namespace espalier {

/// Memory that begins with a cache line; where it is large, with a page of 2 MiB, and the system is
/// asked for such pages, so that walks along it do not stop at every 4 KiB. Throws std::bad_alloc.
[[nodiscard]] void* allocate_lines(std::size_t bytes);
void free_lines(void* memory, std::size_t bytes);

/// Memory of which no vector of a row of numbers lies across two cache lines.
template <class T>
struct CacheAligned {
  using value_type = T;

  CacheAligned() = default;
  template <class U>
  explicit CacheAligned(const CacheAligned<U>& /*other*/) {}

  [[nodiscard]] T* allocate(std::size_t n) {
    return static_cast<T*>(allocate_lines(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) { free_lines(memory, n * sizeof(T)); }
  bool operator==(const CacheAligned&) const = default;
};

template <class T>
using AlignedVector = std::vector<T, CacheAligned<T>>;

}  // namespace espalier
