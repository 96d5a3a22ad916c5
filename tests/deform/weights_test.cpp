#include "deform/evaluate/weights.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "deform/evaluate/displace.h"
#include "lattice/core/box.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// Random points in and round the lattice's box.
std::vector<glm::dvec3> points_round(const SubdivisionLattice& lattice, std::size_t n) {
  const Box box = box_of(lattice.rest);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.2, 1.2);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 t(place(random), place(random), place(random));
    points.push_back(box.min + t * (box.max - box.min));
  }
  return points;
}

std::vector<Volume> volumes_of(const SubdivisionLattice& lattice) {
  std::vector<Volume> volumes;
  volumes.push_back(freeze_uniform(lattice, 1));
  volumes.push_back(freeze_adaptive(lattice, {.tolerance = 1e-2, .most_levels = 2}));
  return volumes;
}

bool is_held(PointStatus status, const StencilTable::Row& row) {
  return status == PointStatus::Inside || (status == PointStatus::Border && !row.indices.empty());
}

TEST(ControlWeights, rows_sum_to_one_inside_and_are_empty_outside) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const auto points = points_round(family.lattice, 300);
    for (const Volume& volume : volumes_of(family.lattice)) {
      const Binding binding = embed(volume, points);
      const StencilTable weights = control_weights(volume, binding);
      ASSERT_EQ(weights.n_rows(), points.size());
      ASSERT_EQ(weights.n_controls(), family.lattice.rest.size());
      EXPECT_GT(binding.counts().inside, 0u) << family.name;
      EXPECT_GT(binding.counts().outside, 0u) << family.name;
      for (std::size_t i = 0; i < points.size(); ++i) {
        double sum = 0;
        for (const double weight : weights[i].weights) {
          EXPECT_NE(weight, 0);
          sum += weight;
        }
        EXPECT_NEAR(sum, is_held(binding.status[i], weights[i]) ? 1 : 0, 1e-13) << family.name;
      }
    }
  }
}

TEST(ControlWeights, give_the_displacements_of_random_poses) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const auto points = points_round(family.lattice, 300);
    for (const Volume& volume : volumes_of(family.lattice)) {
      const Binding binding = embed(volume, points);
      const StencilTable weights = control_weights(volume, binding);
      for (const unsigned seed : {1u, 2u}) {
        const auto pose = test::jittered(family.lattice.rest, 0.5, seed);
        std::vector<glm::dvec3> moves = pose;
        for (std::size_t i = 0; i < moves.size(); ++i) {
          moves[i] -= family.lattice.rest[i];
        }
        const auto expected = displaced_points(volume, binding, points, volume.displacements(pose));
        const auto moved = weights.apply(moves);
        for (std::size_t i = 0; i < points.size(); ++i) {
          EXPECT_LT(glm::distance(points[i] + moved[i], expected[i]), 1e-12 * volume.diagonal())
              << family.name << " point " << i;
        }
      }
    }
  }
}

TEST(ControlWeights, of_the_middle_of_a_regular_cell_are_products_of_the_cubic_b_spline) {
  const SubdivisionLattice lattice = test::prism(test::grid_section(3, 3), 3);
  const Volume volume = freeze_adaptive(lattice);
  const Binding binding = embed(volume, std::vector<glm::dvec3>{{1.5, 1.5, 1.5}});
  const StencilTable weights = control_weights(volume, binding);
  ASSERT_EQ(weights[0].indices.size(), 64u);
  const double spline[] = {1. / 48, 23. / 48, 23. / 48, 1. / 48};
  for (std::size_t k = 0; k < 64; ++k) {
    const glm::dvec3& p = lattice.rest[static_cast<std::size_t>(weights[0].indices[k])];
    EXPECT_NEAR(weights[0].weights[k],
                spline[static_cast<int>(p.x)] * spline[static_cast<int>(p.y)] *
                    spline[static_cast<int>(p.z)],
                1e-15);
  }
}

TEST(ControlWeights, leave_out_control_points_without_influence) {
  const SubdivisionLattice lattice = test::prism(test::grid_section(3, 3), 3);
  const Volume volume = freeze_uniform(lattice, 1);
  const Binding binding = embed(volume, std::vector<glm::dvec3>{{0, 0, 0}, {9, 9, 9}});
  const StencilTable weights = control_weights(volume, binding);
  ASSERT_EQ(weights[0].indices.size(), 1u);  // a corner stays at its control point
  EXPECT_EQ(lattice.rest[static_cast<std::size_t>(weights[0].indices[0])], glm::dvec3(0));
  EXPECT_EQ(weights[0].weights[0], 1);
  EXPECT_TRUE(weights[1].indices.empty());
  EXPECT_EQ(weights.n_weights(), 1u);
}

TEST(ControlWeights, are_the_same_bits_for_any_number_of_threads) {
  const SubdivisionLattice lattice = test::prism(test::flower_section(5), 3);
  const Volume volume = freeze_adaptive(lattice, {.tolerance = 1e-3});
  const Binding binding = embed(volume, points_round(lattice, 5000));
  set_thread_count(1);
  const StencilTable one = control_weights(volume, binding);
  set_thread_count(4);
  const StencilTable four = control_weights(volume, binding);
  set_thread_count(0);
  ASSERT_EQ(one.n_weights(), four.n_weights());
  for (std::size_t i = 0; i < one.n_rows(); ++i) {
    ASSERT_TRUE(std::equal(one[i].weights.begin(), one[i].weights.end(), four[i].weights.begin(),
                           four[i].weights.end()));
    ASSERT_TRUE(std::equal(one[i].indices.begin(), one[i].indices.end(), four[i].indices.begin(),
                           four[i].indices.end()));
  }
}

}  // namespace
}  // namespace espalier
