/// How fast and how exact the library is, mostly as ratios between times measured in one run: to
/// sorting, to copying memory, to the processor's peak, to other ways. Each time is the best of
/// some repeats.
///
/// usage: espalier_bench [SECTION…]    without any: all sections

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <string_view>
#include <vector>

#include "tests/bench/sections.h"

namespace espalier::bench {
namespace {

/// A part of the benchmark that can be asked for by its name.
struct Section {
  std::string_view name;
  void (*run)();
};

constexpr Section kSections[] = {
    {"topology", bench_topology}, {"embedding", bench_embedding},
    {"freezing", bench_freezing}, {"evaluation", bench_evaluation},
    {"reposing", bench_reposing}, {"drags", bench_drags},
    {"tensor", bench_tensor},     {"pulling", bench_pulling},
    {"fitting", bench_fitting},   {"certificates", bench_certificates},
};

int run(std::span<const std::string_view> names) {
  std::vector<Section> wanted;
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(kSections, name, &Section::name);
    if (found == std::end(kSections)) {
      fmt::print(stderr, "espalier_bench: there is no section '{}', but", name);
      for (const Section& section : kSections) {
        fmt::print(stderr, " {}", section.name);
      }
      fmt::print(stderr, "\n");
      return 2;
    }
    wanted.push_back(*found);
  }
  if (wanted.empty()) {
    wanted.assign(std::begin(kSections), std::end(kSections));
  }
  for (const Section& section : wanted) {
    fmt::print("== {}\n", section.name);
    section.run();
  }
  return 0;
}

}  // namespace
}  // namespace espalier::bench

int main(int argc, char** argv) {
  try {
    return espalier::bench::run(std::vector<std::string_view>(argv + 1, argv + argc));
  } catch (const std::exception& error) {
    fmt::print(stderr, "espalier_bench: {}\n", error.what());
    return 1;
  }
}
