#pragma once

/// Helpers of the checks: naming defects and gathering them in parallel, in element order.

#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lattice/core/parallel.h"
#include "lattice/topology/defect.h"

namespace espalier {

/// "ELEMENT INDEX: WHAT".
inline Defect make_defect(DefectKind kind, std::string_view element, std::size_t index,
                          std::string_view what) {
  return {kind, std::string(element), static_cast<std::int64_t>(index),
          fmt::format("{} {}: {}", element, index, what)};
}

/// The ids of an edge's ends name it: "edge A-B: WHAT".
inline Defect make_edge_defect(DefectKind kind, std::int32_t a, std::int32_t b,
                               std::string_view what) {
  return {kind, "edge", -1, fmt::format("edge {}-{}: {}", a, b, what)};
}

/// Appends what checks find in n elements, in element order whatever the number of threads.
/// make_check() gives a check for some of them, with memory of its own; check(i) returns an
/// optional defect, or a vector of them.
template <class MakeCheck>
void collect_defects_with(std::size_t n, const MakeCheck& make_check, std::vector<Defect>& defects,
                          std::size_t grain = 4096) {
  std::vector<std::vector<Defect>> found((n + grain - 1) / grain);
  parallel_ranges(n, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Defect>& here = found[begin / grain];
    auto check = make_check();
    for (std::size_t i = begin; i < end; ++i) {
      auto some = check(i);
      if constexpr (requires { some.has_value(); }) {
        if (some) {
          here.push_back(*std::move(some));
        }
      } else {
        std::move(some.begin(), some.end(), std::back_inserter(here));
      }
    }
  });
  for (std::vector<Defect>& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(defects));
  }
}

/// The same with one check that needs no memory.
template <class Check>
void collect_defects(std::size_t n, const Check& check, std::vector<Defect>& defects,
                     std::size_t grain = 4096) {
  collect_defects_with(
      n, [&check] { return std::cref(check); }, defects, grain);
}

}  // namespace espalier
