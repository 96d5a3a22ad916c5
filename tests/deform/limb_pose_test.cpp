#include "deform/animate/limb_pose.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "lattice/core/error.h"

namespace espalier {
namespace {

using Points = std::vector<glm::dvec3>;
using Map = std::function<Points(std::span<const glm::dvec3>)>;

constexpr double kPi = std::numbers::pi;

void expect_near(const glm::dvec3& point, const glm::dvec3& expected, double tolerance = 1e-14) {
  EXPECT_LT(glm::distance(point, expected), tolerance)
      << point.x << " " << point.y << " " << point.z << " instead of " << expected.x << " "
      << expected.y << " " << expected.z;
}

/// A few points on every side of the piece of the x axis from 0 to 2, and beyond.
Points some_points() {
  Points points;
  for (const double x : {-1.5, -0.0, 0.25, 1.0, 1.75, 2.0, 3.5}) {
    for (const double y : {-0.5, 0.0, 0.375}) {
      points.emplace_back(x, y, 0.25);
    }
  }
  return points;
}

const Bone kBone = {{0, 0, 0}, {2, 0, 0}};
const LimbRegion kBeyond = {.joint = {1, 0, 0}, .along = {3, 0, 0}, .falloff = 1};

/// The determinant of a map by central differences.
double determinant(const Map& map, const glm::dvec3& x) {
  constexpr double kStep = 1e-5;
  glm::dmat3 J;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0);
    step[axis] = kStep;
    const Points ends = map(Points{x + step, x - step});
    J[axis] = (ends[0] - ends[1]) / (2 * kStep);
  }
  return glm::determinant(J);
}

void expect_same_distances(const Points& before, const Points& after) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(glm::distance(after[i], after[j]), glm::distance(before[i], before[j]), 1e-14);
    }
  }
}

TEST(LimbPose, a_bent_bar_is_an_arc_of_its_own_length) {
  const double r = 4 / kPi;  // of a quarter circle of length 2
  Points axis;
  for (int i = 0; i <= 8; ++i) {
    axis.emplace_back(i / 4.0, 0, 0);
  }
  const Points arc = bent(axis, kBone, {0, 1, 0}, 90);
  for (int i = 0; i <= 8; ++i) {
    const double angle = kPi / 2 * i / 8;
    expect_near(arc[static_cast<std::size_t>(i)],
                {r * std::sin(angle), r - r * std::cos(angle), 0});
  }
  // Its inner side is nearer to the centre, what is out of the plane stays out of it.
  const Points sides = bent(Points{{2, 0.25, 0}, {2, -0.25, 0.5}}, kBone, {5, 1, 0}, 90);
  expect_near(sides[0], {r - 0.25, r, 0});
  expect_near(sides[1], {r + 0.25, r, 0.5});
}

TEST(LimbPose, what_is_before_a_bend_stays_and_what_is_beyond_follows_rigidly) {
  const double r = 4 / kPi;
  const Points beyond = {{2, 0, 0}, {3, 0, 0}, {5, 0.5, 0.25}, {4, -1, 2}};
  const Points after = bent(beyond, kBone, {0, 1, 0}, 90);
  expect_same_distances(beyond, after);
  expect_near(after[1], {r, r + 1, 0});
  const Points before = {{-1, 2, 3}, {-0.125, 0.3, 0.7}};
  EXPECT_EQ(bent(before, kBone, {0, 1, 0}, 90), before);
}

TEST(LimbPose, tiny_bends_are_smooth) {
  const Points moved = bent(Points{{2, 0, 0}, {4, 0, 0}}, kBone, {0, 1, 0}, 1e-6);
  const double angle = 1e-6 * kPi / 180;
  expect_near(moved[0], {2, angle, 0}, 1e-15);
  expect_near(moved[1], {4, 3 * angle, 0}, 1e-15);
}

TEST(LimbPose, the_determinants_are_those_promised) {
  const double theta = 50 * kPi / 180;
  for (const glm::dvec3& x : {glm::dvec3(0.7, 0.3, 0.2), glm::dvec3(1.3, -0.4, 0.1)}) {
    const Map bend = [](auto p) { return bent(p, kBone, {0, 1, 0}, 50); };
    EXPECT_NEAR(determinant(bend, x), 1 - theta / 2 * x.y, 1e-9);
    const Map turn = [](auto p) { return turned(p, kBeyond, {0, 0, 1}, 50); };
    const double tau = x.x - 0.5;
    EXPECT_NEAR(determinant(turn, x), 1 - theta * 6 * tau * (1 - tau) * x.y, 1e-9);
    const Map twist = [](auto p) { return twisted(p, kBone, 120); };
    EXPECT_NEAR(determinant(twist, x), 1, 1e-9);
    const Map taper = [](auto p) { return tapered(p, kBone, 0.5); };
    EXPECT_NEAR(determinant(taper, x), std::pow(1 - x.x / 4, 2), 1e-9);
  }
}

TEST(LimbPose, turning_blends_the_angle_across_the_joint) {
  const Points points = {{0.5, 0.25, 0}, {0.75, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {3, 0.25, 1}};
  const Points after = turned(points, kBeyond, {0, 0, 2}, 90);
  EXPECT_EQ(after[0], points[0]);
  const double angle = kPi / 2 * (3.0 / 16 - 2.0 / 64);  // at τ = 1/4
  expect_near(after[1], {1 - std::cos(angle) / 4, -std::sin(angle) / 4, 0});
  EXPECT_EQ(after[2], points[2]);
  expect_near(after[3], {1, 0.5, 0});
  expect_near(after[4], {0.75, 2, 1});
}

TEST(LimbPose, a_hard_edge_begins_at_the_joint_and_no_direction_means_everything) {
  const Points points = {{0.75, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  const Points hard = turned(points, {.joint = {1, 0, 0}, .along = {1, 0, 0}}, {0, 0, 1}, 180);
  EXPECT_EQ(hard[0], points[0]);
  expect_near(hard[1], {1, -1, 0});
  expect_near(hard[2], {0, 0, 0});
  const Points all = turned(points, {.joint = {1, 0, 0}}, {0, 0, 1}, 180);
  expect_near(all[0], {1.25, 0, 0});
  expect_same_distances(points, all);
}

TEST(LimbPose, twisting_turns_sections_evenly_about_the_bone) {
  const Points after = twisted(Points{{-1, 1, 0}, {1, 1, 0}, {2, 1, 0}, {7, 0, 1}}, kBone, 180);
  EXPECT_EQ(after[0], glm::dvec3(-1, 1, 0));
  expect_near(after[1], {1, 0, 1});
  expect_near(after[2], {2, -1, 0});
  expect_near(after[3], {7, 0, -1});
}

TEST(LimbPose, tapering_scales_sections_evenly) {
  const Points after = tapered(Points{{-1, 1, 2}, {1, 1, 2}, {2, 1, 2}, {7, 1, 2}}, kBone, 0.5);
  EXPECT_EQ(after, (Points{{-1, 1, 2}, {1, 0.75, 1.5}, {2, 0.5, 1}, {7, 0.5, 1}}));
}

TEST(LimbPose, scaling_and_moving_blend_across_the_joint) {
  const Points points = {{0.25, 1, 1}, {1, 1, 1}, {3, 1, 1}};
  EXPECT_EQ(scaled(points, kBeyond, {2, 1, 0.5}),
            (Points{{0.25, 1, 1}, {1, 1, 0.75}, {5, 1, 0.5}}));
  EXPECT_EQ(moved(points, kBeyond, {0, 4, 0}), (Points{{0.25, 1, 1}, {1, 3, 1}, {3, 5, 1}}));
}

TEST(LimbPose, the_opposite_turn_or_twist_or_move_brings_everything_back) {
  const Points points = some_points();
  const LimbRegion all = {.joint = {0.3, 0.4, 0.5}};
  const std::vector<std::pair<Map, Map>> inverses = {
      {[&](auto p) {
         return turned(p, all, {1, 2, 3}, 77);
       },
       [&](auto p) {
         return turned(p, all, {1, 2, 3}, -77);
       }},
      {[](auto p) { return twisted(p, kBone, 300); },
       [](auto p) { return twisted(p, kBone, -300); }},
      {[&](auto p) {
         return scaled(p, all, {2, 3, 5});
       },
       [&](auto p) {
         return scaled(p, all, {1 / 2.0, 1 / 3.0, 1 / 5.0});
       }},
      {[](auto p) {
         return moved(p, kBeyond, {0, 2, 1});
       },
       [](auto p) {
         return moved(p, kBeyond, {0, -2, -1});
       }},
      {[](auto p) {
         return turned(p, kBeyond, {1, 0, 0}, 90);
       },
       [](auto p) {
         return turned(p, kBeyond, {1, 0, 0}, -90);
       }}};
  for (std::size_t k = 0; k < inverses.size(); ++k) {
    const Points back = inverses[k].second(inverses[k].first(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
      expect_near(back[i], points[i], 3e-15);
    }
  }
}

TEST(LimbPose, turning_by_nothing_keeps_every_bit) {
  const Points points = some_points();
  const glm::dvec3 axis(1, 2, 3);
  for (const Points& after :
       {turned(points, kBeyond, axis, 0), turned(points, {.joint = {7, 8, 9}}, axis, 0),
        scaled(points, kBeyond, {1, 1, 1}), moved(points, kBeyond, {0, 0, 0}),
        twisted(points, kBone, 0), bent(points, kBone, axis, 0), tapered(points, kBone, 1)}) {
    ASSERT_EQ(after.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (int a = 0; a < 3; ++a) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(after[i][a]),
                  std::bit_cast<std::uint64_t>(points[i][a]));
      }
    }
  }
}

TEST(LimbPose, the_maps_move_along_with_the_axes_they_are_given) {
  // Everything turned by 90° about z and moved.
  const auto elsewhere = [](const glm::dvec3& v) { return glm::dvec3(-v.y, v.x, v.z); };
  const glm::dvec3 t(10, 20, 30);
  const Points points = some_points();
  Points there;
  for (const glm::dvec3& p : points) {
    there.push_back(elsewhere(p) + t);
  }
  const Bone bone = {t, elsewhere(kBone.to) + t};
  const LimbRegion region = {elsewhere(kBeyond.joint) + t, elsewhere(kBeyond.along), 1};
  const std::vector<std::pair<Points, Points>> pairs = {
      {bent(points, kBone, {1, 2, 1}, 130), bent(there, bone, elsewhere({1, 2, 1}), 130)},
      {twisted(points, kBone, 130), twisted(there, bone, 130)},
      {tapered(points, kBone, 3), tapered(there, bone, 3)},
      {turned(points, kBeyond, {1, 2, 1}, 130), turned(there, region, elsewhere({1, 2, 1}), 130)}};
  for (const auto& [here, after] : pairs) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      expect_near(after[i], elsewhere(here[i]) + t, 1e-13);
    }
  }
}

TEST(LimbPose, the_cut_radius_is_where_the_plane_crosses_the_net) {
  const Points points = {{0, 1, 0}, {2, 3, 0}, {0, 0, -1}, {2, 0, -1}, {0, 9, 0}};
  const std::vector<std::array<std::int32_t, 2>> net = {{0, 1}, {2, 3}, {0, 4}};
  EXPECT_DOUBLE_EQ(cut_radius(points, net, {1, 0, 0}, {5, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(cut_radius(points, net, {1.5, 0, 0}, {-1, 0, 0}), 2.5);
  EXPECT_EQ(cut_radius(points, net, {3, 0, 0}, {1, 0, 0}), 0);
}

template <class Call>
std::string complaint(const Call& call) {
  try {
    (void)call();
    return "";
  } catch (const ParameterError& error) {
    return error.what();
  }
}

TEST(LimbPose, names_what_it_refuses) {
  const Points p = some_points();
  const double nan = std::nan("");
  EXPECT_EQ(complaint([&] {
              return turned(p, kBeyond, {0, 0, 0}, 1);
            }),
            "'axis' must be finite and not zero");
  EXPECT_EQ(complaint([&] {
              return turned(p, kBeyond, {0, 0, 1}, nan);
            }),
            "'angle' must be finite");
  EXPECT_EQ(complaint([&] {
              return turned(p, {.joint = {nan, 0, 0}}, {0, 0, 1}, 1);
            }),
            "'about' and 'along' must be finite");
  EXPECT_EQ(complaint([&] {
              return moved(p, {.falloff = -1}, {0, 0, 1});
            }),
            "'falloff' must be a length, 0 or more");
  EXPECT_EQ(complaint([&] { return moved(p, kBeyond, {0, nan, 1}); }), "'by' must be finite");
  EXPECT_EQ(complaint([&] {
              return scaled(p, kBeyond, {1, 0, 1});
            }),
            "'scale' must be positive factors");
  EXPECT_EQ(complaint([&] { return tapered(p, kBone, -2); }), "'scale' must be positive");
  EXPECT_EQ(complaint([&] {
              return twisted(p, {{1, 1, 1}, {1, 1, 1}}, 9);
            }),
            "'from' and 'to' must be finite and differ");
  EXPECT_EQ(complaint([&] {
              return bent(p, kBone, {4, 0, 0}, 9);
            }),
            "'towards' must not run along the limb");
  EXPECT_EQ(complaint([&] {
              return cut_radius(p, {}, {0, 0, 0}, {0, 0, 0});
            }),
            "'along' must be finite and not zero");
}

}  // namespace
}  // namespace espalier
