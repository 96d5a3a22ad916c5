#include "lattice/volume/volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

/// The uniform cubic B-spline round 0.
double spline(double t) {
  t = std::abs(t);
  return t < 1 ? 2.0 / 3 - t * t + t * t * t / 2 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0;
}

/// With a phantom point at either natural end folded in, for control i of 0 … n.
double natural_spline(int i, int n, double t) {
  const double before = spline(t + 1);  // of phantom −1 = 2 P0 − P1
  const double after = spline(t - n - 1);
  double weight = spline(t - i);
  weight += i == 0 ? 2 * before : i == 1 ? -before : 0;
  weight += i == n ? 2 * after : i == n - 1 ? -after : 0;
  return weight;
}

constexpr std::array<int, 3> kIntervals = {2, 3, 4};

TEST(Volume, bezier_form_is_the_b_spline) {
  const auto controls = test::jittered(test::grid_points(kIntervals), 0.3, 1);
  const Volume volume = test::spline_volume(kIntervals, controls);
  ASSERT_EQ(volume.n_patches(), 24u);
  const std::vector<glm::dvec3> cells = test::grid_points({1, 2, 3});
  const std::vector<glm::dvec3> grid = test::grid_points(kIntervals);
  for (std::size_t patch = 0; patch < cells.size(); ++patch) {
    const BezierPatch map = volume.bezier(patch, volume.rest_points());
    EXPECT_EQ(map.degree, volume.degree(patch));
    for (const glm::dvec3& uvw : {glm::dvec3(0.3, 0.6, 0.2), glm::dvec3(0, 1, 0.5)}) {
      const glm::dvec3 at = cells[patch] + uvw;
      glm::dvec3 expected(0);
      for (std::size_t i = 0; i < grid.size(); ++i) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
          weight *= natural_spline(static_cast<int>(grid[i][axis]),
                                   kIntervals[static_cast<std::size_t>(axis)], at[axis]);
        }
        expected += weight * controls[i];
      }
      EXPECT_LT(glm::distance(map.value(uvw), expected), 4e-15) << patch;
    }
  }
}

TEST(Volume, bezier_form_of_zero_displacements_is_zero_and_keeps_its_memory) {
  const Volume volume = test::spline_volume(kIntervals, test::grid_points(kIntervals));
  const std::vector<glm::dvec3> still = volume.displacements(volume.rest_controls());
  BezierPatch moves = volume.bezier(0, volume.rest_points());
  const glm::dvec3* const memory = moves.points.data();
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    volume.bezier(i, still, moves);
    EXPECT_EQ(moves.points, std::vector<glm::dvec3>(moves.points.size(), glm::dvec3(0)));
    EXPECT_EQ(moves.points.data(), memory);
  }
}

TEST(Volume, patch_boxes_hold_a_leafs_reach_but_not_across_the_boundary) {
  VolumeTables tables;
  tables.stencils = StencilTable::build(
      8, 8, [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1.0); });
  tables.extractions = {bezier_extraction(1)};
  tables.patches = {Patch{{0, 0, 0}, 1u << 2, false, true}};
  tables.blocks = {{0, 1, 2, 3, 4, 5, 6, 7}};
  const Volume volume(tables, test::grid_points({1, 1, 1}));
  const Box box = volume.patch_boxes()[0];
  EXPECT_LT(glm::distance(box.min, glm::dvec3(-kLeafReach, 0, -kLeafReach)), 1e-15);
  EXPECT_LT(glm::distance(box.max, glm::dvec3(1 + kLeafReach)), 1e-15);
}

TEST(Volume, moves_no_point_that_no_moved_control_point_reaches) {
  const SubdivisionLattice box = test::lattice_from(make_box({6, 1, 1}, {0, 0, 0}, {6, 1, 1}));
  const Volume volume = freeze_uniform(box, 2);
  std::vector<glm::dvec3> pose = box.rest;
  for (const glm::dvec3& move : volume.displacements(pose)) {
    EXPECT_EQ(move, glm::dvec3(0));
  }
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (box.rest[i].x == 6) {
      pose[i].y += 0.1;
    }
  }
  const std::vector<glm::dvec3> moves = volume.displacements(pose);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    // The uniform cubic's support: two cells from the control point, a little less while refined.
    const double x = volume.rest_points()[i].x;
    if (x <= 4 || x >= 5) {
      EXPECT_EQ(moves[i] == glm::dvec3(0), x <= 4) << i;
    }
  }
}

TEST(Volume, refuses_a_pose_of_another_size) {
  const SubdivisionLattice box = test::lattice_from(make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}));
  const Volume volume = freeze_uniform(box, 1);
  EXPECT_THROW((void)volume.displacements(std::vector<glm::dvec3>(7)), ParameterError);
}

}  // namespace
}  // namespace espalier
