// Truncation by one rule on coefficients, from the coarsest level to the finest.

#include "lattice/tensor/thb_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/tensor/flatness.h"

namespace espalier {
namespace {

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

/// Adds `weight` times a row of a table.
void add_row(const StencilTable::Row& source, double weight, StencilRow& row) {
  for (std::size_t k = 0; k < source.indices.size(); ++k) {
    row.add(source.indices[k], weight * source.weights[k]);
  }
}

/// The coefficients of a level's functions over the control points; before: those of the level
/// before.
StencilTable coefficients_of_level(const ThbHierarchy& hierarchy, int level,
                                   const StencilTable& before) {
  const std::size_t first = hierarchy.first_function(level);
  const std::size_t n = hierarchy.first_function(level + 1) - first;
  return StencilTable::build(n, hierarchy.controls().size(), [&](std::size_t i, StencilRow& row) {
    if (const std::int32_t control = hierarchy.function_controls()[first + i]; control >= 0) {
      row.add(control, 1.0);
      return;
    }
    BrickGrid<std::int32_t>::Reader numbers(hierarchy.numbers(level - 1));
    const GridIndex& index = hierarchy.functions()[first + i].index;
    for_each_parent(hierarchy, level, index, [&](const GridIndex& parent, double weight) {
      const std::int32_t number = numbers(parent);
      assert(number >= 0);
      add_row(before[static_cast<std::size_t>(number) - hierarchy.first_function(level - 1)],
              weight, row);
    });
  });
}

StencilTable coefficients(const ThbHierarchy& hierarchy) {
  std::vector<StencilTable> levels;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    levels.push_back(
        coefficients_of_level(hierarchy, level, level == 0 ? StencilTable() : levels.back()));
  }
  const auto& functions = hierarchy.functions();
  return StencilTable::build(
      functions.size(), hierarchy.controls().size(), [&](std::size_t i, StencilRow& row) {
        const int level = functions[i].level;
        add_row(levels[as_size(level)][i - hierarchy.first_function(level)], 1.0, row);
      });
}

/// The extractions of all cells, each once.
class ExtractionTable {
 public:
  std::uint16_t number(const Extraction& extraction) {
    const auto known = numbers_.find(&extraction);
    if (known != numbers_.end()) {
      return known->second;
    }
    const auto found = std::find(table.begin(), table.end(), extraction);
    const auto number = static_cast<std::uint16_t>(found - table.begin());
    if (found == table.end()) {
      table.push_back(extraction);
    }
    numbers_.emplace(&extraction, number);
    return number;
  }
  std::vector<Extraction> table;

 private:
  std::unordered_map<const Extraction*, std::uint16_t> numbers_;
};

void add_patches(const ThbHierarchy& hierarchy, VolumeTables& tables) {
  const std::vector<ThbCell> leaves = hierarchy.leaves();
  const auto& degree = hierarchy.degree();
  const auto width = static_cast<std::size_t>((degree[0] + 1) * (degree[1] + 1) * (degree[2] + 1));
  ExtractionTable extractions;
  std::vector<BrickGrid<std::int32_t>::Reader> numbers;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    numbers.emplace_back(hierarchy.numbers(level));
  }
  std::vector<std::int32_t> points;
  points.reserve(width * leaves.size());
  for (const ThbCell& leaf : leaves) {
    const std::array<ThbAxis, 3>& axes = hierarchy.axes(leaf.level);
    const GridIndex& cell = leaf.index;
    Patch patch;
    for (std::size_t a = 0; a < 3; ++a) {
      patch.extractions[a] = extractions.number(axes[a].extraction(cell[a]));
      const int boundary = (cell[a] == 0 ? 1 : 0) | (cell[a] + 1 == axes[a].n_cells() ? 2 : 0);
      patch.boundary_faces = static_cast<std::uint8_t>(patch.boundary_faces | boundary << 2 * a);
    }
    tables.patches.push_back(patch);
    auto& number = numbers[as_size(leaf.level)];
    for (int k = cell.k; k <= cell.k + degree[2]; ++k) {
      for (int j = cell.j; j <= cell.j + degree[1]; ++j) {
        for (int i = cell.i; i <= cell.i + degree[0]; ++i) {
          points.push_back(number({i, j, k}));
          assert(points.back() >= 0);
        }
      }
    }
  }
  tables.blocks = CompressedRows<std::int32_t>::uniform(width, std::move(points));
  tables.extractions = std::move(extractions.table);
}

/// The coefficients of a lattice's volume as functions of any level, when they are asked for.
class Coefficients {
 public:
  struct Value {
    glm::dvec3 rest{0};
    glm::dvec3 pose{0};
  };

  /// finer: has the axes of all levels that are asked for.
  Coefficients(const ThbLattice& lattice, const ThbHierarchy& finer) : finer_(finer) {
    for (int level = 0; level < finer.n_levels(); ++level) {
      known_.emplace_back(-1);
    }
    for (std::size_t i = 0; i < lattice.rest.size(); ++i) {
      const ThbFunction& control = lattice.hierarchy->controls()[i];
      known_[as_size(control.level)].set(control.index, static_cast<std::int32_t>(i));
      values_.push_back({lattice.rest[i], lattice.posed_points()[i]});
    }
  }

  [[nodiscard]] Value of(int level, const GridIndex& index) {
    if (const std::int32_t known = BrickGrid<std::int32_t>::Reader(known_[as_size(level)])(index);
        known >= 0) {
      return values_[static_cast<std::size_t>(known)];
    }
    assert(level > 0);
    Value sum;
    for_each_parent(finer_, level, index, [&](const GridIndex& parent, double weight) {
      const Value value = of(level - 1, parent);
      sum.rest += weight * value.rest;
      sum.pose += weight * value.pose;
    });
    known_[as_size(level)].set(index, static_cast<std::int32_t>(values_.size()));
    values_.push_back(sum);
    return sum;
  }

 private:
  const ThbHierarchy& finer_;
  std::vector<BrickGrid<std::int32_t>> known_;  // places in values_
  std::vector<Value> values_;
};

void require_points(std::span<const glm::dvec3> points, std::size_t n, std::string_view name) {
  if (points.size() != n) {
    throw LatticeError(
        fmt::format("has {} {} points for {} control points", points.size(), name, n));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(points[i][axis]) <= kLargestCoordinate)) {
        throw LatticeError(fmt::format("{} point {} has a coordinate {}, not a number up to 1e18",
                                       name, i, points[i][axis]));
      }
    }
  }
}

}  // namespace

ThbLattice make_thb_lattice(const std::array<int, 3>& counts, const std::array<int, 3>& degree,
                            const OrientedBox& box) {
  ThbLattice lattice;
  lattice.hierarchy = std::make_shared<const ThbHierarchy>(counts, degree);
  std::array<TensorAxis, 3> axes;
  for (std::size_t a = 0; a < 3; ++a) {
    axes[a] = TensorAxis::make(counts[a], degree[a], Ends::Open);
  }
  lattice.rest = make_tensor_lattice(TensorKind::BSpline, axes, box).rest;
  return lattice;
}

void require_valid(const ThbLattice& lattice) {
  if (!lattice.hierarchy) {
    throw LatticeError("the lattice has no levels");
  }
  const std::size_t n = lattice.hierarchy->controls().size();
  require_points(lattice.rest, n, "rest");
  if (!lattice.pose.empty()) {
    require_points(lattice.pose, n, "posed");
  }
}

ThbLattice refined_to(const ThbLattice& lattice, std::shared_ptr<const ThbHierarchy> hierarchy) {
  require_valid(lattice);
  if (hierarchy->counts() != lattice.hierarchy->counts() ||
      hierarchy->degree() != lattice.hierarchy->degree()) {
    throw ParameterError("a refined lattice must have the counts and degrees of the one before");
  }
  Coefficients coefficients(lattice, *hierarchy);
  ThbLattice result;
  result.extra_json = lattice.extra_json;
  for (const ThbFunction& control : hierarchy->controls()) {
    const Coefficients::Value value = coefficients.of(control.level, control.index);
    result.rest.push_back(value.rest);
    if (!lattice.pose.empty()) {
      result.pose.push_back(value.pose);
    }
  }
  result.hierarchy = std::move(hierarchy);
  return result;
}

ThbLattice with_cells(const ThbLattice& lattice, int level, std::span<const GridIndex> cells) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  if (level < 1 || level > hierarchy.n_levels()) {
    throw ParameterError(
        fmt::format("the level is {}, must be 1 to {}", level, hierarchy.n_levels()));
  }
  std::vector<std::vector<GridIndex>> domains = hierarchy.domains();
  domains.resize(std::max(domains.size(), as_size(level)));
  std::vector<GridIndex>& domain = domains[as_size(level - 1)];
  domain.insert(domain.end(), cells.begin(), cells.end());
  return refined_to(lattice, std::make_shared<const ThbHierarchy>(
                                 hierarchy.counts(), hierarchy.degree(), std::move(domains)));
}

Volume freeze(const ThbLattice& lattice) {
  require_valid(lattice);
  require_thickness(lattice.rest);
  VolumeTables tables;
  add_patches(*lattice.hierarchy, tables);
  tables.stencils = coefficients(*lattice.hierarchy);
  return {std::move(tables), lattice.rest};
}

PatchPlace place_of(const ThbHierarchy& hierarchy, std::span<const ThbCell> leaves,
                    const glm::dvec3& uvw) {
  ThbCell cell;
  PatchPlace place;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    const std::array<int, 3> n = hierarchy.n_cells(level);
    std::array<std::int32_t, 3> at{};
    glm::dvec3 within;
    for (int axis = 0; axis < 3; ++axis) {
      const double u = std::clamp(uvw[axis], 0.0, 1.0) * n[as_size(axis)];
      at[as_size(axis)] = std::min(static_cast<std::int32_t>(u), n[as_size(axis)] - 1);
      within[axis] = u - at[as_size(axis)];
    }
    const GridIndex index = {at[0], at[1], at[2]};
    if (!hierarchy.is_in_domain(level, index)) {
      break;
    }
    cell = {level, index};
    place.uvw = within;
    place.scale = glm::dvec3(n[0], n[1], n[2]);
  }
  const auto found =
      std::lower_bound(leaves.begin(), leaves.end(), cell, [](const ThbCell& a, const ThbCell& b) {
        return a.level != b.level ? a.level < b.level : a.index < b.index;
      });
  assert(found != leaves.end() && *found == cell);
  place.patch = static_cast<std::size_t>(found - leaves.begin());
  return place;
}

std::vector<glm::dvec3> places_in_whole(const ThbHierarchy& hierarchy,
                                        std::span<const ThbCell> leaves,
                                        std::span<const std::int32_t> patches,
                                        std::span<const glm::dvec3> uvw) {
  std::vector<glm::dvec3> places;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const ThbCell& leaf = leaves[static_cast<std::size_t>(patches[i])];
    const std::array<int, 3> n = hierarchy.n_cells(leaf.level);
    places.push_back((glm::dvec3(leaf.index.i, leaf.index.j, leaf.index.k) + uvw[i]) /
                     glm::dvec3(n[0], n[1], n[2]));
  }
  return places;
}

std::vector<LevelInfluence> level_influences(const ThbHierarchy& hierarchy,
                                             const StencilTable& weights) {
  if (weights.n_controls() != hierarchy.controls().size()) {
    throw ParameterError(fmt::format("weights of {} control points for a lattice with {}",
                                     weights.n_controls(), hierarchy.controls().size()));
  }
  std::vector<std::size_t> n_points(weights.n_controls(), 0);
  for (std::size_t row = 0; row < weights.n_rows(); ++row) {
    for (const std::int32_t control : weights[row].indices) {
      ++n_points[static_cast<std::size_t>(control)];
    }
  }
  std::vector<LevelInfluence> levels(as_size(hierarchy.n_levels()));
  for (std::size_t i = 0; i < n_points.size(); ++i) {
    LevelInfluence& level = levels[as_size(hierarchy.controls()[i].level)];
    ++level.n_controls;
    level.mean_points += static_cast<double>(n_points[i]);
    level.n_without += n_points[i] == 0 ? 1 : 0;
  }
  for (LevelInfluence& level : levels) {
    level.mean_points /= static_cast<double>(std::max<std::size_t>(level.n_controls, 1));
  }
  return levels;
}

}  // namespace espalier
