#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "deform/injectivity/dominance.h"
#include "deform/injectivity/injectivity.h"
#include "deform/injectivity/rational_patch.h"
#include "lattice/core/error.h"
#include "lattice/tensor/tensor_lattice.h"

namespace espalier {
namespace {

using Points = std::vector<glm::dvec3>;

/// A NURBS box of 5 × 5 × 4 control points of degree 3, 2 and 2, weights between 1/2 and 2.
TensorLattice weighted_box(unsigned seed, const OrientedBox& box = {}) {
  TensorLattice lattice =
      make_tensor_lattice(TensorKind::Nurbs,
                          {TensorAxis::make(5, 3, Ends::Open), TensorAxis::make(5, 2, Ends::Open),
                           TensorAxis::make(4, 2, Ends::Open)},
                          box);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-1, 1);
  for (double& w : lattice.weights) {
    w = std::exp2(exponent(random));
  }
  return lattice;
}

InjectivityCheck check_of(const TensorLattice& lattice) {
  return InjectivityCheck(std::make_shared<const Volume>(freeze(lattice)));
}

template <class Map>
Points mapped(Points points, const Map& map) {
  for (glm::dvec3& p : points) {
    p = map(p);
  }
  return points;
}

/// A Bézier solid of (radius, angle, height) or (radius, longitude, latitude), exactly round.
TensorLattice round_solid(bool is_ball) {
  const auto bezier = [](int degree) { return TensorAxis::make(degree + 1, degree, Ends::Open); };
  TensorLattice solid;
  solid.kind = TensorKind::Nurbs;
  solid.axes = {bezier(1), bezier(2), bezier(is_ball ? 2 : 1)};
  const std::array<glm::dvec2, 3> arc = {{{1, 0}, {1, 1}, {0, 1}}};
  const std::array<double, 3> arc_weights = {1, std::sqrt(0.5), 1};
  for (std::size_t k = 0; k < (is_ball ? 3u : 2u); ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (const double r : {0.0, 1.0}) {
        if (is_ball) {
          solid.rest.push_back(r * glm::dvec3(arc[j] * arc[k].x, arc[k].y));
          solid.weights.push_back(arc_weights[j] * arc_weights[k]);
        } else {
          solid.rest.emplace_back(r * arc[j], static_cast<double>(k));
          solid.weights.push_back(arc_weights[j]);
        }
      }
    }
  }
  return solid;
}

TEST(RationalInjectivity, is_certified_at_rest_and_under_affine_maps_at_every_scale) {
  for (const double scale : {1.0, 1e8, 1e-8}) {
    OrientedBox box;
    box.half_sizes *= scale;
    box.center *= 7 * scale;
    const TensorLattice lattice = weighted_box(3, box);
    const InjectivityCheck check = check_of(lattice);
    const auto affine = [](const glm::dvec3& p) {
      return glm::dvec3(p.x + 0.4 * p.y, 1.2 * p.y - 0.3 * p.z, p.z + 0.1 * p.x);
    };
    EXPECT_EQ(check.local(lattice.rest).verdict, Verdict::Certified) << scale;
    EXPECT_EQ(check.local(mapped(lattice.rest, affine)).verdict, Verdict::Certified) << scale;
    const auto mirrored = check.local(
        mapped(lattice.rest, [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.y, p.z); }));
    ASSERT_EQ(mirrored.verdict, Verdict::Folded) << scale;
    EXPECT_NEAR(mirrored.folds.front().determinant, -1, 1e-9) << scale;
  }
}

TEST(RationalInjectivity, of_solids_with_collapsed_faces_is_certified) {
  for (const bool is_ball : {false, true}) {
    const TensorLattice solid = round_solid(is_ball);
    const InjectivityCheck check = check_of(solid);
    const Volume& volume = check.volume();
    const Collapse collapse = rational_collapse(volume, 0, volume.rest_points(), volume.weights());
    EXPECT_TRUE(collapse.has(1, 0, 0));         // no length along the angle at radius 0
    EXPECT_EQ(collapse.has(2, 0, 0), is_ball);  // nor along the latitude at the centre
    EXPECT_EQ(collapse.has(1, 2, 1), is_ball);  // nor along the longitude at the pole
    EXPECT_FALSE(collapse.has(0, 1, 0));
    EXPECT_EQ(check.local(solid.rest).verdict, Verdict::Certified);
    const auto bent = [](const glm::dvec3& p) {
      return glm::dvec3(p.x + 0.2 * p.z * p.z, p.y, p.z - 0.1 * p.x * p.y);
    };
    EXPECT_EQ(check.local(mapped(solid.rest, bent)).verdict, Verdict::Certified);
    Points folded = solid.rest;
    folded[3] *= -2.0;
    EXPECT_EQ(check.local(folded).verdict, Verdict::Folded);
  }
}

TEST(RationalInjectivity, of_solids_with_collapsed_faces_has_a_largest_step) {
  for (const bool is_ball : {false, true}) {
    const TensorLattice solid = round_solid(is_ball);
    const InjectivityCheck check = check_of(solid);
    for (const bool is_parallel : {true, false}) {
      Points motion(solid.rest.size(), glm::dvec3(0));
      motion[3] = -solid.rest[3] + glm::dvec3(0, 0, 0.2);
      motion[5] = is_parallel ? glm::dvec3(0) : glm::dvec3(0.2, -0.1, 0.3);
      const SafeStep found = check.largest_step(solid.rest, motion);
      EXPECT_TRUE(found.is_tight);
      EXPECT_GT(found.step, 0.05);
      for (const double part : {0.999, 1.001}) {
        Points pose = solid.rest;
        for (std::size_t i = 0; i < pose.size(); ++i) {
          pose[i] += part * found.step * motion[i];
        }
        EXPECT_EQ(check.local(pose).verdict, part < 1 ? Verdict::Certified : Verdict::Folded)
            << is_ball << is_parallel;
      }
    }
  }
}

TEST(RationalInjectivity, sees_collapse_only_where_weights_keep_it) {
  TensorLattice solid = round_solid(false);
  solid.weights[2] = 0.9;  // in the middle of the angle at radius 0, at one height only
  const InjectivityCheck check = check_of(solid);
  const Volume& volume = check.volume();
  EXPECT_FALSE(rational_collapse(volume, 0, volume.rest_points(), volume.weights()).has(1, 0, 0));
  solid.weights[8] = 0.9;  // and at the other
  const Volume product = freeze(solid);
  EXPECT_TRUE(rational_collapse(product, 0, product.rest_points(), product.weights()).has(1, 0, 0));
}

/// det ∂x'/∂x at a fold, by ordinary derivatives.
double determinant_at(const Volume& volume, const PosedControls& pose, const Fold& fold) {
  BezierPatch posed;
  volume.bezier(fold.patch, volume.points(pose.points),
                pose.weights.empty() ? volume.weights() : pose.weights, posed);
  return glm::determinant(posed.derivative(fold.uvw)) /
         glm::determinant(volume.bezier(fold.patch, volume.rest_points()).derivative(fold.uvw));
}

TEST(RationalInjectivity, ends_at_the_largest_step_whatever_the_weights_of_the_pose) {
  const TensorLattice lattice = weighted_box(1);
  const InjectivityCheck check = check_of(lattice);
  const TensorLattice other = weighted_box(9);
  const std::vector<double> other_weights = point_weights(check.volume(), other.weights);
  for (const bool is_parallel : {true, false}) {
    for (const std::span<const double> weights :
         {std::span<const double>(), std::span<const double>(other_weights)}) {
      Points motion(lattice.rest.size(), glm::dvec3(0));
      motion[37] = {1, 0.2, 0};
      motion[38] = is_parallel ? glm::dvec3(0) : glm::dvec3(-0.5, 0.1, 0.3);
      const SafeStep found = check.largest_step({lattice.rest, weights}, motion);
      EXPECT_TRUE(found.is_tight);
      EXPECT_GT(found.step, 0.01);
      for (const double part : {0.9999, 1.001}) {
        Points pose = lattice.rest;
        for (std::size_t i = 0; i < pose.size(); ++i) {
          pose[i] += part * found.step * motion[i];
        }
        const LocalInjectivity local = check.local({pose, weights});
        EXPECT_EQ(local.verdict, part < 1 ? Verdict::Certified : Verdict::Folded);
        for (const Fold& fold : local.folds) {
          EXPECT_LT(fold.determinant, 0);
          EXPECT_NEAR(fold.determinant, determinant_at(check.volume(), {pose, weights}, fold),
                      1e-9);
        }
      }
    }
  }
}

/// Weights in geometric progression only change how fast a Bézier volume is run through.
TEST(RationalInjectivity, of_a_volume_run_through_at_another_speed_is_that_of_the_volume) {
  const TensorAxis axis = TensorAxis::make(4, 3, Ends::Open);
  TensorLattice lattice = make_tensor_lattice(TensorKind::Nurbs, {axis, axis, axis}, {});
  const InjectivityCheck plain = check_of(lattice);
  for (std::size_t i = 0; i < lattice.weights.size(); ++i) {
    lattice.weights[i] = std::pow(1.5, static_cast<double>(i % 4)) *
                         std::pow(0.75, static_cast<double>(i / 4 % 4)) *
                         std::pow(1.25, static_cast<double>(i / 16));
  }
  const std::vector<double> fast = point_weights(plain.volume(), lattice.weights);
  for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(-0.3, 1, 0.5)}) {
    Points motion(64, glm::dvec3(0));
    motion[21] = direction;
    const double step = plain.largest_step(lattice.rest, motion).step;
    EXPECT_NEAR(plain.largest_step({lattice.rest, fast}, motion).step, step, 2e-4 * step);
    motion[22] = {0.2, -0.4, 1};
    const double both = plain.largest_step(lattice.rest, motion).step;
    EXPECT_NEAR(plain.largest_step({lattice.rest, fast}, motion).step, both, 2e-4 * both);
  }
}

TEST(DominantStep, of_rational_patches_is_never_more_than_what_the_determinant_allows) {
  int n_proved = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    TensorLattice lattice = weighted_box(seed);
    for (double& w : lattice.weights) {
      w = std::pow(w, 0.01 * seed);
    }
    const InjectivityCheck check = check_of(lattice);
    Points motion(lattice.rest.size(), glm::dvec3(0));
    motion[37] = {1, 0.2, -0.3};
    motion[30] = {0.3, 0.2, 1};
    const double largest = check.largest_step(lattice.rest, motion).step;
    const Volume& volume = check.volume();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < volume.n_patches(); ++i) {
      const BezierPatch moves = volume.bezier(i, motion);
      least = std::min(least, dominant_step(volume.bezier(i, volume.rest_points()), &moves,
                                            {1e-15, 1e-15, 1e-15}));
    }
    EXPECT_LE(least, largest);
    n_proved += least > 0 ? 1 : 0;
  }
  EXPECT_GT(n_proved, 10);
  EXPECT_LT(n_proved, 60);
}

TEST(RationalInjectivity, names_bad_weights) {
  const TensorLattice lattice = weighted_box(3);
  const InjectivityCheck check = check_of(lattice);
  std::vector<double> weights(check.volume().n_points(), 1.0);
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    weights[5] = bad;
    try {
      (void)check.local({lattice.rest, weights});
      FAIL();
    } catch (const ParameterError& error) {
      EXPECT_NE(std::string(error.what()).find("weight 5 of the pose"), std::string::npos);
    }
  }
  weights.pop_back();
  EXPECT_THROW((void)check.largest_step({lattice.rest, weights}, lattice.rest), ParameterError);
  const TensorAxis axis = TensorAxis::make(3, 2, Ends::Open);
  const TensorLattice plain = make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {});
  const std::vector<double> ones(27, 1.0);
  EXPECT_THROW((void)check_of(plain).local({plain.rest, ones}), ParameterError);
}

TEST(LargestStep, of_a_plane_of_control_points_ends_where_the_pose_folds) {
  const TensorAxis axis = TensorAxis::make(4, 3, Ends::Open);
  const TensorLattice plane =
      make_tensor_lattice(TensorKind::BSpline, {axis, axis, TensorAxis()}, {});
  const InjectivityCheck check = check_of(plane);
  Points motion(16, glm::dvec3(0));
  motion[5] = {1, 0.5, 0};
  const SafeStep found = check.largest_step(plane.rest, motion);
  EXPECT_GT(found.step, 0.1);
  for (const double part : {0.9999, 1.001}) {
    Points pose = plane.rest;
    pose[5] += part * found.step * motion[5];
    EXPECT_EQ(check.local(pose).verdict, part < 1 ? Verdict::Certified : Verdict::Folded);
  }
}

TEST(InjectivityCheck, names_a_patch_without_any_extent_along_an_axis) {
  const TensorAxis axis = TensorAxis::make(2, 1, Ends::Open);
  TensorLattice flat = make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {});
  for (glm::dvec3& p : flat.rest) {
    p.z = 0;
  }
  for (const bool is_rational : {false, true}) {
    flat.kind = is_rational ? TensorKind::Nurbs : TensorKind::BSpline;
    flat.weights =
        is_rational ? std::vector<double>{1, 2, 1, 1, 3, 1, 1, 1} : std::vector<double>();
    EXPECT_THROW((void)check_of(flat), LatticeError);
  }
}

}  // namespace
}  // namespace espalier
