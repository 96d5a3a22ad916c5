#include "deform/injectivity/injectivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "deform/injectivity/dominance.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

constexpr int kCells = 8;
constexpr std::size_t kMiddle = 4 + 9 * (4 + 9 * 4);

InjectivityCheck grid_check(double spacing = 1) {
  auto controls = test::grid_points({kCells, kCells, kCells});
  for (glm::dvec3& p : controls) {
    p *= spacing;
  }
  return InjectivityCheck(std::make_shared<const Volume>(
      test::spline_volume({kCells, kCells, kCells}, std::move(controls))));
}

std::vector<glm::dvec3> pose_of(const InjectivityCheck& check) {
  const auto rest = check.volume().rest_controls();
  return {rest.begin(), rest.end()};
}

std::vector<glm::dvec3> drag_of(const InjectivityCheck& check, const glm::dvec3& direction) {
  std::vector<glm::dvec3> motion(check.volume().n_controls(), glm::dvec3(0));
  motion[kMiddle] = direction;
  return motion;
}

TEST(LargestStep, of_one_control_point_is_known_in_closed_form) {
  for (const double spacing : {1.0, 0.3, 1e6}) {
    const InjectivityCheck check = grid_check(spacing);
    const auto step = [&](const glm::dvec3& direction) {
      return check.largest_step(pose_of(check), drag_of(check, glm::normalize(direction))).step;
    };
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}) {
      EXPECT_LE(step(axis), 27.0 / 8 * spacing);
      EXPECT_GE(step(axis), 27.0 / 8 * spacing * (1 - 1e-4));
    }
    EXPECT_NEAR(step({1, 1, 0}), 3.4886 * spacing, 4.5e-4 * spacing);
    EXPECT_NEAR(step({1, -1, 1}), 3.4958 * spacing, 4.5e-4 * spacing);
  }
}

TEST(LargestStep, ends_where_the_pose_folds) {
  const InjectivityCheck check = grid_check();
  const SafeStep found = check.largest_step(pose_of(check), drag_of(check, {1, 2, 0}));
  EXPECT_TRUE(found.is_tight);
  for (const double part : {0.9999, 1.001}) {
    auto pose = pose_of(check);
    pose[kMiddle] += part * found.step * glm::dvec3(1, 2, 0);
    const LocalInjectivity local = check.local(pose);
    EXPECT_EQ(local.verdict, part < 1 ? Verdict::Certified : Verdict::Folded);
    for (const Fold& fold : local.folds) {
      EXPECT_LT(fold.determinant, 0);
      const auto points = check.volume().points(pose);
      const glm::dmat3 J = check.volume().bezier(fold.patch, points).derivative(fold.uvw);
      EXPECT_NEAR(fold.determinant, glm::determinant(J), 1e-12);  // cells of size 1 at rest
    }
  }
}

TEST(LargestStep, of_points_moved_in_different_directions_ends_where_the_pose_folds) {
  const InjectivityCheck check = grid_check();
  auto motion = drag_of(check, {1, 0.2, 0});
  motion[kMiddle + 1] = {-0.5, 0.1, 0.3};
  motion[kMiddle + 9] = {0, -1, 0.3};
  const SafeStep found = check.largest_step(pose_of(check), motion);
  for (const double part : {0.9999, 1.001}) {
    auto pose = pose_of(check);
    for (std::size_t i = 0; i < pose.size(); ++i) {
      pose[i] += part * found.step * motion[i];
    }
    EXPECT_EQ(check.local(pose).verdict, part < 1 ? Verdict::Certified : Verdict::Folded);
  }
  EXPECT_EQ(check.largest_step(pose_of(check), motion, {.most_step = 0.1}).step, 0.1);
}

TEST(LargestStep, of_a_mirrored_lattice_is_that_of_the_lattice) {
  auto controls = test::grid_points({kCells, kCells, kCells});
  for (glm::dvec3& p : controls) {
    p.y = -p.y;
  }
  const InjectivityCheck check(std::make_shared<const Volume>(
      test::spline_volume({kCells, kCells, kCells}, std::move(controls))));
  EXPECT_NEAR(check.largest_step(pose_of(check), drag_of(check, {0, 1, 0})).step, 27.0 / 8, 3.4e-4);
}

TEST(LargestStep, refuses_a_pose_that_is_folded_already) {
  const InjectivityCheck check = grid_check();
  auto pose = pose_of(check);
  pose[kMiddle].x += 5;
  try {
    (void)check.largest_step(pose, drag_of(check, {1, 0, 0}));
    FAIL();
  } catch (const LatticeError& error) {
    EXPECT_NE(std::string(error.what()).find("folded before anything moves"), std::string::npos);
  }
}

TEST(DominantStep, is_where_a_cube_is_flat_and_does_not_end_while_it_grows) {
  const BezierPatch cube = test::warped_cube({3, 3, 3}, 0, 1);
  for (const glm::dvec3 by : {glm::dvec3(-2, 0, 0), glm::dvec3(1, -2, 3), glm::dvec3(1, 0, 4)}) {
    BezierPatch motion = cube;
    for (glm::dvec3& p : motion.points) {
      p *= by;
    }
    const double step = dominant_step(cube, &motion, {});
    if (by.x < 0 || by.y < 0) {
      EXPECT_LE(step, 0.5);
      EXPECT_NEAR(step, 0.5, 1e-9);
    } else {
      EXPECT_EQ(step, INFINITY);
    }
  }
}

TEST(LocalInjectivity, is_certified_at_rest_and_under_affine_maps) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const auto volume = std::make_shared<const Volume>(
        freeze_adaptive(family.lattice, {.tolerance = 1e-1, .most_levels = 1}));
    const InjectivityCheck check(volume);
    auto pose = pose_of(check);
    for (glm::dvec3& p : pose) {
      p = {p.x + 0.4 * p.y + 3, 1.2 * p.y - 0.3 * p.z, p.z + 0.1 * p.x};
    }
    for (const bool is_posed : {false, true}) {
      const LocalInjectivity local = check.local(is_posed ? pose : pose_of(check));
      EXPECT_EQ(local.verdict, Verdict::Certified) << family.name;
      EXPECT_EQ(local.n_patches, volume->n_patches()) << family.name;
    }
    for (glm::dvec3& p : pose) {
      p.x = -p.x;
    }
    EXPECT_EQ(check.local(pose).verdict, Verdict::Folded) << family.name;
  }
}

TEST(LocalInjectivity, looks_only_at_the_patches_it_is_given) {
  const InjectivityCheck check = grid_check();
  auto pose = pose_of(check);
  pose[kMiddle].x += 5;
  const std::vector<std::int32_t> far = {0, 1, 2};
  EXPECT_EQ(check.local(pose, far).verdict, Verdict::Certified);
  EXPECT_EQ(check.local(pose, far).n_patches, 3u);
  EXPECT_EQ(check.local(pose).verdict, Verdict::Folded);
}

TEST(LocalInjectivity, is_the_same_for_any_number_of_threads) {
  const InjectivityCheck check = grid_check();
  const auto pose = test::jittered(pose_of(check), 0.9, 3);
  set_thread_count(1);
  const LocalInjectivity one = check.local(pose, 100);
  set_thread_count(4);
  const LocalInjectivity four = check.local(pose, 100);
  set_thread_count(0);
  ASSERT_GT(one.folds.size(), 0u);
  ASSERT_EQ(one.folds.size(), four.folds.size());
  for (std::size_t i = 0; i < one.folds.size(); ++i) {
    EXPECT_EQ(one.folds[i].patch, four.folds[i].patch);
    EXPECT_EQ(one.folds[i].determinant, four.folds[i].determinant);
  }
}

TEST(InjectivityCheck, names_bad_input) {
  const InjectivityCheck check = grid_check();
  auto pose = pose_of(check);
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY), 1e19}) {
    pose[5].y = bad;
    EXPECT_THROW((void)check.local(pose), ParameterError);
  }
  EXPECT_THROW((void)check.largest_step(pose_of(check), pose), ParameterError);
  pose.pop_back();
  EXPECT_THROW((void)check.local(pose), ParameterError);
  for (const bool is_flat : {true, false}) {
    auto controls = test::grid_points({3, 3, 3});
    for (glm::dvec3& p : controls) {
      p.z = is_flat ? 0 : p.z * (p.z - 1.4);
    }
    try {
      const InjectivityCheck bad(
          std::make_shared<const Volume>(test::spline_volume({3, 3, 3}, controls)));
      FAIL();
    } catch (const LatticeError& error) {
      EXPECT_NE(
          std::string(error.what()).find(is_flat ? "at rest is singular" : "at rest is folded"),
          std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace espalier
