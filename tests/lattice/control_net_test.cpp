#include "lattice/tensor/control_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "lattice/io/lattice.h"

namespace espalier {
namespace {

TensorAxis axis(int n, Ends ends = Ends::Open) {
  return n == 1 ? TensorAxis() : TensorAxis::make(n, std::min(n - 1, 2), ends);
}

/// How many cells have so many corners.
std::map<std::size_t, std::size_t> sizes(const ControlNet& net) {
  std::map<std::size_t, std::size_t> result;
  for (std::size_t i = 0; i < net.cells.n_rows(); ++i) {
    ++result[net.cells[i].size()];
  }
  return result;
}

/// All pairs of corners of the cells that differ along one axis.
std::set<std::pair<std::int32_t, std::int32_t>> edges_of(const ControlNet& net) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t i = 0; i < net.cells.n_rows(); ++i) {
    const auto corners = net.cells[i];
    for (std::size_t a = 0; a < corners.size(); ++a) {
      for (std::size_t bit = 1; bit < corners.size(); bit *= 2) {
        if ((a & bit) == 0) {
          edges.insert(std::minmax(corners[a], corners[a | bit]));
        }
      }
    }
  }
  return edges;
}

std::set<std::pair<std::int32_t, std::int32_t>> lines_of(const Lattice& lattice) {
  std::set<std::pair<std::int32_t, std::int32_t>> lines;
  for (const auto& [a, b] : lattice.net()) {
    lines.insert(std::minmax(a, b));
  }
  return lines;
}

TEST(ControlNet, of_a_grid_are_its_cells_and_closes_round_rings) {
  using Sizes = std::map<std::size_t, std::size_t>;
  const auto net = [](const std::array<TensorAxis, 3>& axes) {
    const TensorLattice lattice = make_tensor_lattice(TensorKind::BSpline, axes, {});
    const ControlNet result = control_net(lattice);
    EXPECT_EQ(edges_of(result), lines_of(lattice));
    EXPECT_TRUE(result.levels.empty());
    return result;
  };
  EXPECT_EQ(sizes(net({axis(3), axis(4), axis(5)})), (Sizes{{8, 2 * 3 * 4}}));
  EXPECT_EQ(sizes(net({axis(5, Ends::Periodic), axis(3), axis(3)})), (Sizes{{8, 5 * 2 * 2}}));
  EXPECT_EQ(sizes(net({axis(1), axis(4), axis(5)})), (Sizes{{4, 12}}));
  EXPECT_EQ(sizes(net({axis(1), axis(1), axis(5)})), (Sizes{{2, 4}}));
  const ControlNet cells = net({axis(2), axis(2), axis(2)});
  EXPECT_TRUE(std::ranges::equal(cells.cells[0], std::array{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(ControlNet, of_a_hierarchy_has_every_control_point_and_line_of_every_level) {
  const ThbLattice coarse = make_thb_lattice({6, 6, 6}, {3, 3, 3}, {});
  // A bar of cells leaves single lines of control points of level 1.
  const double third = 1.0 / 3;
  const ThbLattice fine =
      with_cells(coarse, 1, cells_of_box(*coarse.hierarchy, 1, glm::dvec3(0), {third, third, 1}));
  const ControlNet net = control_net(fine);
  ASSERT_EQ(net.levels.size(), net.cells.n_rows());
  EXPECT_EQ(edges_of(net), lines_of(fine));
  std::set<std::int32_t> seen;
  for (std::size_t i = 0; i < net.levels.size(); ++i) {
    for (const std::int32_t control : net.cells[i]) {
      seen.insert(control);
      EXPECT_EQ(fine.hierarchy->controls()[static_cast<std::size_t>(control)].level, net.levels[i]);
    }
  }
  EXPECT_EQ(seen.size(), fine.rest.size());
  // One function fits into four cells of its level.
  const ThbLattice inside = make_thb_lattice({8, 8, 8}, {3, 3, 3}, {});
  const ThbLattice alone =
      with_cells(inside, 1, cells_of_box(*inside.hierarchy, 1, glm::dvec3(0.2), glm::dvec3(0.6)));
  EXPECT_EQ(sizes(control_net(alone)), (std::map<std::size_t, std::size_t>{{1, 1}, {8, 343}}));
}

}  // namespace
}  // namespace espalier
