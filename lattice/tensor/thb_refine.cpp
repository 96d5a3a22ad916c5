#include "lattice/tensor/thb_refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// Cells on each side of a leaf that are refined with it: a row of three is six of the next level,
/// and no function's support is longer.
constexpr int kRing = 1;

/// Adds the leaf and its neighbours to the domain of the next level, and what holds them to the
/// domains before.
void refine_leaf(const ThbHierarchy& hierarchy, const ThbCell& leaf,
                 std::vector<std::vector<GridIndex>>& domains) {
  const std::array<int, 3> n = hierarchy.n_cells(leaf.level);
  const auto low = [&](std::size_t a) { return std::max(leaf.index[a] - kRing, 0); };
  const auto high = [&](std::size_t a) { return std::min(leaf.index[a] + kRing, n[a] - 1); };
  domains.resize(std::max(domains.size(), static_cast<std::size_t>(leaf.level) + 1));
  for (std::int32_t k = low(2); k <= high(2); ++k) {
    for (std::int32_t j = low(1); j <= high(1); ++j) {
      for (std::int32_t i = low(0); i <= high(0); ++i) {
        for (int level = leaf.level; level >= 0; --level) {
          const int shift = leaf.level - level;
          domains[static_cast<std::size_t>(level)].push_back({i >> shift, j >> shift, k >> shift});
        }
      }
    }
  }
}

}  // namespace

ThbLattice refined_round(const ThbLattice& lattice, std::span<const glm::dvec3> places) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  const std::vector<ThbCell> leaves = hierarchy.leaves();
  std::vector<std::size_t> held;
  for (const glm::dvec3& place : places) {
    held.push_back(place_of(hierarchy, leaves, place).patch);
  }
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  std::vector<std::vector<GridIndex>> domains = hierarchy.domains();
  for (const std::size_t leaf : held) {
    refine_leaf(hierarchy, leaves[leaf], domains);
  }
  return refined_to(lattice, std::make_shared<const ThbHierarchy>(
                                 hierarchy.counts(), hierarchy.degree(), std::move(domains)));
}

/// Knot insertion takes any values along with the points.
std::vector<double> carried_over(const ThbLattice& before, const ThbLattice& after,
                                 std::span<const double> values) {
  if (values.size() != before.rest.size()) {
    throw ParameterError(fmt::format("there are {} values for {} control points", values.size(),
                                     before.rest.size()));
  }
  ThbLattice carrier = before;
  carrier.pose.clear();
  for (const double value : values) {
    carrier.pose.emplace_back(value, 0, 0);
  }
  std::vector<double> result;
  for (const glm::dvec3& value : refined_to(carrier, after.hierarchy).pose) {
    result.push_back(value.x);
  }
  return result;
}

}  // namespace espalier
