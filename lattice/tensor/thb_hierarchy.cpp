// Selection of hierarchical B-splines by their supports.

#include "lattice/tensor/thb_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr int kMostCellsOnAxis = 1 << 20;
constexpr std::size_t kMostCells = std::size_t{1} << 26;

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

/// From this many cells on, functions in the middle see no end.
int short_length(int degree) {
  return 2 * degree + 2;
}

std::array<ThbAxis, 3> axes_of_level(const std::array<int, 3>& counts,
                                     const std::array<int, 3>& degree, int level) {
  const auto along = [&](std::size_t a) {
    return ThbAxis((counts[a] - degree[a]) << level, degree[a]);
  };
  return {along(0), along(1), along(2)};
}

void require_sizes(const std::array<int, 3>& counts, const std::array<int, 3>& degree,
                   std::size_t n_domains) {
  if (n_domains >= as_size(kMostThbLevels)) {
    throw ParameterError(fmt::format("{} levels, at most {}", n_domains + 1, kMostThbLevels));
  }
  double n = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    if (degree[a] < 1 || degree[a] > 5) {
      throw ParameterError(
          fmt::format("the degree along {} is {}, must be 1 to 5", "uvw"[a], degree[a]));
    }
    if (counts[a] <= degree[a]) {
      throw ParameterError(fmt::format("{} control points along {}, degree {} needs at least {}",
                                       counts[a], "uvw"[a], degree[a], degree[a] + 1));
    }
    // One level more, so that the next refinement can be prepared.
    if (static_cast<double>(counts[a]) * std::ldexp(1.0, static_cast<int>(n_domains) + 1) >
        kMostCellsOnAxis) {
      throw ParameterError(
          fmt::format("{} control points along {} refined {} times, at most {} "
                      "cells fit on an axis",
                      counts[a], "uvw"[a], n_domains, kMostCellsOnAxis));
    }
    n *= counts[a];
  }
  if (n > static_cast<double>(kMostCells)) {
    throw ParameterError(fmt::format("{} control points, at most {} are supported", n, kMostCells));
  }
}

/// Whether all cells of a box [low, high] are members.
bool holds_all(BrickGrid<char>::Reader& members, const GridIndex& low, const GridIndex& high) {
  for (std::int32_t k = low.k; k <= high.k; ++k) {
    for (std::int32_t j = low.j; j <= high.j; ++j) {
      for (std::int32_t i = low.i; i <= high.i; ++i) {
        if (members({i, j, k}) == 0) {
          return false;
        }
      }
    }
  }
  return true;
}

/// The first and the last cell of a function's support.
std::pair<GridIndex, GridIndex> support(const std::array<ThbAxis, 3>& axes, const GridIndex& f) {
  const auto low = [&](std::size_t a) { return std::max(f[a] - axes[a].degree(), 0); };
  const auto high = [&](std::size_t a) { return std::min(f[a], axes[a].n_cells() - 1); };
  return {{low(0), low(1), low(2)}, {high(0), high(1), high(2)}};
}

GridIndex halved(const GridIndex& index) {
  return {index.i >> 1, index.j >> 1, index.k >> 1};
}

template <class Visit>
void for_each_index(const GridIndex& low, const GridIndex& high, const Visit& visit) {
  for (std::int32_t k = low.k; k <= high.k; ++k) {
    for (std::int32_t j = low.j; j <= high.j; ++j) {
      for (std::int32_t i = low.i; i <= high.i; ++i) {
        visit(GridIndex{i, j, k});
      }
    }
  }
}

void require_next_level(const ThbHierarchy& hierarchy, int level) {
  if (level < 1 || level > hierarchy.n_levels() || level >= kMostThbLevels) {
    throw ParameterError(fmt::format("the level is {}, must be 1 to {}", level,
                                     std::min(hierarchy.n_levels(), kMostThbLevels - 1)));
  }
}

}  // namespace

ThbAxis::ThbAxis(int n_cells, int degree)
    : n_cells_(n_cells),
      short_(
          TensorAxis::make(std::min(n_cells, short_length(degree)) + degree, degree, Ends::Open)),
      insertions_(refined(short_).controls) {}

ThbAxis::Insertion ThbAxis::insertion(int j) const {
  const int n_short = static_cast<int>(short_.spans().size());
  const int middle = n_short + degree() / 2;
  const int shift = std::clamp((j - middle) >> 1, 0, n_cells_ - n_short);
  return {shift, &insertions_[as_size(j - 2 * shift)]};
}

const Extraction& ThbAxis::extraction(int cell) const {
  const int n_short = static_cast<int>(short_.spans().size());
  const int shift = std::clamp(cell - n_short / 2, 0, n_cells_ - n_short);
  return short_.spans()[as_size(cell - shift)].extraction;
}

ThbHierarchy::ThbHierarchy(const std::array<int, 3>& counts, const std::array<int, 3>& degree,
                           std::vector<std::vector<GridIndex>> domains)
    : counts_(counts), degree_(degree), domains_(std::move(domains)) {
  while (!domains_.empty() && domains_.back().empty()) {
    domains_.pop_back();
  }
  require_sizes(counts_, degree_, domains_.size());
  for (int level = 0; level <= n_levels(); ++level) {
    axes_.push_back(axes_of_level(counts_, degree_, level));
  }
  for (std::vector<GridIndex>& domain : domains_) {
    if (!std::is_sorted(domain.begin(), domain.end())) {
      std::sort(domain.begin(), domain.end());
    }
    domain.erase(std::unique(domain.begin(), domain.end()), domain.end());
    Membership& members = members_.emplace_back();
    for (const GridIndex& cell : domain) {
      members.set(cell, 1);
    }
  }
  check_domains();
  for (int level = 0; level < n_levels(); ++level) {
    add_level(level);
  }
  first_functions_.push_back(functions_.size());
}

void ThbHierarchy::check_domains() const {
  for (int level = 1; level < n_levels(); ++level) {
    const std::array<int, 3> n = n_cells(level - 1);
    if (domain(level).size() > kMostCells) {
      throw ParameterError(fmt::format("{} cells in the domain of level {}, at most {}",
                                       domain(level).size(), level, kMostCells));
    }
    for (const GridIndex& cell : domain(level)) {
      const bool exists = cell.i >= 0 && cell.j >= 0 && cell.k >= 0 && cell.i < n[0] &&
                          cell.j < n[1] && cell.k < n[2];
      if (!exists || !is_in_domain(level - 1, cell)) {
        throw LatticeError(fmt::format(
            "the domain of level {} holds the cell ({}, {}, {}) of level {}, which {}", level,
            cell.i, cell.j, cell.k, level - 1,
            exists ? fmt::format("lies outside the domain of level {}", level - 1)
                   : fmt::format("does not exist, there are {} × {} × {}", n[0], n[1], n[2])));
      }
    }
  }
}

std::array<int, 3> ThbHierarchy::n_cells(int level) const {
  const std::array<ThbAxis, 3>& axes = axes_[as_size(level)];
  return {axes[0].n_cells(), axes[1].n_cells(), axes[2].n_cells()};
}

bool ThbHierarchy::is_in_domain(int level, const GridIndex& cell) const {
  return level == 0 || (level < n_levels() &&
                        Membership::Reader(members_[as_size(level - 1)])(halved(cell)) != 0);
}

std::vector<GridIndex> ThbHierarchy::candidates(int level) const {
  const std::array<ThbAxis, 3>& axes = axes_[as_size(level)];
  std::vector<GridIndex> result;
  if (level == 0) {
    for_each_index(
        {}, {axes[0].n_functions() - 1, axes[1].n_functions() - 1, axes[2].n_functions() - 1},
        [&](const GridIndex& f) { result.push_back(f); });
    return result;
  }
  // Over the two children of each cell and `degree` more.
  std::vector<std::uint64_t> keys;
  const auto make_unique = [&] {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  };
  std::size_t most = std::size_t{1} << 22;
  for (const GridIndex& cell : domain(level)) {
    const GridIndex low = {2 * cell.i, 2 * cell.j, 2 * cell.k};
    for_each_index(low, {low.i + 1 + degree_[0], low.j + 1 + degree_[1], low.k + 1 + degree_[2]},
                   [&](const GridIndex& f) { keys.push_back(f.key()); });
    if (keys.size() > most) {
      make_unique();
      most = 2 * keys.size() + most;
    }
  }
  make_unique();
  for (const std::uint64_t key : keys) {
    result.push_back(GridIndex::of_key(key));
  }
  return result;
}

void ThbHierarchy::add_level(int level) {
  const std::array<ThbAxis, 3>& axes = axes_[as_size(level)];
  static const Membership kNothing;
  const bool is_last = level + 1 == n_levels();
  Membership::Reader own(level == 0 ? kNothing : members_[as_size(level - 1)]);
  Membership::Reader next(is_last ? kNothing : members_[as_size(level)]);
  first_functions_.push_back(functions_.size());
  BrickGrid<std::int32_t>& numbers = numbers_.emplace_back(-1);
  for (const GridIndex& f : candidates(level)) {
    const auto [low, high] = support(axes, f);
    if (!is_last && holds_all(next, low, high)) {
      continue;
    }
    const bool is_control = level == 0 || holds_all(own, halved(low), halved(high));
    numbers.set(f, static_cast<std::int32_t>(functions_.size()));
    functions_.push_back({level, f});
    function_controls_.push_back(is_control ? static_cast<std::int32_t>(controls_.size()) : -1);
    if (is_control) {
      controls_.push_back({level, f});
    }
  }
}

std::vector<std::size_t> ThbHierarchy::n_controls_by_level() const {
  std::vector<std::size_t> n(as_size(n_levels()), 0);
  for (const ThbFunction& control : controls_) {
    ++n[as_size(control.level)];
  }
  return n;
}

std::vector<ThbCell> ThbHierarchy::leaves() const {
  std::vector<ThbCell> result;
  static const Membership kNothing;
  for (int level = 0; level < n_levels(); ++level) {
    Membership::Reader next(level + 1 == n_levels() ? kNothing : members_[as_size(level)]);
    const std::size_t first = result.size();
    const auto add = [&](const GridIndex& cell) {
      if (next(cell) == 0) {
        result.push_back({level, cell});
      }
    };
    if (level == 0) {
      const std::array<int, 3> n = n_cells(0);
      for_each_index({}, {n[0] - 1, n[1] - 1, n[2] - 1}, add);
      continue;
    }
    for (const GridIndex& parent : domain(level)) {
      const GridIndex low = {2 * parent.i, 2 * parent.j, 2 * parent.k};
      for_each_index(low, {low.i + 1, low.j + 1, low.k + 1}, add);
    }
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
              [](const ThbCell& a, const ThbCell& b) { return a.index < b.index; });
  }
  return result;
}

std::vector<GridIndex> cells_of_box(const std::array<int, 3>& n_cells, const glm::dvec3& low,
                                    const glm::dvec3& high) {
  constexpr double kSnap = 1e-9;
  std::array<std::array<std::int32_t, 2>, 3> lines{};
  for (int axis = 0; axis < 3; ++axis) {
    const int n_along = n_cells[as_size(axis)];
    for (const bool is_high : {false, true}) {
      const double at = is_high ? high[axis] : low[axis];
      const double line = std::round(at * n_along);
      if (!(line >= 0 && line <= n_along && std::abs(at - line / n_along) <= kSnap)) {
        throw ParameterError(fmt::format(
            "the box's side at {} = {} is no line between cells: {}", "uvw"[axis], at,
            n_along == 1 ? "0 or 1" : fmt::format("a multiple of 1/{} from 0 to 1", n_along)));
      }
      lines[as_size(axis)][is_high ? 1 : 0] = static_cast<std::int32_t>(line);
    }
    if (lines[as_size(axis)][0] >= lines[as_size(axis)][1]) {
      throw ParameterError(fmt::format("the box is empty along {}: from {} to {}", "uvw"[axis],
                                       low[axis], high[axis]));
    }
  }
  std::vector<GridIndex> cells;
  for_each_index({lines[0][0], lines[1][0], lines[2][0]},
                 {lines[0][1] - 1, lines[1][1] - 1, lines[2][1] - 1},
                 [&](const GridIndex& cell) { cells.push_back(cell); });
  return cells;
}

std::vector<GridIndex> cells_of_box(const ThbHierarchy& hierarchy, int level, const glm::dvec3& low,
                                    const glm::dvec3& high) {
  require_next_level(hierarchy, level);
  return cells_of_box(hierarchy.n_cells(level - 1), low, high);
}

std::vector<GridIndex> cells_holding(const ThbHierarchy& hierarchy, int level,
                                     std::span<const glm::dvec3> places) {
  require_next_level(hierarchy, level);
  const std::array<int, 3> n = hierarchy.n_cells(level - 1);
  std::vector<GridIndex> cells;
  for (const glm::dvec3& place : places) {
    if (place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x <= 1 && place.y <= 1 &&
        place.z <= 1) {
      const auto along = [&](int axis) {
        const int n_along = n[as_size(axis)];
        return std::min(static_cast<std::int32_t>(place[axis] * n_along), n_along - 1);
      };
      cells.push_back({along(0), along(1), along(2)});
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace espalier
