/// How exact adaptive volumes are, measured at points all over them.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "deform/embed/embed.h"
#include "deform/evaluate/displace.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// Where points go with a posed lattice frozen in some way.
std::vector<glm::dvec3> moved(const Volume& volume, const std::vector<glm::dvec3>& points,
                              const std::vector<glm::dvec3>& pose) {
  const Binding binding = embed(volume, points);
  EXPECT_EQ(binding.counts().unconverged, 0u);
  return displaced_points(volume, binding, points, volume.displacements(pose));
}

/// Points well inside: middles of random patches of a fine volume.
std::vector<glm::dvec3> points_inside(const Volume& volume, std::size_t n) {
  std::mt19937 random(31);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const BezierPatch patch = volume.bezier(random() % volume.n_patches(), volume.rest_points());
    points.push_back(patch.value({0.5, 0.4, 0.6}));
  }
  return points;
}

double largest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, glm::distance(a[i], b[i]));
  }
  return largest;
}

TEST(AdaptiveAccuracy, stays_within_the_tolerance_over_extruded_lattices) {
  for (const test::Section& section : test::irregular_sections()) {
    const SubdivisionLattice lattice = test::prism(section, 2);
    const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.2, 3);
    const Volume exact = freeze_adaptive(lattice, {.tolerance = 1e-9});
    const std::vector<glm::dvec3> points = points_inside(exact, 1000);
    const auto expected = moved(exact, points, pose);
    for (const double tolerance : {1e-3, 1e-5}) {
      const Volume volume = freeze_adaptive(lattice, {.tolerance = tolerance});
      EXPECT_LT(largest_distance(moved(volume, points, pose), expected),
                tolerance * volume.diagonal())
          << section.name << " " << tolerance;
    }
  }
}

TEST(AdaptiveAccuracy, is_what_uniform_refinement_approaches_by_four_a_level) {
  const SubdivisionLattice lattice = test::prism(test::flower_section(5), 2);
  const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.2, 3);
  const Volume exact = freeze_adaptive(lattice, {.tolerance = 1e-9});
  // Away from the boundary, where refined lattices do not reach the limit's points yet.
  std::vector<glm::dvec3> points = points_inside(exact, 1000);
  std::erase_if(points, [](const glm::dvec3& p) {
    return glm::length(glm::dvec2(p)) > 1 || std::abs(p.z - 1) > 0.7;
  });
  ASSERT_GT(points.size(), 100u);
  const auto expected = moved(exact, points, pose);
  double before = 0;
  for (const int levels : {2, 3, 4}) {
    const double error =
        largest_distance(moved(freeze_uniform(lattice, levels), points, pose), expected);
    if (levels > 2) {
      EXPECT_NEAR(before / error, 4, 1.2) << levels;
    }
    before = error;
  }
}

}  // namespace
}  // namespace espalier
