#include "lattice/volume/stencil_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <random>
#include <string>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/subdivision/refine.h"
#include "tests/support/allocations.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// The vertices of a refined lattice, over its own.
StencilTable refined_vertices(const SubdivisionLattice& lattice, int levels = 2) {
  const Sharpness sharpness = with_touching_elements(*lattice.complex, lattice.sharpness);
  const Refinement finer = refine(*lattice.complex, sharpness, lattice.scheme);
  return levels == 1 ? finer.stencils
                     : compose(finer.stencils, refined_vertices(refined(lattice, 1), levels - 1));
}

/// Rows of 0 to 11 weights anywhere: no two alike.
StencilTable random_table(std::size_t n_rows, std::size_t n_controls) {
  return StencilTable::build(n_rows, n_controls, [&](std::size_t i, StencilRow& row) {
    std::mt19937 random(static_cast<unsigned>(i));
    for (std::size_t k = 0; k < i % 12; ++k) {
      row.add(static_cast<std::int32_t>(random() % n_controls),
              static_cast<double>(random() % 2001) / 1000 - 1);
    }
  });
}

template <class Real>
std::vector<glm::vec<3, Real>> some_points(std::size_t n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> place(-1, 1);
  std::vector<glm::vec<3, Real>> points(n);
  for (auto& point : points) {
    point = {place(random), place(random), place(random)};
  }
  return points;
}

template <class Real>
std::vector<glm::vec<3, Real>> applied(const StencilBlocks<Real>& blocks,
                                       const std::vector<glm::vec<3, Real>>& controls) {
  std::vector<glm::vec<3, Real>> points(blocks.n_rows());
  blocks.apply(controls, points);
  return points;
}

template <class T>
bool are_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

class StencilBlocksOnEverySet : public testing::TestWithParam<InstructionSet> {};

TEST_P(StencilBlocksOnEverySet, have_the_bits_of_the_table_in_double) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const StencilTable table = refined_vertices(family.lattice);
    const auto controls = some_points<double>(table.n_controls());
    const StencilBlocks<double> blocks(table, GetParam());
    EXPECT_TRUE(are_same_bits(applied(blocks, controls), table.apply(controls))) << family.name;
  }
  const StencilTable table = random_table(1000, 50);
  const auto controls = some_points<double>(50);
  EXPECT_TRUE(are_same_bits(applied(StencilBlocks<double>(table, GetParam()), controls),
                            table.apply(controls)));
}

TEST_P(StencilBlocksOnEverySet, equal_the_table_in_float) {
  std::vector<StencilTable> tables = {random_table(1000, 50)};
  for (const test::NamedLattice& family : test::lattice_families()) {
    tables.push_back(refined_vertices(family.lattice));
  }
  for (const StencilTable& table : tables) {
    const auto controls = some_points<float>(table.n_controls());
    const std::vector<glm::dvec3> exact(controls.begin(), controls.end());
    const auto expected = table.apply(exact);
    const auto points = applied(StencilBlocks<float>(table, GetParam()), controls);
    for (std::size_t i = 0; i < points.size(); ++i) {
      glm::dvec3 bound(0);
      for (std::size_t k = 0; k < table[i].indices.size(); ++k) {
        bound += std::abs(table[i].weights[k]) *
                 glm::abs(exact[static_cast<std::size_t>(table[i].indices[k])]);
      }
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(std::abs(points[i][axis] - expected[i][axis]), 1e-6 * bound[axis]) << i;
      }
    }
  }
}

TEST_P(StencilBlocksOnEverySet, leave_zeros_and_unreached_rows_at_positive_zero) {
  const StencilTable table = refined_vertices(test::prism(test::o_grid_section(), 3));
  std::vector<glm::vec3> controls(table.n_controls(), glm::vec3(0));
  const StencilBlocks<float> blocks(table, GetParam());
  EXPECT_TRUE(are_same_bits(applied(blocks, controls),
                            std::vector<glm::vec3>(table.n_rows(), glm::vec3(0))));
  controls[0] = glm::vec3(-1, 2, -3);
  const auto points = applied(blocks, controls);
  std::size_t n_unreached = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (table[i].indices.empty() || table[i].indices[0] != 0) {
      const glm::vec3 zero(0);
      EXPECT_EQ(std::memcmp(&points[i], &zero, sizeof zero), 0) << i;
      ++n_unreached;
    }
  }
  EXPECT_GT(n_unreached, points.size() / 2);
  EXPECT_LT(n_unreached, points.size());
}

TEST_P(StencilBlocksOnEverySet, have_the_same_bits_for_any_number_of_threads) {
  const StencilTable table = random_table(20000, 300);
  const auto controls = some_points<float>(300);
  set_thread_count(1);
  const auto expected = applied(StencilBlocks<float>(table, GetParam()), controls);
  for (const int threads : {2, 3, 5}) {
    set_thread_count(threads);
    EXPECT_TRUE(are_same_bits(applied(StencilBlocks<float>(table, GetParam()), controls), expected))
        << threads;
  }
  set_thread_count(0);
}

TEST_P(StencilBlocksOnEverySet, allocate_nothing_when_they_are_applied) {
  const StencilTable table = random_table(20000, 300);
  const StencilBlocks<float> blocks(table, GetParam());
  const auto controls = some_points<float>(300);
  std::vector<glm::vec3> points(table.n_rows());
  blocks.apply(controls, points);  // the threads begin
  const std::size_t before = test::n_allocations();
  blocks.apply(controls, points);
  EXPECT_EQ(test::n_allocations(), before);
}

TEST_P(StencilBlocksOnEverySet, may_be_empty) {
  EXPECT_TRUE(applied(StencilBlocks<double>(StencilTable(), GetParam()), {}).empty());
  const StencilTable no_weights = StencilTable::build(20, 3, [](std::size_t, StencilRow&) {});
  EXPECT_EQ(applied(StencilBlocks<double>(no_weights, GetParam()), some_points<double>(3)),
            std::vector<glm::dvec3>(20, glm::dvec3(0)));
}

TEST_P(StencilBlocksOnEverySet, make_the_displacements_of_a_volume_to_the_bit) {
  const SubdivisionLattice lattice = test::prism(test::o_grid_section(), 3);
  const Volume volume = freeze_uniform(lattice, 1);
  const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.3, 1);
  std::vector<glm::dvec3> moves = pose;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    moves[i] -= lattice.rest[i];
  }
  EXPECT_TRUE(are_same_bits(applied(StencilBlocks<double>(volume.stencils(), GetParam()), moves),
                            volume.displacements(pose)));
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, StencilBlocksOnEverySet,
                         testing::ValuesIn(available_instruction_sets()),
                         [](const auto& one) { return std::string(name_of(one.param)); });

TEST(StencilBlocks, multiply_hardly_more_than_the_weights_of_a_refined_lattice) {
  const StencilTable table = refined_vertices(test::prism(test::o_grid_section(), 2), 3);
  const StencilBlocks<float> blocks(table);
  EXPECT_GE(blocks.n_products(), table.n_weights());
  EXPECT_LE(blocks.n_products(), table.n_weights() * 11 / 10);
}

TEST(StencilBlocks, share_the_columns_of_rows_that_stand_far_apart) {
  // Rows i and i + 4 have the same indices: four blocks of four columns hold all 64 rows.
  const StencilTable table = StencilTable::build(64, 16, [](std::size_t i, StencilRow& row) {
    for (std::size_t k = 0; k < 4; ++k) {
      row.add(static_cast<std::int32_t>(4 * (i % 4) + k), 1.0 / static_cast<double>(i + k + 1));
    }
  });
  EXPECT_EQ(StencilBlocks<double>(table).n_products(), 64u * 4);
}

TEST(StencilBlocks, share_the_weights_of_regions_that_are_alike) {
  const auto table_of = [](std::size_t n_copies) {
    return StencilTable::build(16 * n_copies, 5 * n_copies, [](std::size_t i, StencilRow& row) {
      for (std::size_t k = 0; k < 5; ++k) {
        row.add(static_cast<std::int32_t>(i / 16 * 5 + k),
                1.0 / static_cast<double>(i % 16 + k + 1));
      }
    });
  };
  const StencilBlocks<double> one(table_of(1));
  const StencilBlocks<double> many(table_of(20));
  EXPECT_EQ(many.n_products(), 20 * one.n_products());
  EXPECT_LT(many.bytes(), one.bytes() + 20 * (16 + 5 + 3) * sizeof(std::int32_t));
  const auto controls = some_points<double>(100);
  EXPECT_TRUE(are_same_bits(applied(many, controls), table_of(20).apply(controls)));
}

TEST(StencilBlocks, refuse_other_numbers_of_points) {
  const StencilBlocks<float> blocks(random_table(30, 10));
  std::vector<glm::vec3> controls(10);
  std::vector<glm::vec3> points(30);
  EXPECT_NO_THROW(blocks.apply(controls, points));
  points.pop_back();
  EXPECT_THROW(blocks.apply(controls, points), ParameterError);
  points.resize(30);
  controls.emplace_back();
  EXPECT_THROW(blocks.apply(controls, points), ParameterError);
}

}  // namespace
}  // namespace espalier
