#pragma once

/// Which functions of a hierarchy of ever finer B-splines are in use [THB18].

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/tensor/brick_grid.h"
#include "lattice/tensor/knots.h"

namespace espalier {

/// Levels that a hierarchy may have.
inline constexpr int kMostThbLevels = 16;

/// A B-spline of one level.
struct ThbFunction {
  std::int32_t level = 0;
  GridIndex index;
  bool operator==(const ThbFunction&) const = default;
};

/// A cell of one level.
using ThbCell = ThbFunction;

/// One axis of one level: open-uniform knots 0, 1, …, #cells. Far from the ends all functions are
/// alike: a short axis stands for a long one.
class ThbAxis {
 public:
  ThbAxis(int n_cells, int degree);

  [[nodiscard]] int n_cells() const { return n_cells_; }
  [[nodiscard]] int degree() const { return short_.degree(); }
  [[nodiscard]] int n_functions() const { return n_cells_ + short_.degree(); }
  /// Function j of the next finer level over the functions of this one: (first + k, weight k).
  struct Insertion {
    int shift;
    const SparseRow* row;
  };
  [[nodiscard]] Insertion insertion(int j) const;
  /// From the coefficients cell … cell + degree to its Bézier points.
  [[nodiscard]] const Extraction& extraction(int cell) const;

 private:
  int n_cells_;
  TensorAxis short_;
  SparseRows insertions_;
};

/// Nested domains Ω⁰ ⊇ Ω¹ ⊇ …, each a union of cells of the level before its own, and the functions
/// that are control points: those whose support lies in the domain of their level, but not in the
/// next. Neighbouring leaves may differ by any number of levels. Immutable.
class ThbHierarchy {
 public:
  /// counts: control points of level 0 along each axis; degree: 1 to 5 each; domains: for each
  /// level from 1 on its cells, of the level before, in any order. Throws ParameterError for counts
  /// below degree + 1, degrees out of range, or too many levels or cells, and LatticeError naming a
  /// cell that does not exist or lies outside the domain before. O(#functions).
  ThbHierarchy(const std::array<int, 3>& counts, const std::array<int, 3>& degree,
               std::vector<std::vector<GridIndex>> domains = {});

  [[nodiscard]] int n_levels() const { return static_cast<int>(domains_.size()) + 1; }
  [[nodiscard]] const std::array<int, 3>& counts() const { return counts_; }
  [[nodiscard]] const std::array<int, 3>& degree() const { return degree_; }
  /// Cells along each axis of a level, any from 0 to n_levels().
  [[nodiscard]] std::array<int, 3> n_cells(int level) const;
  [[nodiscard]] const std::array<ThbAxis, 3>& axes(int level) const {
    return axes_[static_cast<std::size_t>(level)];
  }
  /// The cells of level − 1 that make the domain of a level ≥ 1, ascending.
  [[nodiscard]] std::span<const GridIndex> domain(int level) const {
    return domains_[static_cast<std::size_t>(level - 1)];
  }
  [[nodiscard]] const std::vector<std::vector<GridIndex>>& domains() const { return domains_; }

  /// The control points: by level, then ascending.
  [[nodiscard]] const std::vector<ThbFunction>& controls() const { return controls_; }
  /// How many of each level are.
  [[nodiscard]] std::vector<std::size_t> n_controls_by_level() const;

  /// The functions whose coefficients leaves see or may ask for, by level, then ascending; the
  /// number of the control point that each is, or -1.
  [[nodiscard]] const std::vector<ThbFunction>& functions() const { return functions_; }
  [[nodiscard]] const std::vector<std::int32_t>& function_controls() const {
    return function_controls_;
  }
  /// Which of functions() a function of a level is, -1 for none of them.
  [[nodiscard]] const BrickGrid<std::int32_t>& numbers(int level) const {
    return numbers_[static_cast<std::size_t>(level)];
  }
  [[nodiscard]] std::size_t first_function(int level) const {
    return first_functions_[static_cast<std::size_t>(level)];
  }

  /// The cells that are not refined: by level, then ascending. O(#cells).
  [[nodiscard]] std::vector<ThbCell> leaves() const;

  /// Whether a cell of a level lies in the domain of that level.
  [[nodiscard]] bool is_in_domain(int level, const GridIndex& cell) const;

 private:
  using Membership = BrickGrid<char>;
  void check_domains() const;
  void add_level(int level);
  /// All functions of a level whose support meets its domain.
  [[nodiscard]] std::vector<GridIndex> candidates(int level) const;

  std::array<int, 3> counts_;
  std::array<int, 3> degree_;
  std::vector<std::vector<GridIndex>> domains_;
  std::vector<Membership> members_;  // of domains_
  std::vector<std::array<ThbAxis, 3>> axes_;
  std::vector<ThbFunction> controls_;
  std::vector<ThbFunction> functions_;
  std::vector<std::int32_t> function_controls_;
  std::vector<std::size_t> first_functions_;
  std::vector<BrickGrid<std::int32_t>> numbers_;
};

/// Calls visit(index, weight) for every function of the level before that function `index` of
/// `level` is a part of: β_visited = … + weight · β_index.
template <class Visit>
void for_each_parent(const ThbHierarchy& hierarchy, int level, const GridIndex& index,
                     const Visit& visit) {
  const std::array<ThbAxis, 3>& axes = hierarchy.axes(level - 1);
  const ThbAxis::Insertion u = axes[0].insertion(index.i);
  const ThbAxis::Insertion v = axes[1].insertion(index.j);
  const ThbAxis::Insertion w = axes[2].insertion(index.k);
  for (const auto& [k, w_weight] : *w.row) {
    for (const auto& [j, v_weight] : *v.row) {
      for (const auto& [i, u_weight] : *u.row) {
        visit(GridIndex{i + u.shift, j + v.shift, k + w.shift}, u_weight * v_weight * w_weight);
      }
    }
  }
}

/// The cells of a grid of n_cells that a box of [0,1]³ consists of. Throws ParameterError for a box
/// that is empty, leaves [0,1]³, or whose sides are not lines of the grid within 1e-9.
[[nodiscard]] std::vector<GridIndex> cells_of_box(const std::array<int, 3>& n_cells,
                                                  const glm::dvec3& low, const glm::dvec3& high);

/// The cells of level − 1 that a box of [0,1]³ consists of, to add to the domain of `level`. Throws
/// ParameterError for a level that is none or more than one too high, and for a box as above.
[[nodiscard]] std::vector<GridIndex> cells_of_box(const ThbHierarchy& hierarchy, int level,
                                                  const glm::dvec3& low, const glm::dvec3& high);

/// The cells of level − 1 that hold places of [0,1]³, each once, ascending: a region picked on a
/// model, grown outward. Places outside do not count. Throws ParameterError for such a level.
[[nodiscard]] std::vector<GridIndex> cells_holding(const ThbHierarchy& hierarchy, int level,
                                                   std::span<const glm::dvec3> places);

}  // namespace espalier
