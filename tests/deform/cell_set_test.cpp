/// Cells of a grid as a lattice, and shaped without folds.

#include "deform/fit/cell_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "deform/fit/enclose.h"
#include "deform/injectivity/injectivity.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {
namespace {

/// A grid of 4 × 4 × 4 cells, eight in each octant that `octants` names (bit i + 2j + 4k), joined
/// through all faces but those that `is_closed` tells.
template <class IsClosed>
CellSet cells_in(unsigned octants, const IsClosed& is_closed) {
  ElementGrid grid;
  grid.frame.cells = {4, 4, 4};
  grid.is_touched.assign(grid.frame.n_elements(), 0);
  grid.is_inside = grid.is_touched;
  for (std::size_t i = 0; i < grid.frame.n_elements(); ++i) {
    const ElementPlace place = grid.frame.place(i);
    const int n_odd = place[0] % 2 + place[1] % 2 + place[2] % 2;
    const unsigned octant =
        (place[0] > 4 ? 1U : 0U) | (place[1] > 4 ? 2U : 0U) | (place[2] > 4 ? 4U : 0U);
    const bool is_cell = n_odd == 3 && (octants >> octant & 1U) != 0;
    grid.is_touched[i] = is_cell || (n_odd == 2 && !is_closed(place)) ? 1 : 0;
  }
  return CellSet(grid);
}

constexpr auto kOpen = [](const ElementPlace&) { return false; };

Verdict verdict_of(const CellSet& set) {
  const Enclosure enclosure = enclose(set.make_cells(0.03), set.frame(), {});
  EXPECT_TRUE(enclosure.lacking.empty());
  const InjectivityCheck check(
      std::make_shared<const Volume>(freeze_adaptive(enclosure.lattice, {.tolerance = 1e-3})));
  return check.local(enclosure.lattice.rest).verdict;
}

TEST(CellSet, never_folds_whatever_cells_meet_at_a_vertex) {
  // All arrangements that hold together by faces, up to symmetry.
  for (const unsigned octants : {0x01u, 0x03u, 0x07u, 0x0fu, 0x17u, 0x1bu, 0x1fu, 0x3du, 0x3fu,
                                 0x6fu, 0x7eu, 0x7fu, 0xffu}) {
    EXPECT_EQ(verdict_of(cells_in(octants, kOpen)), Verdict::Certified) << octants;
  }
}

TEST(CellSet, never_folds_at_slits) {
  const auto straight = [](const ElementPlace& p) { return p[0] == 4 && p[1] > 4; };
  const auto corner = [&](const ElementPlace& p) { return straight(p) && p[2] > 4; };
  const auto edge = [&](const ElementPlace& p) { return p[0] == 4 && (p[1] > 4 || p[2] > 4); };
  EXPECT_EQ(verdict_of(cells_in(0xff, straight)), Verdict::Certified);
  EXPECT_EQ(verdict_of(cells_in(0xff, corner)), Verdict::Certified);
  EXPECT_EQ(verdict_of(cells_in(0xff, edge)), Verdict::Certified);
  EXPECT_EQ(verdict_of(cells_in(0x7f, corner)), Verdict::Certified);
}

TEST(CellSet, of_a_full_grid_is_the_grid) {
  const GridCells cells = cells_in(0xff, kOpen).make_cells(0.03);
  const CellComplex complex(cells.mesh.cells);
  EXPECT_EQ(complex.n_cells(), 64u);
  EXPECT_EQ(complex.n_vertices(), 125u);
  for (const glm::dvec3& point : cells.mesh.points) {
    EXPECT_EQ(point, glm::round(point));
  }
}

TEST(CellSet, gives_neighbours_that_are_not_joined_vertices_of_their_own_a_gap_apart) {
  const auto wall = [](const ElementPlace& p) { return p[0] == 4; };
  const GridCells cells = cells_in(0xff, wall).make_cells(0.125);
  const CellComplex complex(cells.mesh.cells);
  EXPECT_EQ(complex.n_vertices(), 150u);
  for (std::size_t i = 0; i < cells.mesh.points.size(); ++i) {
    const double x = cells.mesh.points[i].x;
    EXPECT_EQ(cells.is_fixed[i] != 0, std::abs(x - 2) < 0.5);
    EXPECT_TRUE(x == std::round(x) || std::abs(x - 2) == 0.125) << x;
  }
}

TEST(CellSet, does_not_share_vertices_between_cells_that_touch_only_there) {
  // Two cells at an edge, two at a vertex.
  for (const unsigned octants : {0x09u, 0x81u}) {
    const GridCells cells = cells_in(octants, kOpen).make_cells(0.03);
    EXPECT_EQ(CellComplex(cells.mesh.cells).n_vertices(), 2 * 27u);
  }
}

TEST(CellSet, filled_round_a_node_has_all_cells_there_joined) {
  const auto wall = [](const ElementPlace& p) { return p[0] == 4; };
  CellSet set = cells_in(0x7f, wall);
  EXPECT_TRUE(set.fill_around({4, 4, 4}));
  EXPECT_FALSE(set.fill_around({4, 4, 4}));
  for (const int x : {3, 4, 5}) {
    EXPECT_TRUE(set.has({x, 5, 5}));
  }
  EXPECT_FALSE(set.has({4, 7, 7}));
}

}  // namespace
}  // namespace espalier
