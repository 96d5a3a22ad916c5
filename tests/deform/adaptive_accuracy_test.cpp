/// How exact adaptive volumes are, measured at points all over them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "lattice/build/primitives.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/accuracy.h"
#include "tests/support/families.h"
#include "tests/support/places.h"

namespace espalier {
namespace {

/// The mean length of the edges: the size of a cell.
double cell_size(const SubdivisionLattice& lattice) {
  double sum = 0;
  for (const EdgeId edge : lattice.complex->edges()) {
    const auto ends = lattice.complex->vertices(edge);
    sum += glm::distance(lattice.rest[ends[0].index()], lattice.rest[ends[1].index()]);
  }
  return sum / static_cast<double>(lattice.complex->n_edges());
}

/// Every control point moved by up to half a cell a coordinate.
std::vector<glm::dvec3> posed(const SubdivisionLattice& lattice) {
  return test::jittered(lattice.rest, 0.5 * cell_size(lattice), 3);
}

/// The errors of volumes of some tolerance, at points of a far finer one.
class Accuracy {
 public:
  Accuracy(const SubdivisionLattice& lattice, const AdaptiveOptions& exact, std::size_t n_points)
      : lattice_(lattice), pose_(posed(lattice)) {
    const Volume volume = freeze_adaptive(lattice, exact);
    points_ = test::points_inside(volume, n_points, 31);
    expected_ = test::motion(volume, points_, pose_);
  }
  /// Positions relative to the diagonal.
  [[nodiscard]] test::Difference of(const Volume& volume) const {
    const test::Motion moved = test::motion(volume, points_, pose_);
    EXPECT_EQ(std::count(moved.status.begin(), moved.status.end(), PointStatus::Unconverged), 0);
    test::Difference result = test::difference(moved, expected_);
    result.position /= volume.diagonal();
    return result;
  }

 private:
  const SubdivisionLattice& lattice_;
  std::vector<glm::dvec3> pose_;
  std::vector<glm::dvec3> points_;
  test::Motion expected_;
};

TEST(AdaptiveAccuracy, stays_within_the_tolerance_over_extruded_lattices) {
  for (const test::Section& section : test::irregular_sections()) {
    const SubdivisionLattice lattice = test::prism(section, 1);
    const Accuracy accuracy(lattice, {.tolerance = 1e-7}, 1000);
    // Where several cells meet at a smooth boundary the derivative converges slowly, or not at all.
    const bool is_fan = section.name.starts_with("half disk") || section.name == "L";
    for (const double tolerance : {1e-3, 1e-5}) {
      const test::Difference error = accuracy.of(freeze_adaptive(
          lattice, {.tolerance = tolerance, .gradient_tolerance = 100 * tolerance}));
      EXPECT_EQ(error.n_points, 1000u) << section.name << " " << tolerance;
      EXPECT_LT(error.position, tolerance) << section.name;
      EXPECT_LT(error.gradient, is_fan ? 0.5 : 100 * tolerance) << section.name << " " << tolerance;
    }
  }
}

TEST(AdaptiveAccuracy, of_derivatives_is_within_a_tolerance_of_their_own) {
  for (const int valence : {3, 5, 6, 7}) {
    const SubdivisionLattice lattice = test::prism(test::flower_section(valence), 1);
    for (const double tolerance : {1e-3, valence < 7 ? 1e-5 : 1e-4}) {
      const Accuracy accuracy(lattice,
                              {.tolerance = tolerance, .gradient_tolerance = tolerance / 20}, 500);
      const Volume volume =
          freeze_adaptive(lattice, {.tolerance = tolerance, .gradient_tolerance = tolerance});
      const test::Difference error = accuracy.of(volume);
      EXPECT_LT(error.position, tolerance) << valence;
      EXPECT_LT(error.gradient, tolerance) << valence;
      EXPECT_GT(error.gradient, tolerance / 1000) << valence;
      EXPECT_EQ(volume.gradient_error(), 0) << valence;
    }
  }
}

TEST(AdaptiveAccuracy, of_derivatives_is_told_where_it_is_missed) {
  const AdaptiveOptions options = {.tolerance = 1e-3, .gradient_tolerance = 1e-9};
  const Volume line = freeze_adaptive(test::prism(test::flower_section(8), 1), options);
  EXPECT_GT(line.gradient_error(), 1e-6);
  EXPECT_LT(line.gradient_error(), 1e-3);
  const Volume node = freeze_adaptive(test::six_tetrahedra(), options);
  EXPECT_GT(node.gradient_error(), 1e-2);
  EXPECT_EQ(freeze_adaptive(test::prism(test::grid_section(2, 2), 1), options).gradient_error(), 0);
}

TEST(AdaptiveAccuracy, of_derivatives_is_no_worse_far_from_the_origin) {
  SubdivisionLattice lattice = test::prism(test::flower_section(5), 1);
  for (glm::dvec3& point : lattice.rest) {
    point += glm::dvec3(1e7, 0, 0);
  }
  const AdaptiveOptions options = {.tolerance = 1e-3, .gradient_tolerance = 1e-6};
  const Volume volume = freeze_adaptive(lattice, options);
  const std::vector<glm::dvec3> pose = posed(lattice);
  const std::vector<glm::dvec3> points = test::points_inside(volume, 500, 31);
  SubdivisionLattice near = lattice;
  for (glm::dvec3& point : near.rest) {
    point -= glm::dvec3(1e7, 0, 0);
  }
  const Volume exact = freeze_adaptive(near, options);
  std::vector<glm::dvec3> near_points = points;
  std::vector<glm::dvec3> near_pose = pose;
  for (auto* moved : {&near_points, &near_pose}) {
    for (glm::dvec3& point : *moved) {
      point -= glm::dvec3(1e7, 0, 0);
    }
  }
  test::Motion there = test::motion(volume, points, pose);
  for (glm::dvec3& point : there.points) {
    point -= glm::dvec3(1e7, 0, 0);
  }
  const test::Difference error =
      test::difference(there, test::motion(exact, near_points, near_pose));
  EXPECT_GT(error.n_points, 400u);
  EXPECT_LT(error.gradient, 20 * volume.gradient_error());
}

TEST(AdaptiveAccuracy, stays_within_the_tolerance_at_nodes_and_other_cells) {
  std::vector<test::NamedLattice> lattices;
  lattices.push_back(
      {"MacCracken-Joy prism", test::prism(test::flower_section(5), 1, Scheme::MacCrackenJoy)});
  lattices.push_back({"pyramid on a cube", test::pyramid_on_cube()});
  lattices.push_back({"six tetrahedra", test::six_tetrahedra()});
  lattices.push_back({"tetrahedron", test::tetrahedron()});
  for (const auto& [name, lattice] : lattices) {
    const Accuracy accuracy(lattice, {.tolerance = 1e-6, .most_levels = 6}, 1000);
    for (const double tolerance : {3e-2, 3e-3}) {
      const test::Difference error =
          accuracy.of(freeze_adaptive(lattice, {.tolerance = tolerance}));
      EXPECT_GE(error.n_points, 980u) << name;  // the boundary is only as exact as the leaves
      EXPECT_LT(error.position, tolerance) << name;
      EXPECT_LT(error.gradient, 0.6) << name;
    }
  }
}

/// The largest jumps of x' and of ∂x'/∂x between points just beside the patches' inner faces.
test::Difference jumps(const SubdivisionLattice& lattice, const Volume& volume, std::size_t n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const double step = 1e-9 * volume.diagonal();
  std::vector<glm::dvec3> points;
  for (std::size_t tries = 0; tries < 20 * n && points.size() < 2 * n; ++tries) {
    const std::size_t i = random() % volume.n_patches();
    const auto face = static_cast<int>(random() % (volume.patch(i).is_pyramid ? 5 : 6));
    if (volume.patch(i).is_on_boundary(face)) {
      continue;
    }
    glm::dvec3 uvw(unit(random), unit(random), 0.95 * unit(random));
    uvw[face / 2] = face % 2;
    const BezierPatch patch = volume.bezier(i, volume.rest_points());
    const glm::dmat3 J = patch.derivative(uvw);
    const glm::dvec3 normal =
        glm::normalize(glm::cross(J[(face / 2 + 1) % 3], J[(face / 2 + 2) % 3]));
    points.push_back(patch.value(uvw) - step * normal);
    points.push_back(patch.value(uvw) + step * normal);
  }
  const test::Motion moved = test::motion(volume, points, posed(lattice));
  test::Difference result;
  for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
    if (moved.status[i] == PointStatus::Outside || moved.status[i + 1] == PointStatus::Outside) {
      continue;
    }
    ++result.n_points;
    const glm::dvec3 jump =
        moved.points[i + 1] - moved.points[i] - moved.gradients[i] * (points[i + 1] - points[i]);
    result.position = std::max(result.position, glm::length(jump) / volume.diagonal());
    result.gradient =
        std::max(result.gradient, test::distance(moved.gradients[i], moved.gradients[i + 1]));
  }
  return result;
}

TEST(AdaptiveAccuracy, jumps_across_borders_of_patches_by_no_more_than_the_tolerance) {
  constexpr double kTolerance = 1e-3;
  for (const test::NamedLattice& family : test::lattice_families()) {
    if (family.name == "plus of cubes") {
      continue;  // folds at its concave corners: places there have several images
    }
    const Volume volume = freeze_adaptive(
        family.lattice, {.tolerance = kTolerance, .gradient_tolerance = 100 * kTolerance});
    const test::Difference jump = jumps(family.lattice, volume, 500);
    if (volume.n_patches() > 1) {
      EXPECT_GT(jump.n_points, 200u) << family.name;
    }
    EXPECT_LT(jump.position, kTolerance) << family.name;
    const bool has_limit = volume.gradient_error() == 0 &&
                           family.name != "prism over half disk 5" &&
                           family.name != "pyramid on a cube" && family.name != "creased";
    EXPECT_LT(jump.gradient, has_limit ? 100 * kTolerance : 1) << family.name;
    if (family.name == "box") {
      EXPECT_LT(jump.position, 1e-15);
      EXPECT_LT(jump.gradient, 1e-7);
    }
  }
}

TEST(AdaptiveAccuracy, takes_few_bytes_and_linearly_many_patches_for_its_digits) {
  CylinderOptions options;
  options.sectors = 5;
  options.layers = 3;
  const SubdivisionLattice cylinder = test::lattice_from(make_cylinder(options));
  const Accuracy accuracy(cylinder, {.tolerance = 1e-8}, 3000);
  const Volume adaptive = freeze_adaptive(cylinder, {.tolerance = 1e-5});
  const double wanted = accuracy.of(adaptive).position;
  EXPECT_LT(wanted, 1e-5);
  // Uniform errors fall by at most four a level, so the levels still missing are no fewer.
  const Volume uniform = freeze_uniform(cylinder, 3);
  const double coarser = accuracy.of(freeze_uniform(cylinder, 2)).position;
  const double error = accuracy.of(uniform).position;
  EXPECT_LT(coarser / error, 4.5);
  const double more_levels = std::log(error / wanted) / std::log(4.0);
  EXPECT_GT(static_cast<double>(uniform.bytes()) * std::pow(8, more_levels),
            500 * static_cast<double>(adaptive.bytes()));
}

TEST(AdaptiveAccuracy, is_what_uniform_refinement_approaches_by_four_a_level) {
  const SubdivisionLattice lattice = test::prism(test::flower_section(5), 1);
  const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.2, 3);
  const Volume exact = freeze_adaptive(lattice, {.tolerance = 1e-7});
  // Away from the boundary, where refined lattices do not reach the limit's points yet.
  std::vector<glm::dvec3> points = test::points_inside(exact, 1500, 31);
  std::erase_if(points, [](const glm::dvec3& p) {
    return glm::length(glm::dvec2(p)) > 1 || std::abs(p.z - 0.5) > 0.3;
  });
  ASSERT_GT(points.size(), 100u);
  const test::Motion expected = test::motion(exact, points, pose);
  double before = 0;
  for (const int levels : {2, 3, 4}) {
    const Volume uniform = freeze_uniform(lattice, levels);
    const double error = test::difference(test::motion(uniform, points, pose), expected).position;
    if (levels > 2) {
      EXPECT_NEAR(before / error, 4, 1.2) << levels;
    }
    before = error;
  }
}

}  // namespace
}  // namespace espalier
