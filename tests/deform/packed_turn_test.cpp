#include "deform/evaluate/packed_turn.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "deform/evaluate/drag_kernels.h"

namespace espalier {
namespace {

struct Turn {
  glm::dvec3 n, m;
};

/// What the kernels make of a turn, on all lanes of a block.
template <class Real>
glm::dvec3 turned(const Turn& turn, double unit, const glm::dvec3& displacement,
                  InstructionSet set) {
  const PackedTurn<Real> packed = packed_turn<Real>(turn.n, turn.m, unit);
  std::vector<Real> rows;
  for (const Real number : {packed.x, packed.y, packed.qx, packed.qy}) {
    rows.insert(rows.end(), kDragBlock, number);
  }
  std::vector<Real> normals(3 * kDragBlock, -7);
  DragBlocks<Real> blocks;
  blocks.n_blocks = 1;
  blocks.turns = rows.data();
  blocks.normals = normals.data();
  const glm::vec<3, Real> d(displacement);
  drag_kernels<Real>(set).turn(blocks, &d.x);
  for (std::size_t i = 3; i < normals.size(); ++i) {
    EXPECT_EQ(normals[i], normals[i - 3]);
  }
  return {normals[0], normals[1], normals[2]};
}

class PackedTurnOn : public testing::TestWithParam<InstructionSet> {
 protected:
  /// Within a few roundings of the direction, magnified by the length of what was added.
  void expect_turns(const Turn& turn, const glm::dvec3& displacement) const {
    const glm::dvec3 by = glm::cross(displacement, turn.m);
    const glm::dvec3 exact = turn.n + by;
    const double size = (glm::length(turn.n) + glm::length(displacement) * glm::length(turn.m)) /
                        glm::length(exact);
    const glm::dvec3 direction = glm::normalize(exact);
    EXPECT_LT(glm::length(turned<float>(turn, 1, displacement, GetParam()) - direction),
              6e-7 * size);
    EXPECT_LT(glm::length(turned<double>(turn, 1, displacement, GetParam()) - direction),
              1e-15 * size);
  }
};

TEST_P(PackedTurnOn, turns_normals_of_all_directions_as_n_plus_d_cross_m) {
  std::mt19937 random(7);
  std::normal_distribution<double> number;
  const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 n = std::exp(number(random)) * vector();
    const glm::dvec3 m = std::exp(3 * number(random)) * glm::cross(n, vector());
    expect_turns({n, m}, vector());
  }
}

TEST_P(PackedTurnOn, turns_normals_in_planes_and_along_axes) {
  const glm::dvec3 d(0.3, -0.2, 0.7);
  for (const double x : {-1.0, -0.0, 0.0, 1e-30, 1.0}) {
    for (const double y : {-1.0, -1e-9, 0.0, 2.0}) {
      for (const double z : {-1.0, -1e-9, -0.0, 0.0, 1.0}) {
        const glm::dvec3 n(x, y, z);
        if (glm::length(n) > 1e-20) {
          expect_turns({n, glm::cross(n, glm::dvec3(0.5, 1, -2))}, d);
          expect_turns({n, glm::dvec3(0)}, d);
        }
      }
    }
  }
}

TEST_P(PackedTurnOn, leaves_what_has_no_direction_without_one) {
  const Turn none = {glm::dvec3(0), glm::dvec3(0)};
  EXPECT_EQ(turned<float>(none, 1, {1, 2, 3}, GetParam()), glm::dvec3(0));
  EXPECT_EQ(turned<double>(none, 1, {1, 2, 3}, GetParam()), glm::dvec3(0));
}

TEST_P(PackedTurnOn, gives_a_collapsed_point_the_direction_of_what_opens_it) {
  for (const glm::dvec3& m : {glm::dvec3(2, 0, 0), glm::dvec3(0, -3, 1), glm::dvec3(1, 1, 1)}) {
    for (const glm::dvec3& d : {glm::dvec3(0.4, 1, -0.3), glm::dvec3(-1e12, 2e11, 3e11)}) {
      const glm::dvec3 direction = glm::normalize(glm::cross(d, m));
      EXPECT_LT(glm::length(turned<float>({glm::dvec3(0), m}, 1, d, GetParam()) - direction), 4e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, PackedTurnOn,
                         testing::Values(InstructionSet::Baseline, instruction_set()));

}  // namespace
}  // namespace espalier
