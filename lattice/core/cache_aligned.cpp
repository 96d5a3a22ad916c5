#include "lattice/core/cache_aligned.h"

#include <sys/mman.h>

#include <new>

namespace espalier {
namespace {

constexpr std::align_val_t kLine{64};
constexpr std::align_val_t kLargePage{std::size_t{1} << 21};

std::align_val_t alignment_for(std::size_t bytes) {
  return bytes >= 2 * static_cast<std::size_t>(kLargePage) ? kLargePage : kLine;
}

}  // namespace

void* allocate_lines(std::size_t bytes) {
  const std::align_val_t alignment = alignment_for(bytes);
  void* const memory = ::operator new(bytes, alignment);
  if (alignment == kLargePage) {
    ::madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: nothing is lost where it is not granted
  }
  return memory;
}

void free_lines(void* memory, std::size_t bytes) {
  ::operator delete(memory, alignment_for(bytes));
}

}  // namespace espalier
