#pragma once

#include <cstddef>

namespace espalier::test {

/// How often this program has taken memory by `new`, in all threads.
[[nodiscard]] std::size_t n_allocations();

}  // namespace espalier::test
