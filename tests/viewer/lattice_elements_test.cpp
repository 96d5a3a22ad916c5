#include "viewer/interact/lattice_elements.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "deform/scene/operation_text.h"
#include "lattice/core/error.h"
#include "viewer/interact/show.h"

namespace espalier::viewer {
namespace {

Lattice made(const char* line) {
  const Scene scene = apply(parse_call(line), Scene());
  return scene.lattices.begin()->second;
}

/// Pairs of vertices, the smaller first, in order.
std::vector<std::array<std::int32_t, 2>> sorted_edges(
    std::vector<std::array<std::int32_t, 2>> edges) {
  for (auto& edge : edges) {
    std::sort(edge.begin(), edge.end());
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void expect_net_of(const Lattice& lattice) {
  const LatticeElements elements = elements_of(lattice);
  std::vector<std::array<std::int32_t, 2>> edges;
  for (std::size_t i = 0; i < elements.edges.n_rows(); ++i) {
    edges.push_back({elements.edges[i][0], elements.edges[i][1]});
  }
  EXPECT_EQ(sorted_edges(edges), sorted_edges(lattice.net())) << lattice.type();
}

TEST(LatticeElements, edges_are_the_net_of_lattices_of_every_type) {
  expect_net_of(made("new box output=a cells=2,3,1"));
  expect_net_of(made("new bezier output=a counts=4,3,2"));
  expect_net_of(made("new bspline output=a counts=5,4,1 degree=3,3,0"));
  expect_net_of(made("new nurbs output=a counts=6,5,4 ends=periodic,open,open"));
  expect_net_of(made("new thb output=a counts=5,5,5"));
}

TEST(LatticeElements, a_grid_has_the_faces_and_cells_between_its_control_points) {
  const LatticeElements grid = elements_of(made("new bspline output=a counts=5,4,4"));
  EXPECT_EQ(grid.n_vertices, 80);
  EXPECT_EQ(grid.edges.n_rows(), 4u * 16 + 2 * 5 * 3 * 4);
  EXPECT_EQ(grid.faces.n_rows(), 2u * 4 * 3 * 4 + 5 * 3 * 3);
  EXPECT_EQ(grid.cells.n_rows(), 36u);
  EXPECT_EQ(std::count(grid.is_outer.begin(), grid.is_outer.end(), true), 2 * (12 + 12 + 9));
  // Euler: a ball.
  EXPECT_EQ(80 - 184 + 141 - 36, 1);
  for (std::size_t cell = 0; cell < grid.cells.n_rows(); ++cell) {
    const auto corners = grid.cells[cell];
    for (const std::int32_t face : grid.cell_faces[cell]) {
      for (const std::int32_t vertex : grid.faces[static_cast<std::size_t>(face)]) {
        EXPECT_NE(std::find(corners.begin(), corners.end(), vertex), corners.end());
      }
    }
  }
}

TEST(LatticeElements, a_ring_closes_and_a_plane_has_no_cells) {
  const LatticeElements ring =
      elements_of(made("new bspline output=a counts=6,4,4 ends=periodic,open,open"));
  EXPECT_EQ(ring.cells.n_rows(), 6u * 9);
  const LatticeElements plane = elements_of(made("new bspline output=a counts=4,4,1 degree=3,3,0"));
  EXPECT_EQ(plane.cells.n_rows(), 0u);
  EXPECT_EQ(plane.faces.n_rows(), 9u);
  EXPECT_EQ(std::count(plane.is_outer.begin(), plane.is_outer.end(), false), 0);
}

TEST(LatticeElements, a_hierarchy_joins_only_control_points_of_one_level) {
  Scene scene = apply(parse_call("new thb output=a counts=5,5,5"), Scene());
  scene = apply(parse_call("refine input=a output=a box=0,0,0,0.5,0.5,0.5 level=1"), scene);
  const Lattice lattice = lattice_in(scene, "a");
  expect_net_of(lattice);
  const LatticeElements elements = elements_of(lattice);
  EXPECT_EQ(elements.n_levels, 2);
  EXPECT_GT(std::count(elements.levels.begin(), elements.levels.end(), 1), 0);
  for (std::size_t cell = 0; cell < elements.cells.n_rows(); ++cell) {
    for (const std::int32_t vertex : elements.cells[cell]) {
      EXPECT_EQ(elements.levels[static_cast<std::size_t>(vertex)],
                elements.levels[static_cast<std::size_t>(elements.cells[cell][0])]);
    }
  }
}

TEST(LatticeElements, the_loop_of_a_grids_edge_goes_straight_through_the_grid) {
  const LatticeElements grid = elements_of(made("new bspline output=a counts=5,4,4"));
  const Selection loop = grid.loop(0);  // along u from the first control point
  EXPECT_EQ(grid.vertices(ElementKind::Edge, loop), (Selection{0, 1, 2, 3, 4}));
}

TEST(Show, hides_elements_with_all_that_they_belong_to) {
  const Lattice bar = made("new box output=a cells=3,1,1 max=3,1,1");
  const LatticeElements elements = elements_of(bar);
  const auto counts = [&](const Show& show) {
    const Visible visible = visible_elements(elements, bar.rest_points(), show);
    const auto n = [](const std::vector<bool>& is) {
      return std::count(is.begin(), is.end(), true);
    };
    return std::array{n(visible.vertices), n(visible.edges), n(visible.faces), n(visible.cells)};
  };
  EXPECT_EQ(counts({}), (std::array<std::ptrdiff_t, 4>{16, 28, 16, 3}));
  Show one_cell_less;
  one_cell_less.hidden_cells = {0};
  EXPECT_EQ(counts(one_cell_less), (std::array<std::ptrdiff_t, 4>{12, 20, 11, 2}));
  Show one_vertex_less;
  one_vertex_less.hidden_vertices = {0};
  EXPECT_EQ(counts(one_vertex_less), (std::array<std::ptrdiff_t, 4>{15, 25, 13, 2}));
}

TEST(Show, a_cut_takes_away_the_cells_beyond_it) {
  const Lattice bar = made("new box output=a cells=3,1,1 max=3,1,1");
  const LatticeElements elements = elements_of(bar);
  Show show;
  show.cut = Cut{0, 0.4, false};
  EXPECT_EQ(visible_elements(elements, bar.rest_points(), show).cells,
            (std::vector<bool>{true, false, false}));
  show.cut->keeps_upper = true;
  EXPECT_EQ(visible_elements(elements, bar.rest_points(), show).cells,
            (std::vector<bool>{false, true, true}));
}

TEST(Show, levels_of_a_hierarchy_can_be_hidden) {
  Scene scene = apply(parse_call("new thb output=a counts=5,5,5"), Scene());
  scene = apply(parse_call("refine input=a output=a box=0,0,0,0.5,0.5,0.5 level=1"), scene);
  const Lattice lattice = lattice_in(scene, "a");
  const LatticeElements elements = elements_of(lattice);
  Show show;
  show.hidden_levels = {0};
  const Visible visible = visible_elements(elements, lattice.rest_points(), show);
  for (std::size_t i = 0; i < elements.levels.size(); ++i) {
    EXPECT_EQ(visible.vertices[i], elements.levels[i] == 1);
  }
}

}  // namespace
}  // namespace espalier::viewer
