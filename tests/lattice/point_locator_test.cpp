#include "lattice/volume/point_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>
#include <string>

#include "lattice/build/primitives.h"
#include "lattice/core/spatial_order.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"
#include "tests/support/places.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

void expect_round_trips(const Volume& volume, std::size_t n, const std::string& name) {
  const std::vector<glm::dvec3> points = test::points_inside(volume, n, 11);
  const std::vector<Location> found = PointLocator(volume).locate(points);
  std::vector<int> n_steps;
  BezierPatch patch;
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_GE(found[i].patch, 0) << name << " misses point " << i;
    volume.bezier(static_cast<std::size_t>(found[i].patch), volume.rest_points(), patch);
    largest = std::max(largest, glm::distance(patch.value(found[i].uvw), points[i]));
    n_steps.push_back(found[i].n_steps);
  }
  EXPECT_LE(largest, 1e-12 * volume.diagonal()) << name;
  const auto middle = n_steps.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(n_steps.begin(), middle, n_steps.end());
  EXPECT_LE(*middle, 5) << name;
}

TEST(PointLocator, brings_every_point_of_every_family_back_in_few_steps) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    expect_round_trips(freeze_adaptive(family.lattice, {.tolerance = 1e-2}), 20000, family.name);
  }
}

TEST(PointLocator, needs_no_newton_step_in_affine_patches_and_is_as_exact_there) {
  const glm::dmat3 A(1.2, 0.1, 0.3, -0.2, 0.9, 0.1, 0.0, 0.4, 1.1);
  std::vector<glm::dvec3> controls = test::grid_points({3, 2, 2});
  for (glm::dvec3& point : controls) {
    point = A * point + glm::dvec3(3, 4, 5);
  }
  for (const bool is_tricubic : {true, false}) {
    const Volume volume = is_tricubic ? test::spline_volume({3, 2, 2}, controls) : [&] {
      SubdivisionLattice box = test::lattice_from(make_box({3, 2, 2}, {0, 0, 0}, {3, 2, 2}));
      for (glm::dvec3& point : box.rest) {
        point = A * point + glm::dvec3(3, 4, 5);
      }
      return freeze_uniform(box, 1);
    }();
    const std::vector<glm::dvec3> points = test::points_inside(volume, 5000, 12);
    const auto found = PointLocator(volume).locate(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_GE(found[i].patch, 0);
      EXPECT_EQ(found[i].n_steps, 0);
      const BezierPatch patch =
          volume.bezier(static_cast<std::size_t>(found[i].patch), volume.rest_points());
      EXPECT_LT(glm::distance(patch.value(found[i].uvw), points[i]), 1e-14);
    }
    EXPECT_EQ(PointLocator(volume).locate(points[0] + glm::dvec3(7, 0, 0)).status,
              PointStatus::Outside);
  }
}

TEST(PointLocator, finds_one_point_as_it_finds_many) {
  const Volume volume = freeze_adaptive(test::prism(test::flower_section(5), 2));
  const std::vector<glm::dvec3> points = test::points_inside(volume, 300, 13);
  const PointLocator locator(volume);
  const std::vector<Location> many = locator.locate(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Location one = locator.locate(points[i]);
    EXPECT_EQ(one.patch, many[i].patch);
    EXPECT_EQ(one.uvw, many[i].uvw);
    EXPECT_EQ(one.status, many[i].status);
    EXPECT_EQ(one.n_steps, many[i].n_steps);
  }
}

TEST(PatchFrame, tells_affine_patches_from_others) {
  EXPECT_TRUE(PatchFrame(test::warped_cube({3, 2, 1}, 0, 0)).is_affine());
  BezierPatch patch = test::warped_cube({3, 3, 3}, 0, 0);
  patch.points[21] += glm::dvec3(1e-12, 0, 0);
  EXPECT_FALSE(PatchFrame(patch).is_affine());
  EXPECT_FALSE(PatchFrame(test::warped_cube({1, 1, 1}, 0, 0, true)).is_affine());
}

TEST(PatchFrame, never_rules_out_a_place_of_the_patch_nor_overrates_distances) {
  std::mt19937 random(3);
  for (unsigned trial = 0; trial < 200; ++trial) {
    const BezierPatch patch = test::warped_cube({3, 2, 3}, 0.1, trial, trial % 2 == 1);
    const Box reach{glm::dvec3(-0.05), glm::dvec3(1.05, 1.05, 1)};
    const PatchFrame frame(patch, 1e-9, reach);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 uvw = test::random_place(random);
      EXPECT_TRUE(frame.may_hold(frame.local(patch.value(uvw))));
      const glm::dvec3 beyond = reach.min + uvw * (reach.max - reach.min);
      EXPECT_TRUE(frame.may_hold(frame.local(patch.value(beyond))));
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 other = uvw;
        other[axis] = test::random_place(random)[axis];
        EXPECT_LE(frame.least_distance(axis, std::abs(other[axis] - uvw[axis])),
                  glm::distance(patch.value(uvw), patch.value(other)) + 1e-14);
      }
    }
    EXPECT_FALSE(frame.may_hold(frame.local(glm::dvec3(3))));
  }
}

TEST(PatchFrame, of_a_flat_patch_rules_nothing_out) {
  BezierPatch patch = test::warped_cube({1, 1, 1}, 0, 0);
  for (glm::dvec3& point : patch.points) {
    point.z = 0;
  }
  const PatchFrame frame(patch, 0, Box{glm::dvec3(0), glm::dvec3(1)});
  EXPECT_FALSE(frame.is_affine());
  EXPECT_TRUE(frame.may_hold(frame.local({0.5, 0.5, 0})));
  EXPECT_EQ(frame.guess({0.1, 0.2, 0}), glm::dvec3(0.5));
  EXPECT_EQ(frame.least_distance(0, 1), 0);
}

TEST(SpatialOrder, holds_every_index_once_and_puts_neighbours_together) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 20000; ++i) {
    points.emplace_back(unit(random), 1e-3 * unit(random), unit(random));
  }
  points.emplace_back(NAN, 0, 0);
  std::vector<std::uint32_t> order = spatial_order(points);
  double path = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const double step = glm::distance(points[order[i - 1]], points[order[i]]);
    path += std::isfinite(step) ? step : 0;
  }
  EXPECT_LT(path / 20000, 0.05);  // 0.52 in the order given
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> expected(points.size());
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(order, expected);
  EXPECT_TRUE(spatial_order({}).empty());
  EXPECT_EQ(spatial_order(std::vector(3, glm::dvec3(2))), (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace espalier
