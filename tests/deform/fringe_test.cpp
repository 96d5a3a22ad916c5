#include "deform/embed/fringe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "deform/embed/boundary_face.h"
#include "deform/evaluate/displace.h"
#include "lattice/build/primitives.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

Volume unit_cube() {
  return freeze_adaptive(test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1})));
}

Binding bound(const Volume& volume, const std::vector<glm::dvec3>& points, double reach) {
  Binding binding = embed(volume, points);
  binding.fringe = make_fringe(volume, points, binding.status, reach);
  return binding;
}

/// Displacements of the volume's points for control points moved at random by about `size`.
std::vector<glm::dvec3> random_motion(const Volume& volume, double size) {
  const auto rest = volume.rest_controls();
  return volume.displacements(test::jittered({rest.begin(), rest.end()}, size, 5));
}

TEST(Falloff, is_one_at_the_border_zero_at_its_end_and_has_no_slope_at_either) {
  EXPECT_EQ(falloff(0, 2), 1);
  EXPECT_EQ(falloff(1, 2), 0.5);
  EXPECT_EQ(falloff(2, 2), 0);
  EXPECT_EQ(falloff(7, 2), 0);
  EXPECT_LT(1 - falloff(1e-6, 1), 4e-12);
  EXPECT_LT(falloff(1 - 1e-6, 1), 4e-12);
}

TEST(Fringe, finds_the_closest_point_of_faces_edges_and_corners_of_a_cube) {
  const Volume volume = unit_cube();
  const std::vector<glm::dvec3> points = {
      {1.2, 0.3, 0.4}, {1.2, 1.1, 0.4}, {1.1, -0.1, 1.2}, {0.5, 0.5, -0.25}, {0.5, 0.5, 1.5}};
  const Binding binding = bound(volume, points, 0.5);
  ASSERT_EQ(binding.fringe.points.size(), 4u);  // the last is as far as the reach
  for (std::size_t i = 0; i < 4; ++i) {
    const Fringe& fringe = binding.fringe;
    const glm::dvec3 x = points[static_cast<std::size_t>(fringe.points[i])];
    const glm::dvec3 closest = glm::clamp(x, 0.0, 1.0);
    const BezierPatch patch =
        volume.bezier(static_cast<std::size_t>(fringe.patches[i]), volume.rest_points());
    EXPECT_LT(glm::distance(patch.value(fringe.uvw[i]), closest), 1e-12);
    EXPECT_NEAR(fringe.weights[i], falloff(glm::distance(x, closest), 0.5), 1e-12);
  }
  EXPECT_EQ(binding.counts().outside, 5u);
}

TEST(Fringe, moves_points_by_the_falloff_times_the_motion_of_the_boundary) {
  const Volume volume = unit_cube();
  std::vector<glm::dvec3> pose(volume.rest_controls().begin(), volume.rest_controls().end());
  for (glm::dvec3& point : pose) {
    point += glm::dvec3(0, 4, 0);
  }
  const std::vector<glm::dvec3> points = {{1.5, 0.3, 0.4}, {0.5, 0.5, 0.5}, {3, 0, 0}};
  const auto moved =
      displaced_points(volume, bound(volume, points, 1), points, volume.displacements(pose));
  EXPECT_LT(glm::distance(moved[0], glm::dvec3(1.5, 2.3, 0.4)), 1e-12);
  EXPECT_LT(glm::distance(moved[1], glm::dvec3(0.5, 4.5, 0.5)), 1e-12);
  EXPECT_EQ(moved[2], points[2]);
}

TEST(Fringe, does_not_jump_across_the_border_of_any_family) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_uniform(family.lattice, 2);
    const double scale = volume.diagonal();
    std::vector<glm::dvec3> points;  // pairs: 1e-7 inside and 1e-7 outside
    while (points.size() < 1000) {
      const std::size_t i = random() % volume.n_patches();
      const int face = static_cast<int>(random() % 6);
      if (!volume.patch(i).is_on_boundary(face)) {
        continue;
      }
      glm::dvec3 uvw(unit(random), unit(random), unit(random));
      const BezierPatch patch = volume.bezier(i, volume.rest_points());
      uvw[face / 2] = face % 2;
      const glm::dvec3 at = patch.value(uvw);
      const glm::dmat3 slope = patch.derivative(uvw);
      const glm::dvec3 normal =
          glm::normalize(glm::cross(slope[(face / 2 + 1) % 3], slope[(face / 2 + 2) % 3]) *
                         (face % 2 == 0 ? -1.0 : 1.0));
      points.push_back(at - 1e-7 * scale * normal);
      points.push_back(at + 1e-7 * scale * normal);
    }
    const Binding binding = bound(volume, points, 0.2 * scale);
    const auto moves = point_displacements(volume, binding, random_motion(volume, 0.1 * scale));
    double largest = 0;
    std::size_t n_across = 0;
    for (std::size_t i = 0; i < points.size(); i += 2) {
      if (binding.status[i] == PointStatus::Inside &&
          binding.status[i + 1] == PointStatus::Outside) {
        ++n_across;
        largest = std::max(largest, glm::distance(moves[i], moves[i + 1]));
      }
    }
    EXPECT_GT(n_across, 300u) << family.name;
    EXPECT_LT(largest, 1e-5 * scale) << family.name;
    RecordProperty(family.name, std::to_string(largest / scale));
  }
}

TEST(Fringe, gradient_is_the_difference_quotient) {
  const SubdivisionLattice lattice = test::prism(test::flower_section(5), 2);
  const Volume volume = freeze_adaptive(lattice);
  const auto displacements = random_motion(volume, 0.2);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  const double reach = 0.4;
  const double h = 1e-6;
  const std::vector<Box> boxes = volume.patch_boxes();
  Box all;
  for (const Box& box : boxes) {
    all.add(box);
  }
  all = all.grown(reach);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 x =
        all.min + (all.max - all.min) * glm::dvec3(unit(random), unit(random), unit(random));
    points.push_back(x);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0);
      step[axis] = h;
      points.insert(points.end(), {x - step, x + step});
    }
  }
  const Binding binding = bound(volume, points, reach);
  const auto moves = point_displacements(volume, binding, displacements);
  const auto gradients = deformation_gradients(volume, binding, displacements);
  int n_compared = 0;
  int n_different = 0;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    if (binding.status[i] != PointStatus::Outside || moves[i] == glm::dvec3(0)) {
      continue;
    }
    ++n_compared;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const glm::dvec3 quotient = (moves[i + 2 + 2 * axis] - moves[i + 1 + 2 * axis]) / (2 * h);
      glm::dvec3 expected = gradients[i][static_cast<int>(axis)];
      expected[static_cast<int>(axis)] -= 1;
      n_different += glm::distance(quotient, expected) > 1e-4 ? 1 : 0;
    }
  }
  EXPECT_GT(n_compared, 60);
  EXPECT_EQ(n_different, 0);
}

TEST(Fringe, is_the_same_with_one_thread_and_with_four) {
  const Volume volume = unit_cube();
  const std::vector<glm::dvec3> points =
      test::jittered(std::vector<glm::dvec3>(3000, glm::dvec3(0.5)), 1.0, 2);
  set_thread_count(1);
  const Fringe one = bound(volume, points, 0.3).fringe;
  set_thread_count(4);
  const Fringe four = bound(volume, points, 0.3).fringe;
  set_thread_count(0);
  EXPECT_GT(one.points.size(), 500u);
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.patches, four.patches);
  EXPECT_EQ(one.uvw, four.uvw);
  EXPECT_EQ(one.weights, four.weights);
  EXPECT_EQ(one.uvw_slopes, four.uvw_slopes);
}

TEST(BoundaryFace, closest_point_is_that_of_a_dense_search) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_adaptive(family.lattice, {.tolerance = 1e-2});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int n = 0; n < 8;) {
      const std::size_t i = random() % volume.n_patches();
      const int face = static_cast<int>(random() % 6);
      if (!volume.patch(i).is_on_boundary(face)) {
        continue;
      }
      ++n;
      const BezierPatch patch = volume.bezier(i, volume.rest_points());
      const BoundaryFace surface(patch, face);
      const glm::dvec3 x =
          surface.hull_box().center() +
          surface.hull_box().radius() * glm::dvec3(unit(random), unit(random), unit(random));
      const auto found = surface.closest(x);
      EXPECT_LT(glm::distance(patch.value(surface.uvw(found.st)), found.point), 1e-12);
      for (int s = 0; s <= 25; ++s) {
        for (int t = 0; t <= 25; ++t) {
          const glm::dvec3 at = patch.value(surface.uvw(glm::dvec2(s, t) / 25.0));
          ASSERT_LE(found.distance, glm::distance(at, x) + 1e-9 * volume.diagonal())
              << family.name << " patch " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace espalier
