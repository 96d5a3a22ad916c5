/// Locks of Bézier, B-spline, NURBS and hierarchical lattices.

#include <gtest/gtest.h>

#include <algorithm>

#include "lattice/core/error.h"
#include "tests/support/families.h"
#include "tests/support/lock_jumps.h"

namespace espalier {
namespace {

using test::crossing_scene;
using test::Jumps;
using test::largest_jumps;

constexpr int kCounts = 6;

/// On [0,3]³, in spans of length 1.
TensorLattice spline(Ends ends, TensorKind kind = TensorKind::BSpline) {
  const TensorAxis along = TensorAxis::make(kCounts, 3, Ends::Open);
  const int n_spans = 3;
  const int n = ends == Ends::Open || ends == Ends::Uniform ? n_spans + 3 : n_spans + 1;
  const TensorAxis across = TensorAxis::make(n, 3, ends);
  OrientedBox box;
  box.center = glm::dvec3(1.5);
  box.half_sizes = glm::dvec3(1.5);
  return make_tensor_lattice(kind, {along, along, across}, box, BoxFilling::Volume);
}

/// On [0,6]³, in cells of length 2 and, below z = 2, of length 1.
ThbLattice hierarchy() {
  OrientedBox box;
  box.center = glm::dvec3(3);
  box.half_sizes = glm::dvec3(3);
  const ThbLattice coarse = make_thb_lattice({kCounts, kCounts, kCounts}, {3, 3, 3}, box);
  return with_cells(coarse, 1,
                    cells_of_box(*coarse.hierarchy, 1, {0, 0, 0}, {2.0 / 3, 1, 1.0 / 3}));
}

struct Case {
  std::string name;
  Lattice lattice;
  std::array<std::size_t, 3> n_layers;  ///< for C0, C1, C2
  int order;                            ///< of the first derivative to jump with C1
};

std::vector<Case> cases() {
  return {{"open", spline(Ends::Open), {1, 2, 3}, 2},
          {"natural", spline(Ends::Natural), {1, 2, 2}, 3},
          {"uniform", spline(Ends::Uniform), {3, 3, 3}, 3},
          {"nurbs", spline(Ends::Open, TensorKind::Nurbs), {1, 2, 3}, 2},
          {"thb", hierarchy(), {1, 2, 3}, 2}};
}

const std::vector<glm::dvec2> kLines = {{0.3, 0.4}, {1.5, 1.25}, {2, 2.9}};

std::vector<glm::dvec3> jittered_pose(const Lattice& lattice) {
  return test::jittered({lattice.rest_points().begin(), lattice.rest_points().end()}, 0.8, 3);
}

TEST(GridLock, joins_the_motion_to_what_stays_in_value_slope_and_curvature) {
  for (const Case& one : cases()) {
    const Scene scene = crossing_scene(one.lattice, kLines);
    const std::vector<glm::dvec3> pose = jittered_pose(one.lattice);
    const Jumps free = largest_jumps(scene, pose);
    EXPECT_GT(free[0], 0.05) << one.name;
    EXPECT_GT(free[1], 0.05) << one.name;
    for (int order = 0; order < 3; ++order) {
      const std::string option = "C" + std::to_string(order);
      const Jumps jumps = largest_jumps(with_lock(scene, "m", "rest", option), pose);
      EXPECT_LT(jumps[0], 1e-14) << one.name << option;
      EXPECT_LT(order > 0 ? jumps[1] : 0, 1e-13) << one.name << option;
      EXPECT_LT(order > 1 ? jumps[2] : 0, 1e-12) << one.name << option;
      EXPECT_GT(jumps[3], 0.01) << one.name << option << ": it must move farther in";
      if (order == 1 && one.order == 2) {
        EXPECT_GT(jumps[2], 0.05) << one.name << ": no more is locked than must be";
      }
    }
  }
}

TEST(GridLock, of_a_side_keeps_its_first_layers) {
  for (const Case& one : cases()) {
    if (one.name == "thb") {
      continue;
    }
    const Scene scene = crossing_scene(one.lattice, kLines);
    for (std::size_t order = 0; order < 3; ++order) {
      const std::string option = "C" + std::to_string(order) + ":w0";
      const Lock lock = with_lock(scene, "m", "rest", option).bound.at({"m", "rest"}).lock;
      EXPECT_EQ(lock.faces.size(), 9u);
      ASSERT_EQ(lock.controls.size(), one.n_layers[order] * kCounts * kCounts) << one.name;
      for (std::size_t i = 0; i < lock.controls.size(); ++i) {
        EXPECT_EQ(lock.controls[i], static_cast<std::int32_t>(i)) << one.name;
      }
    }
  }
}

/// Coarse functions that are truncated to nothing near the border are left free.
TEST(GridLock, of_a_hierarchy_keeps_the_first_layers_of_every_level) {
  const ThbLattice lattice = hierarchy();
  const Scene scene = crossing_scene(lattice, kLines);
  const auto& functions = lattice.hierarchy->controls();
  for (int order = 0; order < 3; ++order) {
    const std::string option = "C" + std::to_string(order) + ":w0,w0";
    const Lock lock = with_lock(scene, "m", "rest", option).bound.at({"m", "rest"}).lock;
    std::vector<std::int32_t> first_layers;
    std::vector<std::int32_t> finest;
    for (std::size_t i = 0; i < functions.size(); ++i) {
      if (functions[i].index.k <= order) {
        first_layers.push_back(static_cast<std::int32_t>(i));
        if (functions[i].level == 1) {
          finest.push_back(static_cast<std::int32_t>(i));
        }
      }
    }
    EXPECT_FALSE(finest.empty());
    EXPECT_TRUE(std::ranges::includes(first_layers, lock.controls)) << option;
    EXPECT_TRUE(std::ranges::includes(lock.controls, finest)) << option;
  }
}

TEST(GridLock, of_faces_by_number_is_that_of_the_faces_the_model_crosses) {
  for (const Case& one : cases()) {
    const Scene scene = crossing_scene(one.lattice, kLines);
    const Lock crossed = with_lock(scene, "m", "rest", "C1").bound.at({"m", "rest"}).lock;
    ASSERT_FALSE(crossed.faces.empty());
    std::string option = "C1:";
    for (const std::int32_t face : crossed.faces) {
      option += (option.size() > 3 ? "," : "") + std::to_string(face);
      EXPECT_EQ(face % 6, 4) << one.name;  // w = 0
    }
    const Lock named = with_lock(scene, "m", "rest", option).bound.at({"m", "rest"}).lock;
    EXPECT_EQ(named.faces, crossed.faces);
    EXPECT_EQ(named.controls, crossed.controls);
  }
}

TEST(GridLock, keeps_weights_too) {
  TensorLattice lattice = spline(Ends::Open, TensorKind::Nurbs);
  std::vector<double> weights(lattice.weights.size(), 3.0);
  const Scene scene = crossing_scene(lattice, kLines);
  const Lock lock = with_lock(scene, "m", "rest", "C1:w0").bound.at({"m", "rest"}).lock;
  weights = locked_weights(std::move(weights), lattice.weights, lock);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_EQ(weights[i], i < 2 * kCounts * kCounts ? 1 : 3);
  }
  EXPECT_TRUE(locked_weights({}, lattice.weights, lock).empty());
}

TEST(GridLock, refuses_faces_and_sides_that_are_not_on_the_boundary) {
  const auto error = [&](const Lattice& lattice, const std::string& option) -> std::string {
    try {
      (void)with_lock(crossing_scene(lattice, kLines), "m", "rest", option);
    } catch (const ParameterError& caught) {
      return caught.what();
    }
    return "no error";
  };
  const Lattice open = spline(Ends::Open);
  EXPECT_EQ(error(open, "C1:162"),
            "'lock' is 'C1:162': in rest face 162 does not exist: faces are 6 times a patch, of "
            "which there are 27, plus a side from 0 to 5");
  EXPECT_EQ(error(open, "C1:5"),
            "'lock' is 'C1:5': in rest face 5 lies between two patches: only boundary faces can be "
            "locked");
  EXPECT_EQ(error(open, "C1:w2").find("'lock' is 'C1:w2', must be none"), 0u);
  const TensorAxis ring = TensorAxis::make(6, 3, Ends::Periodic);
  const TensorAxis axis = TensorAxis::make(4, 3, Ends::Open);
  EXPECT_EQ(error(make_tensor_lattice(TensorKind::BSpline, {ring, axis, axis}, {}), "C0:u1"),
            "'lock' is 'C0:u1': in rest side u1 does not exist: the lattice is closed to a ring "
            "there");
  EXPECT_EQ(error(test::prism(test::grid_section(2, 1), 1), "C0:u0"),
            "'lock' is 'C0:u0': in rest cells have no sides with names: give the numbers of faces");
}

}  // namespace
}  // namespace espalier
