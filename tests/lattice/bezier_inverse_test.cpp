#include "lattice/volume/bezier_inverse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/places.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

using test::random_place;
using test::warped_cube;

TEST(Invert, is_exact_to_round_off_in_warped_cubes_and_pyramids) {
  std::mt19937 random(1);
  for (const std::array<int, 3>& degree :
       {std::array{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1, 1, 3}, {4, 2, 3}}) {
    for (unsigned trial = 0; trial < 1000; ++trial) {
      const bool is_pyramid = trial % 2 == 1;
      const double highest = *std::max_element(degree.begin(), degree.end());
      const double noise = (is_pyramid ? 0.1 : 0.2) / highest;  // no folds near the apex either
      const BezierPatch patch = warped_cube(degree, noise, trial, is_pyramid);
      const glm::dvec3 uvw = random_place(random);
      const auto found = invert(patch, patch.value(uvw));
      ASSERT_TRUE(found.has_value());
      EXPECT_LT(found->residual, 2e-15) << degree[0] << degree[1] << degree[2] << trial;
      if (uvw.z < 1) {
        EXPECT_LT(glm::distance(found->uvw, uvw), 1e-11 / (1 - uvw.z)) << trial;
      }
      const auto by_subdivision = invert_by_subdivision(patch, patch.value(uvw), 1e-14);
      ASSERT_TRUE(by_subdivision.has_value());
      EXPECT_LT(by_subdivision->residual, 1e-14) << trial;
    }
  }
}

TEST(Invert, takes_one_step_in_affine_patches) {
  const glm::dmat3 A(1.2, 0.1, 0.3, -0.2, 0.9, 0.1, 0.0, 0.4, 1.1);
  std::mt19937 random(2);
  for (const int degree : {1, 2, 3, 4}) {
    BezierPatch patch = warped_cube({degree, degree, degree}, 0, 0);
    for (glm::dvec3& point : patch.points) {
      point = A * point + glm::dvec3(3, 4, 5);
    }
    for (int trial = 0; trial < 100; ++trial) {
      const auto found = invert(patch, patch.value(random_place(random)));
      ASSERT_TRUE(found.has_value());
      EXPECT_LE(found->n_steps, 1);
      EXPECT_LT(found->residual, 2e-14);
    }
  }
}

TEST(Invert, takes_few_steps_in_warped_tricubic_patches) {
  std::mt19937 random(3);
  std::vector<int> n_steps;
  for (unsigned trial = 0; trial < 1000; ++trial) {
    const BezierPatch patch = warped_cube({3, 3, 3}, 0.1, trial);
    const auto found = invert(patch, patch.value(random_place(random)));
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(found->residual, 1e-12);
    n_steps.push_back(found->n_steps);
  }
  std::nth_element(n_steps.begin(), n_steps.begin() + 500, n_steps.end());
  EXPECT_LE(n_steps[500], 5);
}

TEST(Invert, goes_beyond_the_cube_as_far_as_the_margin) {
  const BezierPatch patch = warped_cube({3, 3, 1}, 0.03, 5);
  const glm::dvec3 beyond(1.04, 0.5, -0.03);
  const auto found = invert(patch, patch.value(beyond), 0.05);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(found->residual, 1e-15);
  EXPECT_LT(glm::distance(found->uvw, beyond), 1e-13);
  for (const double margin : {0.0, 0.02}) {
    const auto held = invert(patch, patch.value(beyond), margin);
    ASSERT_TRUE(held.has_value());
    EXPECT_GT(held->residual, 0.01);
    EXPECT_EQ(held->uvw.x, 1 + margin);
  }
}

TEST(Invert, gives_nothing_for_what_is_no_number) {
  const BezierPatch patch = warped_cube({3, 3, 3}, 0, 0);
  EXPECT_FALSE(invert(patch, glm::dvec3(NAN, 0, 0)).has_value());
  EXPECT_FALSE(invert_by_subdivision(patch, glm::dvec3(NAN, 0, 0), 1e-9).has_value());
}

TEST(InvertBySubdivision, finds_points_where_newton_from_the_centre_fails) {
  // x = 1/2 + 4 (u − 1/2)³: one to one, with a singular derivative at the centre.
  BezierPatch patch = warped_cube({3, 1, 1}, 0, 0);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    patch.points[i].x = i % 2 == 0 ? 0 : 1;
  }
  EXPECT_EQ(patch.derivative(glm::dvec3(0.5))[0], glm::dvec3(0));
  for (const double offset : {0.0, 1e-6, 1e-3, 0.2}) {
    const auto found = invert_by_subdivision(patch, {0.5 + offset, 0.3, 0.6}, 1e-15);
    ASSERT_TRUE(found.has_value());
    EXPECT_LE(found->residual, 1e-15) << offset;
    EXPECT_NEAR(found->uvw.x, 0.5 + std::cbrt(offset / 4), 1e-5) << offset;
  }
}

TEST(InvertBySubdivision, misses_no_point_of_patches_that_fold) {
  std::mt19937 random(6);
  int n_newton_fails = 0;
  for (unsigned trial = 0; trial < 400; ++trial) {
    const BezierPatch patch = warped_cube({3, 3, 3}, 0.5, trial);
    const glm::dvec3 x = patch.value(random_place(random));
    const auto by_newton = invert(patch, x);
    n_newton_fails += by_newton && by_newton->residual < 1e-12 ? 0 : 1;
    const auto found = invert_by_subdivision(patch, x, 1e-13);
    ASSERT_TRUE(found.has_value());
    EXPECT_LE(found->residual, 1e-13) << trial;
  }
  EXPECT_GT(n_newton_fails, 0);
}

TEST(InvertBySubdivision, is_certain_of_points_outside) {
  const BezierPatch patch = warped_cube({3, 3, 3}, 0.05, 7);
  for (const double distance : {1e-6, 1e-3, 0.1}) {
    const glm::dvec3 on_face = patch.value({1, 0.4, 0.6});
    const auto found = invert_by_subdivision(patch, on_face + glm::dvec3(distance, 0, 0), 1e-12);
    if (found) {
      EXPECT_GT(found->residual, 0.1 * distance);
      EXPECT_TRUE(found->is_converged) << distance;
    }
  }
}

TEST(BezierInverse, finds_the_place_in_a_rational_patch) {
  BezierPatch patch = test::warped_cube({3, 2, 3}, 0.05, 21);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    patch.weights.push_back(1 + 0.5 * std::sin(static_cast<double>(i)));
    patch.points[i] = patch.weights[i] * (patch.points[i] + glm::dvec3(5, -3, 2));
  }
  for (const glm::dvec3& uvw :
       {glm::dvec3(0.3, 0.6, 0.2), glm::dvec3(0, 1, 0.5), glm::dvec3(0.9, 0.1, 0.95)}) {
    const glm::dvec3 x = patch.value(uvw);
    const auto by_newton = invert(patch, x);
    ASSERT_TRUE(by_newton);
    EXPECT_LT(glm::distance(by_newton->uvw, uvw), 1e-12);
    EXPECT_LT(by_newton->residual, 1e-14);
    const auto by_subdivision = invert_by_subdivision(patch, x, 1e-13);
    ASSERT_TRUE(by_subdivision);
    EXPECT_LT(glm::distance(patch.value(by_subdivision->uvw), x), 1e-13);
  }
  EXPECT_FALSE(invert_by_subdivision(patch, {9, 9, 9}, 1e-12));
}

}  // namespace
}  // namespace espalier
