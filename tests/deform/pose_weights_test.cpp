/// Poses of rational lattices that have weights of their own.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "deform/embed/fringe.h"
#include "deform/evaluate/combine.h"
#include "deform/evaluate/displace.h"
#include "deform/evaluate/evaluator.h"
#include "lattice/core/error.h"
#include "lattice/tensor/tensor_lattice.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

const TensorAxis kQuadratic = TensorAxis::make(3, 2, Ends::Open);
const TensorAxis kLinear = TensorAxis::make(2, 1, Ends::Open);

/// A block with weights, a pose and weights of the pose.
TensorLattice posed_block() {
  TensorLattice lattice = make_tensor_lattice(
      TensorKind::Nurbs, {TensorAxis::make(5, 3, Ends::Open), kQuadratic, kQuadratic}, {});
  for (std::size_t i = 0; i < lattice.weights.size(); ++i) {
    lattice.weights[i] = 1 + 0.3 * std::sin(static_cast<double>(i));
    lattice.pose_weights.push_back(1 + 0.3 * std::cos(static_cast<double>(i)));
  }
  lattice.pose = test::jittered(lattice.rest, 0.05, 2);
  return lattice;
}

std::vector<glm::dvec3> random_points(double low, double high, int n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(low, high);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < n; ++i) {
    points.emplace_back(unit(random), unit(random), unit(random));
  }
  return points;
}

TEST(PoseWeights, turn_a_circle_s_arc_into_the_exact_conic) {
  // A quarter of a ring from radius 1 to 2: the middle weight √½ makes circles, 1 parabolas, 2
  // hyperbolas, at the same parameters.
  TensorLattice ring = make_tensor_lattice(TensorKind::Nurbs, {kQuadratic, kLinear, kLinear}, {});
  const std::vector<glm::dvec3> corner = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::size_t i = 0; i < ring.rest.size(); ++i) {
    ring.rest[i] = (1.0 + static_cast<double>(i / 3 % 2)) * corner[i % 3];
    ring.rest[i].z = static_cast<double>(i / 6);
    ring.weights[i] = i % 3 == 1 ? std::sqrt(0.5) : 1;
  }
  const Volume volume = freeze(ring);
  std::vector<glm::dvec3> points;
  for (int i = 1; i < 20; ++i) {
    const double angle = std::acos(0.0) * i / 20;
    points.emplace_back(1.5 * std::cos(angle), 1.5 * std::sin(angle), 0.25);
  }
  const Binding binding = embed(volume, points);
  ASSERT_EQ(binding.counts().inside, points.size());
  for (const double weight : {1.0, 2.0}) {
    ring.pose_weights = ring.weights;
    for (std::size_t i = 1; i < ring.rest.size(); i += 3) {
      ring.pose_weights[i] = weight;
    }
    const auto moved = displaced_points(volume, binding, points, volume.displacements(ring.rest),
                                        point_weights(volume, ring.pose_weights));
    for (const glm::dvec3& point : moved) {
      // a, b, c of a + b + c = 1 over the arc's control points; the conic is b² = 4 w² a c.
      const double b = (point.x + point.y) / 1.5 - 1;
      const double a = 1 - point.y / 1.5;
      const double c = 1 - point.x / 1.5;
      EXPECT_NEAR(b * b, 4 * weight * weight * a * c, 1e-14);
      EXPECT_NEAR(point.z, 0.25, 1e-15);
    }
    EXPECT_GT(glm::distance(moved[9], points[9]), 0.05);
  }
}

TEST(PoseWeights, move_points_to_where_the_posed_volume_has_them) {
  const TensorLattice lattice = posed_block();
  const Volume volume = freeze(lattice);
  const auto points = random_points(0.2, 0.8, 50);
  const Binding binding = embed(volume, points);
  const auto weights = point_weights(volume, lattice.pose_weights);
  const auto moved =
      displaced_points(volume, binding, points, volume.displacements(lattice.pose), weights);
  BezierPatch posed;
  for (std::size_t i = 0; i < binding.points.size(); ++i) {
    volume.bezier(static_cast<std::size_t>(binding.patches[i]), volume.points(lattice.pose),
                  weights, posed);
    EXPECT_LT(glm::distance(moved[static_cast<std::size_t>(binding.points[i])],
                            posed.value(binding.uvw[i])),
              1e-14);
  }
}

TEST(PoseWeights, have_gradients_that_are_difference_quotients_inside_and_in_the_fringe) {
  constexpr double kStep = 1e-5;
  const TensorLattice lattice = posed_block();
  const Volume volume = freeze(lattice);
  const auto weights = point_weights(volume, lattice.pose_weights);
  const auto displacements = volume.displacements(lattice.pose);
  auto points = random_points(0.2, 0.8, 12);
  points.emplace_back(0.4, 0.3, 1.1);
  points.emplace_back(-0.05, 0.6, 0.45);
  const auto bind = [&](const std::vector<glm::dvec3>& at) {
    Binding binding = embed(volume, at);
    binding.fringe = make_fringe(volume, at, binding.status, 0.5);
    return binding;
  };
  ASSERT_EQ(bind(points).fringe.points.size(), 2u);
  const auto gradients = deformation_gradients(volume, bind(points), displacements, weights);
  for (int axis = 0; axis < 3; ++axis) {
    auto before = points;
    auto after = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      before[i][axis] -= kStep;
      after[i][axis] += kStep;
    }
    const auto low = displaced_points(volume, bind(before), before, displacements, weights);
    const auto high = displaced_points(volume, bind(after), after, displacements, weights);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LT(glm::distance(gradients[i][axis], (high[i] - low[i]) / (2 * kStep)), 2e-6) << i;
    }
  }
}

TEST(PoseWeights, equal_to_those_at_rest_change_no_bit) {
  const TensorLattice lattice = posed_block();
  const Volume volume = freeze(lattice);
  const auto points = random_points(-0.1, 1.1, 100);
  const Binding binding = embed(volume, points);
  const std::vector<double> at_rest(volume.weights().begin(), volume.weights().end());
  const auto still = volume.displacements(lattice.rest);
  const auto moves = volume.displacements(lattice.pose);
  EXPECT_EQ(displaced_points(volume, binding, points, still, at_rest), points);
  EXPECT_EQ(displaced_points(volume, binding, points, moves, at_rest),
            displaced_points(volume, binding, points, moves));
  EXPECT_EQ(deformation_gradients(volume, binding, moves, at_rest),
            deformation_gradients(volume, binding, moves));
}

TEST(PoseWeights, combine_with_strengths) {
  const TensorLattice lattice = posed_block();
  const auto volume = std::make_shared<const Volume>(freeze(lattice));
  const auto points = random_points(0.2, 0.8, 10);
  const auto binding = std::make_shared<const Binding>(embed(*volume, points));
  const auto weights = point_weights(*volume, lattice.pose_weights);
  const auto moves = volume->displacements(lattice.pose);
  const std::vector<LatticeMotion> motions = {{volume, binding, moves, weights}};
  const auto whole = displaced_points(*volume, *binding, points, moves, weights);
  const auto half = combined_points(points, motions, {0.5, {}});
  const auto gradients = combined_gradients(points.size(), motions, {0.5, {}});
  const auto whole_gradients = deformation_gradients(*volume, *binding, moves, weights);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(glm::distance(half[i], 0.5 * (points[i] + whole[i])), 1e-15);
    const glm::dmat3 expected = 0.5 * (glm::dmat3(1) + whole_gradients[i]);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(glm::distance(gradients[i][axis], expected[axis]), 1e-14);
    }
  }
}

TEST(PoseWeights, that_alone_change_are_written_by_the_next_frame) {
  const TensorLattice lattice = posed_block();
  const Volume volume = freeze(lattice);
  const auto points = random_points(0.2, 0.8, 30);
  const Binding binding = embed(volume, points);
  const Evaluator<double> evaluator(volume, {binding.patches, binding.uvw, {}});
  const auto weights = point_weights(volume, lattice.pose_weights);
  const auto moves = volume.displacements(lattice.pose);
  VolumeMotion<double> motion(moves);
  std::vector<glm::dvec3> frame(binding.points.size(), glm::dvec3(7));
  const auto next = [&](const WeightChange& change) {
    motion.set(moves, change);
    frame.assign(frame.size(), glm::dvec3(7));
    evaluator.evaluate(motion, {.points = frame}, Scope::Changed);
    return frame;
  };
  EXPECT_EQ(next({}), std::vector(frame.size(), glm::dvec3(7)));
  const auto reweighted = next({volume.weights(), weights});
  const auto expected = point_displacements(volume, binding, moves, weights);
  for (std::size_t i = 0; i < reweighted.size(); ++i) {
    EXPECT_EQ(reweighted[i], expected[static_cast<std::size_t>(binding.points[i])]);
  }
  EXPECT_EQ(next({volume.weights(), weights}), std::vector(frame.size(), glm::dvec3(7)));
  const auto back = next({});
  const auto linear = point_displacements(volume, binding, moves);
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i], linear[static_cast<std::size_t>(binding.points[i])]);
  }
}

TEST(PoseWeights, are_refused_where_they_make_no_sense) {
  const TensorLattice lattice = posed_block();
  const Volume volume = freeze(lattice);
  const Binding binding = embed(volume, std::vector{glm::dvec3(0.5)});
  const auto moves = volume.displacements(lattice.pose);
  auto weights = point_weights(volume, lattice.pose_weights);
  const auto refused = [&](const std::vector<double>& bad) {
    EXPECT_THROW((void)point_displacements(volume, binding, moves, bad), ParameterError);
  };
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    weights[5] = bad;
    refused(weights);
  }
  refused({1, 2});
  const Volume polynomial =
      freeze(make_tensor_lattice(TensorKind::Bezier, {kQuadratic, kQuadratic, kQuadratic}, {}));
  EXPECT_THROW((void)point_displacements(polynomial, binding,
                                         polynomial.displacements(polynomial.rest_controls()),
                                         std::vector<double>(27, 1.0)),
               ParameterError);
}

}  // namespace
}  // namespace espalier
