#include "deform/embed/embed.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "deform/evaluate/displace.h"
#include "lattice/build/primitives.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/volume/bezier_inverse.h"
#include "tests/support/families.h"
#include "tests/support/places.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

using test::points_inside;

glm::dvec3 held_value(const Volume& volume, const Binding& binding, std::size_t i,
                      std::span<const glm::dvec3> values) {
  const auto patch = static_cast<std::size_t>(binding.patches[i]);
  return volume.bezier(patch, values).value(binding.uvw[i]);
}

TEST(Embed, misses_no_point_inside_in_any_family) {
  for (test::NamedLattice& family : test::lattice_families()) {
    for (const double scale : {1.0, 1e8, 1e-8}) {
      SubdivisionLattice lattice = family.lattice;
      for (glm::dvec3& point : lattice.rest) {
        point = point * scale + glm::dvec3(3, 1, 2) * scale;
      }
      const Volume volume = freeze_uniform(lattice, 2);
      const std::vector<glm::dvec3> points = points_inside(volume, 4000, 17);
      const Binding binding = embed(volume, points);
      ASSERT_EQ(binding.points.size(), points.size()) << family.name << " " << scale;
      for (std::size_t i = 0; i < binding.points.size(); ++i) {
        const glm::dvec3 found = held_value(volume, binding, i, volume.rest_points());
        const glm::dvec3& wanted = points[static_cast<std::size_t>(binding.points[i])];
        ASSERT_LT(glm::distance(found, wanted), 1e-12 * volume.diagonal()) << family.name;
      }
      EXPECT_TRUE(std::is_sorted(binding.patches.begin(), binding.patches.end()));
    }
  }
}

TEST(Embed, gives_points_on_shared_faces_to_the_lowest_patch) {
  const Volume volume =
      freeze_uniform(test::lattice_from(make_box({2, 1, 1}, {0, 0, 0}, {2, 1, 1})), 1);
  const glm::dvec3 shared(1, 0.3, 0.3);
  const Binding binding = embed(volume, std::vector{shared});
  ASSERT_EQ(binding.patches.size(), 1u);
  std::vector<std::int32_t> holders;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const auto found = invert(volume.bezier(i, volume.rest_points()), shared);
    if (found && found->residual < 1e-14) {
      holders.push_back(static_cast<std::int32_t>(i));
    }
  }
  EXPECT_EQ(holders.size(), 2u);
  EXPECT_EQ(binding.patches[0], holders[0]);
}

TEST(Embed, tells_inside_border_and_outside_apart) {
  const Volume volume =
      freeze_uniform(test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1})), 2);
  const double border = 1e-9 * std::sqrt(3.0);
  const std::vector<glm::dvec3> points = {{0.5, 0.5, 0.5},
                                          {0, 0.4, 0.4},
                                          {1, 1, 1},
                                          {0.9 * border, 0.4, 0.4},
                                          {-0.9 * border, 0.4, 0.4},
                                          {2 * border, 0.4, 0.4},
                                          {-2 * border, 0.4, 0.4},
                                          {7, 0, 0}};
  using enum PointStatus;
  const std::vector<PointStatus> expected = {Inside, Border, Border,  Border,
                                             Border, Inside, Outside, Outside};
  const Binding binding = embed(volume, points);
  EXPECT_EQ(binding.status, expected);
  const StatusCounts counts = binding.counts();
  EXPECT_EQ(counts.inside, 2u);
  EXPECT_EQ(counts.border, 4u);
  EXPECT_EQ(counts.outside, 2u);
  EXPECT_EQ(counts.unconverged, 0u);
}

TEST(Embed, finds_the_same_places_with_one_thread_and_with_four) {
  const Volume volume = freeze_uniform(test::prism(test::wheel_section(5), 3), 2);
  const std::vector<glm::dvec3> points = points_inside(volume, 5000, 4);
  set_thread_count(1);
  const Binding one = embed(volume, points);
  set_thread_count(4);
  const Binding four = embed(volume, points);
  set_thread_count(0);
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.patches, four.patches);
  EXPECT_EQ(one.uvw, four.uvw);
}

constexpr std::array<int, 3> kIntervals = {2, 3, 3};

Volume tricubic_volume(double noise) {
  return test::spline_volume(kIntervals, test::jittered(test::grid_points(kIntervals), noise, 3));
}

TEST(Embed, finds_every_point_of_a_tricubic_volume) {
  const Volume volume = tricubic_volume(0.2);
  const std::vector<glm::dvec3> points = points_inside(volume, 100000, 21);
  const Binding binding = embed(volume, points);
  ASSERT_EQ(binding.points.size(), points.size());
  for (std::size_t i = 0; i < binding.points.size(); ++i) {
    const glm::dvec3 found = held_value(volume, binding, i, volume.rest_points());
    ASSERT_LT(glm::distance(found, points[static_cast<std::size_t>(binding.points[i])]), 1e-12);
  }
}

/// Two trilinear patches over x in [0, 1] and [1 + gap, 2], both leaves; y and z in [0, 1].
Volume leaves_with_gap(double gap) {
  std::vector<glm::dvec3> corners = test::grid_points({1, 1, 1});
  for (std::size_t i = 0; i < 8; ++i) {
    corners.emplace_back(i % 2 == 0 ? 1 + gap : 2, corners[i].y, corners[i].z);
  }
  VolumeTables tables;
  tables.stencils = StencilTable::build(
      16, 16, [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1.0); });
  tables.extractions = {bezier_extraction(1)};
  tables.patches = {Patch{{0, 0, 0}, 0b111101, false, true},
                    Patch{{0, 0, 0}, 0b111110, false, true}};
  tables.blocks = {{0, 1, 2, 3, 4, 5, 6, 7}, {8, 9, 10, 11, 12, 13, 14, 15}};
  return {std::move(tables), std::move(corners)};
}

TEST(Embed, gives_what_is_left_between_leaves_to_the_nearest_by_extrapolation) {
  const Volume volume = leaves_with_gap(0.0625);
  const std::vector<glm::dvec3> points = {
      {1.01, 0.5, 0.5},    {1.04, 0.5, 0.5},  {1.03, 0, 0.5},   {1.01, -1e-3, 0.5},
      {1.01, -1e-10, 0.5}, {-0.01, 0.5, 0.5}, {2.01, 0.5, 0.5}, {1.03125, 0.5, 1.01}};
  using enum PointStatus;
  const std::vector<PointStatus> expected = {Inside, Inside,  Border,  Outside,
                                             Border, Outside, Outside, Outside};
  const Binding binding = embed(volume, points);
  EXPECT_EQ(binding.status, expected);
  EXPECT_EQ(binding.points, (std::vector<std::int32_t>{0, 2, 4, 1}));
  EXPECT_EQ(binding.patches, (std::vector<std::int32_t>{0, 0, 0, 1}));
  EXPECT_LT(glm::distance(binding.uvw[0], points[0]), 1e-15);
  EXPECT_LT(glm::distance(binding.uvw[2], glm::dvec3(1.01, 0, 0.5)), 1e-15);
  EXPECT_LT(binding.uvw[3].x, 0);
  for (const glm::dvec3& uvw : binding.uvw) {
    EXPECT_GE(uvw.x, -kLeafReach);
    EXPECT_LE(uvw.x, 1 + kLeafReach);
  }
}

TEST(Embed, prefers_the_leaf_that_is_nearer_in_space_to_the_one_nearer_in_parameters) {
  // Two leaves end to end, 100 long and 1 wide, and a point beside the second.
  std::vector<glm::dvec3> corners = test::grid_points({2, 1, 1});
  for (glm::dvec3& point : corners) {
    point.x *= 100;
  }
  VolumeTables tables;
  tables.stencils = StencilTable::build(
      12, 12, [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1.0); });
  tables.extractions = {bezier_extraction(1)};
  tables.patches = {Patch{{0, 0, 0}, 0, false, true}, Patch{{0, 0, 0}, 0, false, true}};
  tables.blocks = {{0, 1, 3, 4, 6, 7, 9, 10}, {1, 2, 4, 5, 7, 8, 10, 11}};
  const Volume volume(std::move(tables), std::move(corners));
  const Binding binding = embed(volume, std::vector<glm::dvec3>{{101, 1.04, 0.5}, {99, 1.04, 0.5}});
  EXPECT_EQ(binding.points, (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(binding.patches, (std::vector<std::int32_t>{0, 1}));
}

TEST(Embed, leaves_points_beyond_a_leafs_reach_outside) {
  const Volume volume = leaves_with_gap(0.25);
  const Binding binding = embed(volume, std::vector<glm::dvec3>{{1.125, 0.5, 0.5}});
  EXPECT_EQ(binding.status[0], PointStatus::Outside);
}

TEST(Displace, at_rest_moves_nothing_bit_for_bit) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_uniform(family.lattice, 2);
    const std::vector<glm::dvec3> points = points_inside(volume, 500, 9);
    const auto moved = displaced_points(volume, embed(volume, points), points,
                                        volume.displacements(family.lattice.rest));
    EXPECT_EQ(moved, points) << family.name;
  }
}

TEST(Displace, follows_an_affine_pose_exactly_and_so_does_its_gradient) {
  const glm::dmat3 A(1.2, 0.1, 0.3, -0.2, 0.9, 0.1, 0.0, 0.4, 1.1);
  const glm::dvec3 b(0.5, -1, 2);
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_uniform(family.lattice, 2);
    std::vector<glm::dvec3> pose = family.lattice.rest;
    for (glm::dvec3& point : pose) {
      point = A * point + b;
    }
    std::vector<glm::dvec3> points = points_inside(volume, 500, 5);
    points.emplace_back(1000, 0, 0);
    const Binding binding = embed(volume, points);
    const auto displacements = volume.displacements(pose);
    const auto moved = displaced_points(volume, binding, points, displacements);
    const auto gradients = deformation_gradients(volume, binding, displacements);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      EXPECT_LT(glm::distance(moved[i], A * points[i] + b), 1e-13) << family.name;
      for (int column = 0; column < 3; ++column) {
        EXPECT_LT(glm::distance(gradients[i][column], A[column]), 1e-9) << family.name;
      }
    }
    EXPECT_EQ(moved.back(), points.back());
    EXPECT_EQ(gradients.back(), glm::dmat3(1));
  }
}

TEST(Displace, follows_a_tricubic_volume) {
  const Volume volume = tricubic_volume(0.15);
  const std::vector<glm::dvec3> points = points_inside(volume, 5000, 22);
  const Binding binding = embed(volume, points);
  EXPECT_EQ(displaced_points(volume, binding, points, volume.displacements(volume.rest_controls())),
            points);
  std::vector<glm::dvec3> pose(volume.rest_controls().begin(), volume.rest_controls().end());
  pose = test::jittered(std::move(pose), 0.2, 4);
  const auto displacements = volume.displacements(pose);
  const auto moved = displaced_points(volume, binding, points, displacements);
  const std::vector<glm::dvec3> posed = volume.points(pose);
  for (std::size_t i = 0; i < binding.points.size(); ++i) {
    const glm::dvec3 expected = held_value(volume, binding, i, posed);
    ASSERT_LT(glm::distance(moved[static_cast<std::size_t>(binding.points[i])], expected), 2e-14);
  }
}

TEST(Displace, leaves_the_bits_of_points_in_patches_that_do_not_move) {
  const Volume volume =
      test::spline_volume({6, 1, 1}, test::jittered(test::grid_points({6, 1, 1}), 0.05, 3));
  const std::vector<glm::dvec3> points = points_inside(volume, 3000, 23);
  const Binding binding = embed(volume, points);
  std::vector<glm::dvec3> pose(volume.rest_controls().begin(), volume.rest_controls().end());
  pose[0] += glm::dvec3(0.1, 0.2, 0.3);
  const auto moved = displaced_points(volume, binding, points, volume.displacements(pose));
  const auto gradients = deformation_gradients(volume, binding, volume.displacements(pose));
  for (std::size_t i = 0; i < binding.points.size(); ++i) {
    const auto point = static_cast<std::size_t>(binding.points[i]);
    if (binding.patches[i] >= 2) {
      EXPECT_EQ(moved[point], points[point]);
      EXPECT_EQ(gradients[point], glm::dmat3(1));
    }
  }
  EXPECT_NE(moved, points);
}

TEST(Displace, gives_the_same_bits_with_one_thread_and_with_four) {
  const Volume volume = tricubic_volume(0.15);
  const std::vector<glm::dvec3> points = points_inside(volume, 30000, 24);
  const Binding binding = embed(volume, points);
  std::vector<glm::dvec3> pose(volume.rest_controls().begin(), volume.rest_controls().end());
  const auto displacements = volume.displacements(test::jittered(std::move(pose), 0.2, 4));
  set_thread_count(1);
  const auto one = displaced_points(volume, binding, points, displacements);
  const auto one_gradients = deformation_gradients(volume, binding, displacements);
  set_thread_count(4);
  EXPECT_EQ(displaced_points(volume, binding, points, displacements), one);
  EXPECT_EQ(deformation_gradients(volume, binding, displacements), one_gradients);
  set_thread_count(0);
}

TEST(Displace, gradient_is_the_difference_quotient_inside_a_leaf) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_uniform(family.lattice, 1);
    const auto displacements = volume.displacements(test::jittered(family.lattice.rest, 0.1, 2));
    for (std::size_t patch = 0; patch < volume.n_patches(); ++patch) {
      const BezierPatch rest = volume.bezier(patch, volume.rest_points());
      const glm::dvec3 x = rest.value({0.4, 0.3, 0.45});
      const double h = 1e-5 * volume.diagonal();
      std::vector<glm::dvec3> points = {x};
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0);
        step[axis] = h;
        points.insert(points.end(), {x - step, x + step});
      }
      const Binding binding = embed(volume, points);
      const auto moved = displaced_points(volume, binding, points, displacements);
      const auto gradients = deformation_gradients(volume, binding, displacements);
      for (int axis = 0; axis < 3; ++axis) {
        const auto before = static_cast<std::size_t>(1 + 2 * axis);
        const glm::dvec3 quotient = (moved[before + 1] - moved[before]) / (2 * h);
        EXPECT_LT(glm::distance(gradients[0][axis], quotient), 1e-6) << family.name;
      }
    }
  }
}

TEST(TurnedNormal, is_the_normal_of_the_moved_plane_and_survives_a_singular_map) {
  const glm::dmat3 J(1, 0.2, 0, 0.5, 2, 0.1, 0, 0.3, 0.7);
  const glm::dvec3 a(1, 2, 0);
  const glm::dvec3 b(0, 1, -1);
  const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
  const glm::dvec3 expected = glm::normalize(glm::cross(J * a, J * b));
  EXPECT_LT(glm::distance(turned_normal(J, normal), expected), 1e-15);
  const glm::dmat3 flat(1, 0, 0, 0, 1, 0, 0, 0, 0);
  EXPECT_EQ(turned_normal(flat, {0, 0, 1}), glm::dvec3(0, 0, 1));
  EXPECT_EQ(turned_normal(flat, {1, 0, 0}), glm::dvec3(0));
}

}  // namespace
}  // namespace espalier
