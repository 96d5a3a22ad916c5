/// sweep(): O-grids along paths.

#include "deform/fit/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "deform/embed/embed.h"
#include "deform/model/model_file.h"
#include "lattice/build/inventory.h"
#include "lattice/core/error.h"
#include "lattice/io/lattice_file.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/topology/validate.h"
#include "tests/deform/surfaces.h"

namespace espalier {
namespace {

Model path_model(const std::string& text) {
  return parse_model(ModelFormat::Obj, "path.obj", text);
}

CellMesh swept(const std::string& text, const SweepOptions& options, const Model* model = nullptr) {
  const Model path = path_model(text);
  return sweep(path.points(), polylines_of(path),
               model == nullptr ? std::span<const glm::dvec3>() : model->points(), options);
}

std::string refusal(const std::string& text, const SweepOptions& options,
                    const Model* model = nullptr) {
  try {
    (void)swept(text, options, model);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

SubdivisionLattice lattice_of(const CellMesh& mesh) {
  EXPECT_TRUE(validate(mesh.cells, mesh.points).empty());
  RawLattice raw;
  raw.polyhedra = mesh.cells;
  raw.rest = mesh.points;
  return build_lattice(std::move(raw), "swept");
}

TEST(Sweep, along_a_straight_line_is_the_o_grid_of_the_inventory) {
  const CellMesh bar = swept("v 1 2 3\nv 1 2 9\nl 1 2\n", {.radius = 0.5, .layers = 4});
  const CellMesh grid = make_o_grid({.from = {1, 2, 3}, .to = {1, 2, 9}, .radius = 0.5});
  ASSERT_EQ(bar.points.size(), grid.points.size());
  for (std::size_t i = 0; i < bar.points.size(); ++i) {
    EXPECT_LT(glm::distance(bar.points[i], grid.points[i]), 1e-14);
  }
}

TEST(Sweep, puts_the_section_of_a_corner_into_the_halving_plane) {
  const CellMesh bar = swept("v 0 0 0\nv 4 0 0\nv 4 4 0\nl 1 2 3\n", {.radius = 0.5, .layers = 2});
  (void)lattice_of(bar);
  const std::size_t n = bar.points.size() / 5;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 1, 0));
  double farthest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 corner = bar.points[2 * n + i] - glm::dvec3(4, 0, 0);
    EXPECT_NEAR(glm::dot(corner, normal), 0, 1e-14);
    // The same offsets across as at the begin, before and after the corner.
    const glm::dvec3 first = bar.points[i];
    EXPECT_NEAR(first.y, corner.y, 1e-14);
    EXPECT_NEAR(first.z, corner.z, 1e-14);
    farthest = std::max(farthest, glm::length(corner));
  }
  EXPECT_GT(farthest, 0.5 * std::sqrt(2.0));
}

TEST(Sweep, does_not_turn_about_the_path) {
  // Once round three edges of a cube and back into the first direction.
  const CellMesh bar =
      swept("v 0 0 0\nv 5 0 0\nv 5 5 0\nv 5 5 5\nl 1 2 3 4\n", {.radius = 0.25, .layers = 1});
  const std::size_t n = bar.points.size() / 4;
  const auto last = [&](std::size_t i) { return bar.points[3 * n + i] - glm::dvec3(5, 5, 5); };
  for (std::size_t i = 0; i < n; ++i) {
    // x becomes y, y becomes −x at the first corner; y becomes z, z becomes −y at the second.
    const glm::dvec3 first = bar.points[i];
    const glm::dvec3 turned(-first.y, first.x, first.z);
    EXPECT_LT(glm::distance(last(i), {turned.x, -turned.z, turned.y}), 1e-14);
  }
}

TEST(Sweep, of_a_closed_path_is_a_ring_that_joins_without_a_twist) {
  // Not flat: carried round, the frame arrives turned.
  const std::string ring = "v 0 0 0\nv 4 0 1\nv 4 4 -1\nv 0 4 1\nl 1 2 3 4 1\n";
  const CellMesh mesh = swept(ring, {.radius = 0.4, .layers = 3});
  const SubdivisionLattice lattice = lattice_of(mesh);
  const CellComplex& complex = *lattice.complex;
  EXPECT_EQ(complex.n_vertices() + complex.n_faces(), complex.n_edges() + complex.n_cells());
  const std::size_t n = mesh.points.size() / 12;
  for (std::size_t step = 0; step < 12; ++step) {
    for (std::size_t i = 0; i < n; ++i) {
      const double piece =
          glm::distance(mesh.points[step * n + i], mesh.points[(step + 1) % 12 * n + i]);
      EXPECT_LT(piece, 2.5) << step;
    }
  }
}

TEST(Sweep, follows_lines_in_any_order_and_makes_several_paths_parts_side_by_side) {
  const Model path = path_model(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 5 0\nv 1 5 0\nv 1 6 0\n"
      "l 3 4\nl 3 2\nl 1 2\nl 1 2\nl 5 6\nl 6 7\nl 7 5\n");
  const std::vector<Polyline> lines = polylines_of(path);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].points, (std::vector<std::int32_t>{0, 1, 2, 3}));
  EXPECT_FALSE(lines[0].is_closed);
  EXPECT_EQ(lines[1].points.size(), 3u);
  EXPECT_TRUE(lines[1].is_closed);
  const CellMesh both = sweep(path.points(), lines, {}, {.radius = 0.1, .layers = 2});
  (void)lattice_of(both);
}

TEST(Sweep, is_as_wide_as_the_model_is_there) {
  // A cone's frustum along x, radius 1 to 2, and something far away.
  test::Surface cone;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j < 24; ++j) {
      const double angle = 2 * std::numbers::pi * j / 24;
      const double radius = 1 + i / 20.0;
      cone.points.emplace_back(0.5 * i, radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  cone.points.emplace_back(5, 50, 0);
  cone.points.emplace_back(-3, 0, 0);
  const Model model = cone.model();
  const SubdivisionLattice lattice = lattice_of(swept(
      "v -0.5 0 0\nv 10.5 0 0\nl 1 2\n", {.padding = 0.02, .reach = 10, .layers = 10}, &model));
  const StatusCounts counts = embed(freeze_adaptive(lattice), model.points()).counts();
  EXPECT_EQ(counts.inside, model.points().size() - 2);
  EXPECT_EQ(counts.outside, 2u);
  double first = 0;
  double last = 0;
  for (const glm::dvec3& point : lattice.rest) {
    const double radius = glm::length(glm::dvec2(point.y, point.z));
    (point.x < 0 ? first : last) = std::max(point.x < 0 ? first : last, radius);
  }
  EXPECT_LT(first, 1.6);
  EXPECT_GT(last, 2);
  EXPECT_LT(last, 2.4);
}

TEST(Sweep, names_the_point_where_more_than_two_lines_meet) {
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nl 1 2\nl 1 3\nl 1 4\n", {.radius = 0.1}),
            "path.obj: sweep: 3 lines meet at point 0, at most two can: sweep the branches one by "
            "one and attach them");
}

TEST(Sweep, refuses_paths_that_are_none_or_bend_too_sharply_and_options_out_of_range) {
  const std::string straight = "v 0 0 0\nv 1 0 0\nl 1 2\n";
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\n", {.radius = 1}), testing::HasSubstr("has no lines"));
  EXPECT_THAT(refusal("v 0 0 0\nv 0 0 0\nl 1 2\n", {.radius = 1}),
              testing::HasSubstr("points 0 and 1 of a line coincide"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 0 1e-3 0\nl 1 2 3\n", {.radius = 1}),
              testing::HasSubstr("runs back on itself at point 1"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n", {.radius = 2}),
              testing::HasSubstr("bends too sharply for its radius"));
  EXPECT_THAT(refusal(straight, {}), testing::HasSubstr("the radius must be positive"));
  EXPECT_THAT(refusal(straight, {.radius = std::nan("")}), testing::HasSubstr("radius"));
  EXPECT_THAT(refusal(straight, {.radius = 1, .padding = -1}), testing::HasSubstr("padding"));
  EXPECT_THAT(refusal(straight, {.radius = 1, .core = 0}), testing::HasSubstr("core"));
  EXPECT_THAT(refusal(straight, {.radius = 1, .rings = 1000}), testing::HasSubstr("rings"));
  EXPECT_THAT(refusal(straight, {.radius = 1, .layers = -1}), testing::HasSubstr("layers"));
  const Model away = test::box_surface({5, 5, 5}, {6, 6, 6}).model();
  EXPECT_THAT(refusal(straight, {}, &away), testing::HasSubstr("no point of the model"));
}

}  // namespace
}  // namespace espalier
