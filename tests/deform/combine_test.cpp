#include "deform/evaluate/combine.h"

#include <gtest/gtest.h>

#include <limits>

#include "deform/evaluate/displace.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

const std::vector<glm::dvec3> kPoints = {{0.25, 0.5, 0.75}, {0.3, 0.2, 0.1}, {7, 7, 7}};

/// The unit cube moved by x → x + A x, bound to kPoints.
LatticeMotion motion_by(const glm::dmat3& A) {
  const SubdivisionLattice lattice = test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1}));
  auto volume = std::make_shared<const Volume>(freeze_adaptive(lattice));
  std::vector<glm::dvec3> pose = lattice.rest;
  for (glm::dvec3& point : pose) {
    point += A * point;
  }
  auto binding = std::make_shared<const Binding>(embed(*volume, kPoints));
  auto displacements = volume->displacements(pose);
  return {std::move(volume), std::move(binding), std::move(displacements)};
}

const glm::dmat3 kA(0.1, 0, 0.2, 0, 0.3, 0, 0.1, 0, -0.2);
const glm::dmat3 kB(0, 0.5, 0, -0.5, 0, 0, 0, 0, 0.25);

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  return std::max(
      {glm::distance(a[0], b[0]), glm::distance(a[1], b[1]), glm::distance(a[2], b[2])});
}

TEST(Combine, of_one_motion_is_that_motion_bit_for_bit) {
  const std::vector motions = {motion_by(kA)};
  EXPECT_EQ(
      combined_points(kPoints, motions),
      displaced_points(*motions[0].volume, *motions[0].binding, kPoints, motions[0].displacements));
}

TEST(Combine, adds_displacements_and_gradients_times_strength_and_weight) {
  const std::vector motions = {motion_by(kA), motion_by(kB)};
  const Influence influence{-1.5, {0.5, 1, 1}};
  const auto points = combined_points(kPoints, motions, influence);
  const auto gradients = combined_gradients(kPoints.size(), motions, influence);
  for (const std::size_t i : {0u, 1u}) {
    const glm::dmat3 M = -1.5 * influence.weights[i] * (kA + kB);
    EXPECT_LT(glm::distance(points[i], kPoints[i] + M * kPoints[i]), 1e-15);
    EXPECT_LT(distance(gradients[i], glm::dmat3(1) + M), 1e-13);
  }
  EXPECT_EQ(points[2], kPoints[2]);
  EXPECT_EQ(gradients[2], glm::dmat3(1));
}

TEST(Combine, keeps_points_of_weight_zero_bit_for_bit) {
  const std::vector motions = {motion_by(kA)};
  EXPECT_EQ(combined_points(kPoints, motions, {1, {0, 0, 0}}), kPoints);
  EXPECT_EQ(combined_points(kPoints, motions, {0, {}}), kPoints);
  EXPECT_EQ(combined_gradients(3, motions, {1, {0, 0, 0}})[0], glm::dmat3(1));
}

TEST(Combine, refuses_influences_that_make_no_sense) {
  const std::vector motions = {motion_by(kA)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)combined_points(kPoints, motions, {nan, {}}), ParameterError);
  EXPECT_THROW((void)combined_points(kPoints, motions, {1, {1, 1}}), ParameterError);
  EXPECT_THROW((void)combined_points(kPoints, motions, {1, {1, nan, 1}}), ParameterError);
  EXPECT_THROW((void)combined_points(kPoints, motions, {1, {1, 1.5, 1}}), ParameterError);
  EXPECT_THROW((void)combined_gradients(2, motions, {}), ParameterError);
}

}  // namespace
}  // namespace espalier
