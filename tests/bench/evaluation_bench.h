#pragma once

#include <cstddef>

namespace espalier {

/// Prints the table of what evaluation reaches, each line a ratio within this run. At most
/// `max_points` points (46,590, then 527,252, then 10 million).
void bench_evaluation(std::size_t max_points);

}  // namespace espalier
