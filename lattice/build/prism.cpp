#include "lattice/build/prism.h"

#include <cassert>

namespace espalier {

std::vector<VertexLoop> prism_loops(std::span<const std::int32_t> lower,
                                    std::span<const std::int32_t> upper) {
  assert(lower.size() == upper.size());
  std::vector<VertexLoop> loops;
  loops.reserve(lower.size() + 2);
  loops.emplace_back(lower.rbegin(), lower.rend());
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const std::size_t j = i + 1 < lower.size() ? i + 1 : 0;
    loops.push_back({lower[i], lower[j], upper[j], upper[i]});
  }
  loops.emplace_back(upper.begin(), upper.end());
  return loops;
}

std::vector<VertexLoop> pyramid_loops(std::span<const std::int32_t> base, std::int32_t apex) {
  std::vector<VertexLoop> loops;
  loops.reserve(base.size() + 1);
  loops.emplace_back(base.rbegin(), base.rend());
  for (std::size_t i = 0; i < base.size(); ++i) {
    loops.push_back({base[i], base[i + 1 < base.size() ? i + 1 : 0], apex});
  }
  return loops;
}

}  // namespace espalier
