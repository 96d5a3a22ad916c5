/// Ready-made lattices: valid, and as large as asked for.

#include "lattice/build/inventory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>

#include "lattice/build/junction.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/refine.h"
#include "lattice/topology/validate.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

void expect_valid(const CellMesh& mesh, const std::string& name) {
  const std::vector<Defect> defects = validate(mesh.cells, mesh.points);
  EXPECT_TRUE(defects.empty()) << name << ": " << (defects.empty() ? "" : defects.front().message);
}

/// The smallest and largest value of a function on the refined boundary.
std::pair<double, double> range_on_boundary(const CellMesh& mesh,
                                            const std::function<double(const glm::dvec3&)>& value,
                                            int levels = 3) {
  const SubdivisionLattice fine = refined(test::lattice_from(mesh), levels);
  std::pair<double, double> range(1e300, -1e300);
  for (const VertexId vertex : fine.complex->vertices()) {
    if (fine.complex->is_boundary(vertex)) {
      const double at = value(fine.rest[vertex.index()]);
      range = {std::min(range.first, at), std::max(range.second, at)};
    }
  }
  return range;
}

double from_y_axis(const glm::dvec3& p) {
  return std::hypot(p.x, p.z);
}

template <class Options>
std::string complaint(CellMesh (*make)(const Options&), const Options& options) {
  try {
    (void)make(options);
    return "";
  } catch (const ParameterError& error) {
    return error.what();
  }
}

TEST(Inventory, is_valid_with_many_options) {
  for (const int n : {1, 2, 3}) {
    expect_valid(make_o_grid({.end_radius = 0.2, .core = n, .rings = 4 - n, .layers = n}), "ogrid");
    expect_valid(make_annulus({.sectors = n + 2, .rings = n, .layers = n}), "annulus");
    expect_valid(make_torus({.sectors = n + 2, .segments = 8 - n}), "torus");
    expect_valid(make_star({.tips = n + 2, .layers = n}), "star");
    expect_valid(make_barbell({.bar_radius = 0.1 * n, .cells = n, .layers = n}), "barbell");
    expect_valid(make_sphere({.cells = n, .rings = n}), "sphere");
  }
}

TEST(Inventory, round_lattices_have_their_sides_at_the_radius) {
  for (const int core : {1, 2, 3}) {
    const auto side = range_on_boundary(make_o_grid({.radius = 0.75, .core = core}), from_y_axis);
    EXPECT_NEAR(side.second, 0.75, core == 1 ? 0.03 : 0.003) << core;
  }
  const auto pipe = range_on_boundary(
      make_annulus({.radius = 1, .inner_radius = 0.5, .sectors = 12}), from_y_axis);
  EXPECT_NEAR(pipe.first, 0.5, 0.001);
  EXPECT_NEAR(pipe.second, 1, 0.002);
  const auto tube =
      range_on_boundary(make_torus({.radius = 2, .tube_radius = 0.5}),
                        [](const glm::dvec3& p) { return std::hypot(from_y_axis(p) - 2, p.y); });
  EXPECT_NEAR(tube.first, 0.5, 0.005);
  EXPECT_NEAR(tube.second, 0.5, 0.015);
}

TEST(Inventory, balls_are_round) {
  for (const int cells : {1, 2, 3}) {
    const auto ball = range_on_boundary(
        make_sphere({.center = {1, 2, 3}, .radius = 0.5, .cells = cells}),
        [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(1, 2, 3)); });
    EXPECT_GT(ball.first, 0.5 * (cells == 1 ? 0.96 : 0.99)) << cells;
    EXPECT_LT(ball.second, 0.5 * 1.05) << cells;
  }
}

TEST(Inventory, a_torus_has_no_ends) {
  const CellComplex complex(make_torus({}).cells);
  const auto characteristic =
      static_cast<int>(complex.n_vertices()) - static_cast<int>(complex.n_edges()) +
      static_cast<int>(complex.n_faces()) - static_cast<int>(complex.n_cells());
  EXPECT_EQ(characteristic, 0);
  EXPECT_EQ(automatic_sharpness(complex), smooth_sharpness(complex));
}

TEST(Inventory, limbs_run_through_their_joints_and_keep_their_radii_round_corners) {
  LimbOptions options;
  options.joints = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 2}};
  options.radii = {0.3, 0.3, 0.2, 0.1};
  const CellMesh mesh = make_limb(options);
  expect_valid(mesh, "limb");
  ASSERT_EQ(mesh.points.size(), 90u);
  for (std::size_t joint = 0; joint < 4; ++joint) {
    EXPECT_LT(glm::distance(mesh.points[27 * joint], options.joints[joint]), 1e-15);
  }
  // At the first corner the section lies in the plane that halves the angle.
  for (std::size_t i = 27; i < 36; ++i) {
    EXPECT_NEAR(mesh.points[i].x - 2, -mesh.points[i].y, 1e-15);
    const double across = std::hypot(mesh.points[i].y, mesh.points[i].z);
    EXPECT_NEAR(across, i == 27 ? 0 : glm::length(mesh.points[1]), 1e-14);
  }
}

TEST(Inventory, junctions_are_valid_with_arms_to_all_sides) {
  JunctionOptions options;
  const std::vector<glm::dvec3> arms = {{2, 0, 0},  {0, 2, 0}, {-2, 0, 0},
                                        {0, -2, 0}, {0, 0, 2}, {0, 0.5, -2}};
  for (const glm::dvec3& arm : arms) {
    options.arms.push_back(arm);
    const CellMesh mesh = make_junction(options);
    expect_valid(mesh, std::to_string(options.arms.size()) + " arms");
    // Eight core cells and 24 of their shell less four where an arm is; 4 + 8 a layer of an arm.
    EXPECT_EQ(mesh.cells.cells.n_rows(), 8u + 24 + options.arms.size() * (3 * 12 - 4));
  }
  const auto side = range_on_boundary(
      make_junction({.arms = {{3, 0, 0}, {-3, 0, 0}}, .radius = 0.5}),
      [](const glm::dvec3& p) { return std::abs(p.x) < 1 ? 0 : std::hypot(p.y, p.z); }, 2);
  EXPECT_NEAR(side.second, 0.5, 0.05);
}

TEST(Inventory, names_what_it_refuses) {
  const double nan = std::nan("");
  EXPECT_EQ(complaint(make_o_grid, {.to = {0, 0, 0}}), "ogrid: the ends of an axis must differ");
  EXPECT_EQ(complaint(make_o_grid, {.radius = nan}), "ogrid: the radius must be positive");
  EXPECT_EQ(complaint(make_o_grid, {.core = 0}), "ogrid: core is 0, must be 1 to 250");
  EXPECT_EQ(complaint(make_annulus, {.inner_radius = 0.5}),
            "annulus: the inner radius must be below the radius");
  EXPECT_EQ(complaint(make_torus, {.segments = 2}), "torus: segments is 2, must be 3 to 1000");
  EXPECT_EQ(complaint(make_star, {.tips = 2}), "star: tips is 2, must be 3 to 1000");
  EXPECT_EQ(complaint(make_barbell, {.by = {1, 0, 0}}),
            "barbell: 'by' must not run from disk to disk");
  EXPECT_EQ(complaint(make_sphere, {.center = {0, nan, 0}}),
            "sphere: the centre must have finite coordinates");
  EXPECT_EQ(complaint(make_limb, {.joints = {{0, 0, 0}}, .radii = {1}}),
            "limb: needs 2 to 10000 joints, and a radius at each");
  EXPECT_EQ(complaint(make_limb, {.joints = {{0, 0, 0}, {0, 0, 0}}, .radii = {1, 1}}),
            "limb: joints 0 and 1 coincide");
  EXPECT_EQ(complaint(make_limb, {.joints = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, .radii = {1, 1, 1}}),
            "limb: the bones at joint 1 run back on each other");
  EXPECT_EQ(complaint(make_junction, {.arms = {{2, 0, 0}, {2, 1, 0}}}),
            "junction: two arms point the same way");
  EXPECT_EQ(complaint(make_junction, {.arms = {{0.3, 0, 0}}}),
            "junction: an arm must be longer than about twice the radius");
}

}  // namespace
}  // namespace espalier
