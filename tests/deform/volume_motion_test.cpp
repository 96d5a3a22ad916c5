#include "deform/evaluate/volume_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr glm::dvec3 kZero(0);

TEST(VolumeMotion, begins_at_rest_unchanged) {
  const VolumeMotion<float> motion(3);
  const std::vector<std::int32_t> all = {0, 1, 2};
  EXPECT_FALSE(motion.is_any_moved(all));
  EXPECT_FALSE(motion.has_any_changed(all));
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(motion.values()[i], 0);
  }
}

TEST(VolumeMotion, knows_which_points_are_moved_and_which_changed_last) {
  VolumeMotion<double> motion(3);
  motion.set(std::vector<glm::dvec3>{{0, 0, 1}, kZero, {2, 0, 0}});
  EXPECT_TRUE(motion.has_any_changed(std::vector{0}));
  EXPECT_FALSE(motion.has_any_changed(std::vector{1}));
  motion.set(std::vector<glm::dvec3>{{0, 0, 1}, {0, -1, 0}, kZero});
  EXPECT_TRUE(motion.is_any_moved(std::vector{0}));
  EXPECT_FALSE(motion.has_any_changed(std::vector{0}));
  EXPECT_TRUE(motion.is_any_moved(std::vector{1}));
  EXPECT_TRUE(motion.has_any_changed(std::vector{1}));
  EXPECT_FALSE(motion.is_any_moved(std::vector{2}));
  EXPECT_TRUE(motion.has_any_changed(std::vector{2}));
  EXPECT_TRUE(motion.has_any_changed(std::vector{0, 2}));
}

TEST(VolumeMotion, made_from_displacements_has_changed_from_rest) {
  const VolumeMotion<double> motion(std::vector<glm::dvec3>{kZero, {1, 0, 0}});
  EXPECT_FALSE(motion.has_any_changed(std::vector{0}));
  EXPECT_TRUE(motion.has_any_changed(std::vector{1}));
}

TEST(VolumeMotion, holds_rest_minus_moved_in_fours_and_positive_zeros) {
  const VolumeMotion<float> motion(std::vector<glm::dvec3>{{0.1, -0.0, -2}, {0, 0, 0}});
  const float expected[8] = {-0.1F, 0, 2, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(motion.values()[i], expected[i]) << i;
    EXPECT_EQ(std::signbit(motion.values()[i]), i == 0) << i;
  }
  EXPECT_EQ(motion.displacements()[0], glm::dvec3(0.1, 0, -2));
}

TEST(VolumeMotion, refuses_another_number_of_displacements_and_keeps_the_frame) {
  VolumeMotion<double> motion(std::vector<glm::dvec3>{{1, 2, 3}});
  try {
    motion.set(std::vector<glm::dvec3>(2));
    FAIL() << "nothing thrown";
  } catch (const ParameterError& error) {
    EXPECT_EQ(std::string(error.what()), "2 displacements given for a volume of 1 points");
  }
  EXPECT_EQ(motion.displacements()[0], glm::dvec3(1, 2, 3));
}

}  // namespace
}  // namespace espalier
