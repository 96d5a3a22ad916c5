#include "lattice/tensor/thb_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <random>
#include <set>

#include "lattice/core/error.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

std::vector<glm::dvec3> places(unsigned seed, int n = 60) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> result = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0.5}, {0.5, 0.5, 0.5}};
  for (int i = 0; i < n; ++i) {
    result.emplace_back(unit(random), unit(random), unit(random));
  }
  return result;
}

/// Values of a frozen lattice by place in the whole.
class Map {
 public:
  explicit Map(const ThbLattice& lattice)
      : hierarchy_(lattice.hierarchy), leaves_(hierarchy_->leaves()), volume_(freeze(lattice)) {
    posed_ = volume_.points(lattice.posed_points());
  }
  [[nodiscard]] glm::dvec3 rest(const glm::dvec3& uvw) const {
    return at(uvw, volume_.rest_points());
  }
  [[nodiscard]] glm::dvec3 posed(const glm::dvec3& uvw) const { return at(uvw, posed_); }
  [[nodiscard]] const Volume& volume() const { return volume_; }
  [[nodiscard]] PatchPlace place(const glm::dvec3& uvw) const {
    return place_of(*hierarchy_, leaves_, uvw);
  }
  /// The value of every control point's function.
  [[nodiscard]] std::vector<double> functions(const glm::dvec3& uvw) const {
    const PatchPlace found = place(uvw);
    std::vector<double> values(volume_.n_controls(), 0.0);
    BezierPatch patch;
    std::set<std::int32_t> seen;
    for (const std::int32_t point : volume_.block(found.patch)) {
      const auto row = volume_.stencils()[static_cast<std::size_t>(point)];
      seen.insert(row.indices.begin(), row.indices.end());
    }
    std::vector<glm::dvec3> one(volume_.n_controls(), glm::dvec3(0));
    for (const std::int32_t control : seen) {
      one[static_cast<std::size_t>(control)] = glm::dvec3(1);
      volume_.bezier(found.patch, volume_.stencils().apply(one), patch);
      values[static_cast<std::size_t>(control)] = patch.value(found.uvw).x;
      one[static_cast<std::size_t>(control)] = glm::dvec3(0);
    }
    return values;
  }

 private:
  [[nodiscard]] glm::dvec3 at(const glm::dvec3& uvw, std::span<const glm::dvec3> points) const {
    const PatchPlace found = place(uvw);
    return volume_.bezier(found.patch, points).value(found.uvw);
  }

  std::shared_ptr<const ThbHierarchy> hierarchy_;
  std::vector<ThbCell> leaves_;
  Volume volume_;
  std::vector<glm::dvec3> posed_;
};

/// With random boxes of cells added to every level, within the domain before.
ThbLattice randomly_refined(ThbLattice lattice, int n_levels, unsigned seed) {
  std::mt19937 random(seed);
  for (int level = 1; level <= n_levels; ++level) {
    const ThbHierarchy& hierarchy = *lattice.hierarchy;
    const std::array<int, 3> n = hierarchy.n_cells(level - 1);
    GridIndex centre = {static_cast<int>(random() % static_cast<unsigned>(n[0])),
                        static_cast<int>(random() % static_cast<unsigned>(n[1])),
                        static_cast<int>(random() % static_cast<unsigned>(n[2]))};
    if (level > 1) {
      const auto domain = hierarchy.domain(level - 1);
      const GridIndex parent = domain[random() % domain.size()];
      centre = {2 * parent.i, 2 * parent.j, 2 * parent.k};
    }
    std::vector<GridIndex> cells;
    const int reach = 1 + static_cast<int>(random() % 3);
    for (int k = centre.k - reach; k <= centre.k + reach; ++k) {
      for (int j = centre.j - reach; j <= centre.j + reach; ++j) {
        for (int i = centre.i - reach; i <= centre.i + reach; ++i) {
          const GridIndex cell = {i, j, k};
          if (i >= 0 && j >= 0 && k >= 0 && i < n[0] && j < n[1] && k < n[2] &&
              hierarchy.is_in_domain(level - 1, cell)) {
            cells.push_back(cell);
          }
        }
      }
    }
    lattice = with_cells(lattice, level, cells);
    if (!lattice.pose.empty()) {
      lattice.pose = test::jittered(lattice.pose, 0.05, seed + static_cast<unsigned>(level));
    }
  }
  return lattice;
}

ThbLattice posed_box(const std::array<int, 3>& counts, const std::array<int, 3>& degree,
                     unsigned seed) {
  ThbLattice lattice = make_thb_lattice(counts, degree, {});
  lattice.pose = test::jittered(lattice.rest, 0.1, seed);
  return lattice;
}

TEST(ThbLattice, of_one_level_is_the_b_spline) {
  const ThbLattice lattice = posed_box({6, 5, 7}, {3, 2, 4}, 1);
  TensorLattice spline;
  spline.axes = {TensorAxis::make(6, 3, Ends::Open), TensorAxis::make(5, 2, Ends::Open),
                 TensorAxis::make(7, 4, Ends::Open)};
  spline.rest = lattice.pose;
  const Volume volume = freeze(spline);
  const Map map(lattice);
  ASSERT_EQ(map.volume().n_patches(), volume.n_patches());
  for (const glm::dvec3& uvw : places(2)) {
    const PatchPlace place = place_of(spline, uvw);
    EXPECT_LT(glm::distance(map.posed(uvw),
                            volume.bezier(place.patch, volume.rest_points()).value(place.uvw)),
              1e-15);
  }
}

TEST(ThbLattice, refining_a_deformed_lattice_changes_nothing) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const int degree = 1 + static_cast<int>(seed % 5);
    const ThbLattice before = randomly_refined(posed_box({7, 8, 7}, {degree, 3, 2}, seed), 3, seed);
    const Map map(before);
    for (int level = 1; level <= 4; ++level) {
      std::vector<GridIndex> cells;
      for (const ThbCell& leaf : before.hierarchy->leaves()) {
        if (leaf.level == level - 1 && (leaf.index.i + leaf.index.j) % 3 != 0) {
          cells.push_back(leaf.index);
        }
      }
      const ThbLattice after = with_cells(before, level, cells);
      EXPECT_GE(after.rest.size(), before.rest.size());
      const Map refined_map(after);
      for (const glm::dvec3& uvw : places(seed)) {
        EXPECT_LT(glm::distance(refined_map.posed(uvw), map.posed(uvw)), 1e-13);
        EXPECT_LT(glm::distance(refined_map.rest(uvw), uvw), 1e-13);
      }
    }
  }
}

TEST(ThbLattice, functions_sum_to_one_are_not_negative_and_local) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const int degree = 1 + static_cast<int>(seed);
    const ThbLattice lattice =
        randomly_refined(make_thb_lattice({6, 6, 6}, {degree, degree, degree}, {}), 3, seed + 10);
    const Map map(lattice);
    for (const glm::dvec3& uvw : places(seed, 12)) {
      double sum = 0;
      const std::vector<double> values = map.functions(uvw);
      for (std::size_t i = 0; i < values.size(); ++i) {
        sum += values[i];
        EXPECT_GE(values[i], -1e-15);
        const ThbFunction& control = lattice.hierarchy->controls()[i];
        const auto n = lattice.hierarchy->n_cells(control.level);
        for (std::size_t a = 0; a < 3 && values[i] > 1e-14; ++a) {
          const double cell = uvw[static_cast<int>(a)] * n[a];
          EXPECT_GE(cell, control.index[a] - degree);
          EXPECT_LE(cell, control.index[a] + 1);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
  }
}

/// All functions of all levels that are control points, not truncated, added up.
double untruncated_sum(const ThbHierarchy& hierarchy, const glm::dvec3& uvw) {
  double sum = 0;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    std::array<std::vector<double>, 3> values;
    for (std::size_t a = 0; a < 3; ++a) {
      const TensorAxis axis = TensorAxis::make(hierarchy.axes(level)[a].n_functions(),
                                               hierarchy.degree()[a], Ends::Open);
      values[a].assign(static_cast<std::size_t>(axis.n_controls()), 0.0);
      for (const auto& [i, weight] : axis.values(uvw[static_cast<int>(a)] * axis.end())) {
        values[a][static_cast<std::size_t>(i)] = weight;
      }
    }
    for (const ThbFunction& control : hierarchy.controls()) {
      if (control.level == level) {
        sum += values[0][static_cast<std::size_t>(control.index.i)] *
               values[1][static_cast<std::size_t>(control.index.j)] *
               values[2][static_cast<std::size_t>(control.index.k)];
      }
    }
  }
  return sum;
}

TEST(ThbLattice, without_truncation_its_functions_would_not_sum_to_one) {
  const ThbLattice coarse = make_thb_lattice({6, 6, 6}, {2, 2, 2}, {});
  const ThbLattice fine =
      with_cells(coarse, 1, cells_of_box(*coarse.hierarchy, 1, {0, 0, 0}, {0.75, 0.75, 0.75}));
  EXPECT_NEAR(untruncated_sum(*coarse.hierarchy, {0.6, 0.6, 0.6}), 1, 1e-15);
  EXPECT_GT(untruncated_sum(*fine.hierarchy, {0.6, 0.6, 0.6}), 1.1);
}

TEST(ThbLattice, functions_are_linearly_independent) {
  const ThbLattice lattice = randomly_refined(make_thb_lattice({3, 4, 3}, {2, 2, 1}, {}), 2, 3);
  const Map map(lattice);
  const std::size_t n = lattice.rest.size();
  std::vector<std::vector<double>> rows;
  for (const ThbCell& leaf : lattice.hierarchy->leaves()) {
    const auto cells = lattice.hierarchy->n_cells(leaf.level);
    for (const glm::dvec3& within : test::grid_points({2, 2, 1})) {
      const glm::dvec3 at = glm::dvec3(leaf.index.i, leaf.index.j, leaf.index.k) +
                            (within + 0.5) / glm::dvec3(3, 3, 2);
      rows.push_back(map.functions(at / glm::dvec3(cells[0], cells[1], cells[2])));
    }
  }
  ASSERT_GE(rows.size(), n);
  for (std::size_t column = 0; column < n; ++column) {
    const auto pivot = std::max_element(
        rows.begin() + static_cast<std::ptrdiff_t>(column), rows.end(),
        [&](const auto& a, const auto& b) { return std::abs(a[column]) < std::abs(b[column]); });
    ASSERT_GT(std::abs((*pivot)[column]), 1e-9);
    std::swap(*pivot, rows[column]);
    for (std::size_t row = column + 1; row < rows.size(); ++row) {
      if (rows[row][column] != 0) {
        const double factor = rows[row][column] / rows[column][column];
        for (std::size_t k = column; k < n; ++k) {
          rows[row][k] -= factor * rows[column][k];
        }
      }
    }
  }
}

TEST(ThbLattice, refined_everywhere_is_the_fine_b_spline) {
  const ThbLattice coarse = posed_box({5, 4, 6}, {3, 2, 1}, 4);
  ThbLattice fine =
      with_cells(coarse, 1, cells_of_box(*coarse.hierarchy, 1, glm::dvec3(0), glm::dvec3(1)));
  TensorLattice spline;
  spline.axes = {TensorAxis::make(5, 3, Ends::Open), TensorAxis::make(4, 2, Ends::Open),
                 TensorAxis::make(6, 1, Ends::Open)};
  spline.rest = coarse.pose;
  spline = refined(spline);
  ASSERT_EQ(fine.rest.size(), spline.rest.size());
  EXPECT_EQ(fine.hierarchy->n_controls_by_level(),
            (std::vector<std::size_t>{0, spline.rest.size()}));
  for (std::size_t i = 0; i < fine.pose.size(); ++i) {
    EXPECT_LT(glm::distance(fine.pose[i], spline.rest[i]), 1e-15);
  }
  fine.pose = test::jittered(fine.pose, 0.1, 5);
  spline.rest = fine.pose;
  const Volume volume = freeze(spline);
  const Map map(fine);
  for (const glm::dvec3& uvw : places(6)) {
    const PatchPlace place = place_of(spline, uvw);
    EXPECT_LT(glm::distance(map.posed(uvw),
                            volume.bezier(place.patch, volume.rest_points()).value(place.uvw)),
              1e-14);
  }
}

TEST(ThbLattice, a_fine_control_point_moves_only_its_own_surroundings) {
  const ThbLattice coarse = make_thb_lattice({7, 7, 7}, {3, 3, 3}, {});
  ThbLattice fine =
      with_cells(coarse, 1, cells_of_box(*coarse.hierarchy, 1, glm::dvec3(0), glm::dvec3(1)));
  fine = with_cells(fine, 2, cells_of_box(*fine.hierarchy, 2, glm::dvec3(0.25), glm::dvec3(0.75)));
  fine.pose = fine.rest;
  const auto& controls = fine.hierarchy->controls();
  const auto found = std::find(controls.begin(), controls.end(), ThbFunction{2, {8, 8, 8}});
  ASSERT_NE(found, controls.end());
  fine.pose[static_cast<std::size_t>(found - controls.begin())] += glm::dvec3(0.1);
  const Map map(fine);
  for (const glm::dvec3& uvw : places(7, 400)) {
    const glm::dvec3 cell = uvw * 16.0;
    const bool is_near = glm::all(glm::greaterThan(cell, glm::dvec3(5))) &&
                         glm::all(glm::lessThan(cell, glm::dvec3(9)));
    EXPECT_EQ(map.posed(uvw) != map.rest(uvw), is_near);
  }
}

TEST(ThbLattice, has_eight_levels_and_more_and_may_skip_some) {
  ThbLattice lattice = posed_box({3, 3, 3}, {2, 2, 2}, 8);  // level 0: one Bézier cell
  const Map first(lattice);
  for (int level = 1; level <= 10; ++level) {
    const double side = std::ldexp(1.0, 1 - level);
    lattice = with_cells(lattice, level,
                         cells_of_box(*lattice.hierarchy, level, glm::dvec3(0), glm::dvec3(side)));
  }
  EXPECT_EQ(lattice.hierarchy->n_levels(), 11);
  EXPECT_EQ(lattice.hierarchy->leaves().size(), 7u * 10 + 1);
  // A domain as large as the support of one function only, or smaller: none of its level.
  const auto n = lattice.hierarchy->n_controls_by_level();
  EXPECT_EQ(n.front(), 0u);
  const Map map(lattice);
  for (const glm::dvec3& uvw : places(9)) {
    EXPECT_LT(glm::distance(map.posed(uvw), first.posed(uvw)), 1e-14);
  }
  // The domain of level 1 is a single cell inside: no function fits in.
  const ThbLattice inner = make_thb_lattice({7, 7, 7}, {3, 3, 3}, {});
  const ThbLattice skipped =
      with_cells(inner, 1, cells_of_box(*inner.hierarchy, 1, glm::dvec3(0.25), glm::dvec3(0.5)));
  EXPECT_EQ(skipped.hierarchy->n_controls_by_level(), (std::vector<std::size_t>{343, 0}));
}

/// [THB18] figure 8: the cow in 3 × 3 × 3 control points, ears shaped by two of level two.
TEST(ThbLattice, over_a_tri_quadratic_bezier_volume_is_exact) {
  const ThbLattice cow = posed_box({3, 3, 3}, {2, 2, 2}, 11);
  const Map volume(cow);
  for (const glm::dvec3& uvw : places(12)) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 27; ++i) {
      const std::array<std::size_t, 3> index = {i % 3, i / 3 % 3, i / 9};
      double weight = 1;
      for (int a = 0; a < 3; ++a) {
        const double u = uvw[a];
        weight *= std::array{(1 - u) * (1 - u), 2 * u * (1 - u),
                             u * u}[index[static_cast<std::size_t>(a)]];
      }
      sum += weight * cow.pose[i];
    }
    EXPECT_LT(glm::distance(volume.posed(uvw), sum), 1e-15);
  }
  // Level two near the top of the head: a quarter of the length, half the width and height.
  ThbLattice head =
      with_cells(cow, 1, cells_of_box(*cow.hierarchy, 1, glm::dvec3(0), glm::dvec3(1)));
  head = with_cells(head, 2, cells_of_box(*head.hierarchy, 2, {0, 0.5, 0}, {0.5, 1, 1}));
  EXPECT_EQ(head.hierarchy->n_controls_by_level(),
            (std::vector<std::size_t>{0, 64 - 4, 2 * 2 * 6}));
}

TEST(ThbLattice, boxes_snap_to_lines_and_refuse_what_is_none) {
  const ThbHierarchy hierarchy({7, 7, 7}, {3, 3, 3});
  const auto cells = cells_of_box(hierarchy, 1, {0.25 + 5e-10, 0, 0.5}, {0.5, 0.25 - 5e-10, 1});
  EXPECT_EQ(cells, (std::vector<GridIndex>{{1, 0, 2}, {1, 0, 3}}));
  EXPECT_THROW((void)cells_of_box(hierarchy, 1, {0.26, 0, 0}, {1, 1, 1}), ParameterError);
  EXPECT_THROW((void)cells_of_box(hierarchy, 1, {0.5, 0, 0}, {0.5, 1, 1}), ParameterError);
  EXPECT_THROW((void)cells_of_box(hierarchy, 1, {0, 0, 0}, {1.25, 1, 1}), ParameterError);
  EXPECT_THROW((void)cells_of_box(hierarchy, 2, {0, 0, 0}, {1, 1, 1}), ParameterError);
  EXPECT_THROW((void)cells_of_box(hierarchy, 0, {0, 0, 0}, {1, 1, 1}), ParameterError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)cells_of_box(hierarchy, 1, {nan, 0, 0}, {1, 1, 1}), ParameterError);
}

TEST(ThbLattice, regions_grow_outward_to_whole_cells) {
  const ThbHierarchy hierarchy({7, 7, 7}, {3, 3, 3});
  const std::vector<glm::dvec3> picked = {{0.3, 0.1, 0.6}, {0.31, 0.2, 0.7}, {1, 1, 1}, {2, 0, 0}};
  EXPECT_EQ(cells_holding(hierarchy, 1, picked), (std::vector<GridIndex>{{1, 0, 2}, {3, 3, 3}}));
}

TEST(ThbLattice, domains_must_nest) {
  EXPECT_THROW(ThbHierarchy({5, 5, 5}, {2, 2, 2}, {{{0, 0, 0}}, {{2, 0, 0}}}), LatticeError);
  EXPECT_THROW(ThbHierarchy({5, 5, 5}, {2, 2, 2}, {{{3, 0, 0}}}), LatticeError);
  EXPECT_THROW(ThbHierarchy({5, 5, 5}, {2, 2, 2}, {{{-1, 0, 0}}}), LatticeError);
  EXPECT_THROW(ThbHierarchy({5, 5, 5}, {2, 2, 6}), ParameterError);
  EXPECT_THROW(ThbHierarchy({5, 2, 5}, {2, 2, 2}), ParameterError);
  EXPECT_EQ(ThbHierarchy({5, 5, 5}, {2, 2, 2}, {{{1, 1, 1}}, {{2, 3, 3}}}).n_levels(), 3);
}

TEST(ThbLattice, refuses_points_that_do_not_fit) {
  ThbLattice lattice = make_thb_lattice({4, 4, 4}, {3, 3, 3}, {});
  lattice.rest.pop_back();
  EXPECT_THROW((void)freeze(lattice), LatticeError);
  lattice = make_thb_lattice({4, 4, 4}, {3, 3, 3}, {});
  lattice.rest[0].x = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)freeze(lattice), LatticeError);
  EXPECT_THROW((void)freeze(ThbLattice()), LatticeError);
}

TEST(ThbLattice, places_in_patches_are_places_in_the_whole) {
  const ThbLattice lattice = randomly_refined(make_thb_lattice({6, 5, 6}, {3, 2, 3}, {}), 3, 11);
  const Map map(lattice);
  const auto leaves = lattice.hierarchy->leaves();
  for (const glm::dvec3& uvw : places(12)) {
    const PatchPlace place = map.place(uvw);
    const std::vector<std::int32_t> patch = {static_cast<std::int32_t>(place.patch)};
    const std::vector<glm::dvec3> within = {place.uvw};
    EXPECT_LT(glm::distance(places_in_whole(*lattice.hierarchy, leaves, patch, within)[0], uvw),
              1e-15);
  }
}

TEST(ThbLattice, influence_counts_the_points_that_control_points_move) {
  const ThbLattice coarse = make_thb_lattice({4, 4, 4}, {3, 3, 3}, {});
  // Two points: one sees the first 3 control points, the other the first.
  const StencilTable weights = StencilTable::build(2, 64, [](std::size_t i, StencilRow& row) {
    for (std::int32_t control = 0; control < (i == 0 ? 3 : 1); ++control) {
      row.add(control, 0.5);
    }
  });
  const auto levels = level_influences(*coarse.hierarchy, weights);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].n_controls, 64u);
  EXPECT_EQ(levels[0].n_without, 61u);
  EXPECT_DOUBLE_EQ(levels[0].mean_points, 4.0 / 64);
}

}  // namespace
}  // namespace espalier
