/// new … --fit: every kind of lattice holds the points it is laid round.

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <numbers>
#include <random>
#include <sstream>

#include "deform/fit/point_extent.h"
#include "deform/model/model_file.h"
#include "deform/scene/operation_text.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/tensor/oriented_box.h"
#include "tests/support/winding.h"

namespace espalier {
namespace {

using Points = std::vector<glm::dvec3>;

/// Points spread evenly in [-1, 1]³.
Points cube_points(int n, unsigned seed) {
  std::mt19937 random(seed);
  Points points;
  for (int i = 0; i < n; ++i) {
    const auto next = [&] { return 2.0 * static_cast<double>(random()) / std::mt19937::max() - 1; };
    const double x = next();
    const double y = next();
    points.emplace_back(x, y, next());
  }
  return points;
}

/// A slanted blob.
Points blob() {
  Points points = cube_points(24, 1);
  for (glm::dvec3& p : points) {
    p = glm::dvec3(3, -1, 2) + p.x * glm::dvec3(2, 1, 0.5) + p.y * glm::dvec3(-0.3, 0.6, 0) +
        p.z * glm::dvec3(0, 0, 0.4);
  }
  return points;
}

/// Round a slanted circle of radius 2.
Points ring() {
  Points points = cube_points(24, 2);
  const glm::dvec3 right = glm::normalize(glm::dvec3(1, 0.2, 0));
  const glm::dvec3 up = glm::normalize(glm::dvec3(-0.2, 1, 0.5));
  const glm::dvec3 axis = glm::normalize(glm::cross(right, up));
  for (glm::dvec3& p : points) {
    const double angle = std::numbers::pi * p.x;
    const double r = 2 + 0.3 * p.y;
    p = glm::dvec3(5, 6, 7) + r * std::cos(angle) * right + r * std::sin(angle) * up +
        0.3 * p.z * axis;
  }
  return points;
}

/// Two blobs and a thin bar between, along y.
Points dumbbell() {
  Points points = cube_points(24, 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    glm::dvec3& p = points[i];
    const double end = i % 2 == 0 ? 1 : -1;
    p = i % 3 == 0 ? glm::dvec3(0.2 * p.x, 3 * p.y, 0.2 * p.z)
                   : glm::dvec3(p.x, 4 * end + p.y, 0.3 * p.z);
  }
  return points;
}

/// Along two or three arms in the x-y plane.
Points crossing(const std::vector<glm::dvec3>& arms) {
  Points points = cube_points(24, 4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 place = arms[i % arms.size()] * (1.5 + 1.5 * points[i].x);
    points[i] = glm::dvec3(1, 2, 3) + place + 0.3 * points[i];
  }
  return points;
}

std::string obj_of(const Points& points) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const glm::dvec3& p : points) {
    text << "v " << p.x << " " << p.y << " " << p.z << "\n";
  }
  return text.str();
}

Scene scene_of(const Points& points) {
  return with_model({}, "m", parse_model(ModelFormat::Obj, "m.obj", obj_of(points)));
}

SubdivisionLattice lattice_of(const Scene& scene, const std::string& line) {
  return subdivision_lattice_in(apply(parse_call(line + " output=l"), scene), "l");
}

/// Whether every point is inside or on the border.
void expect_inside(const SubdivisionLattice& lattice, const Points& points,
                   const std::string& name) {
  const StatusCounts counts = embed(freeze_adaptive(lattice), points).counts();
  EXPECT_EQ(counts.inside + counts.border, points.size()) << name;
}

/// The oracle finds every point inside, and what is nearly `clearance` beside it.
void expect_held(const SubdivisionLattice& lattice, const Points& points, double clearance,
                 const std::string& name) {
  const test::WindingOracle winding(lattice, 2);
  for (const glm::dvec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-0.98, 0.98}) {
        glm::dvec3 probe = point;
        probe[axis] += sign * clearance;
        ASSERT_GT(winding(probe), 0.5) << name;
      }
    }
  }
}

void expect_held_by(const std::vector<std::string>& kinds, const Points& points) {
  for (const std::string& kind : kinds) {
    const std::string line = "new " + kind + " fit=m padding=0.04";
    expect_held(lattice_of(scene_of(points), line), points, 0.04 * extent_of(points), line);
  }
}

TEST(FitOperations, boxes_hold_every_point_with_the_padding) {
  expect_held_by({"box", "box axes=principal", "box sharp=none"}, blob());
}

TEST(FitOperations, bars_hold_every_point_with_the_padding) {
  expect_held_by({"cylinder", "cylinder axes=world sectors=3", "cylinder along=z layers=1",
                  "ogrid core=1", "ogrid sharp=none"},
                 blob());
}

TEST(FitOperations, balls_and_stars_hold_every_point_with_the_padding) {
  expect_held_by({"sphere", "sphere cells=1", "star", "star along=x tips=3"}, blob());
}

TEST(FitOperations, rings_hold_every_point_with_the_padding) {
  expect_held_by({"annulus", "torus", "torus segments=6"}, ring());
}

TEST(FitOperations, barbells_hold_every_point_with_the_padding) {
  expect_held_by({"barbell"}, dumbbell());
}

TEST(FitOperations, corners_hold_every_point_with_the_padding) {
  expect_held_by({"junction kind=L layers=1"}, crossing({{1, 0, 0}, {0, 1, 0}}));
}

TEST(FitOperations, three_bars_that_meet_hold_every_point_with_the_padding) {
  expect_held_by({"junction kind=T layers=1"}, crossing({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}));
}

TEST(FitOperations, forks_hold_every_point_with_the_padding) {
  const double turn = std::sqrt(0.75);
  expect_held_by({"junction kind=Y layers=1"},
                 crossing({{turn, 0.5, 0}, {-turn, 0.5, 0}, {0, -1, 0}}));
}

TEST(FitOperations, lattices_of_tiny_and_huge_models_are_the_same_but_for_their_size) {
  for (const char* kind : {"box axes=principal", "cylinder", "ogrid", "star"}) {
    const std::string line = std::string("new ") + kind + " fit=m";
    const Points usual = lattice_of(scene_of(blob()), line).rest;
    for (const double scale : {std::ldexp(1.0, -27), std::ldexp(1.0, 27)}) {
      Points points = blob();
      for (glm::dvec3& point : points) {
        point *= scale;
      }
      const Points scaled = lattice_of(scene_of(points), line).rest;
      ASSERT_EQ(scaled.size(), usual.size());
      for (std::size_t i = 0; i < usual.size(); ++i) {
        EXPECT_LT(glm::distance(scaled[i], scale * usual[i]), 1e-12 * scale) << line;
      }
    }
  }
}

TEST(FitOperations, without_padding_nothing_sticks_out) {
  for (const char* kind : {"box", "ogrid", "sphere cells=1", "torus sectors=6"}) {
    const Points points = std::string(kind).starts_with("torus") ? ring() : blob();
    const std::string line = std::string("new ") + kind + " fit=m padding=0";
    expect_inside(lattice_of(scene_of(points), line), points, line);
  }
}

TEST(FitOperations, lattices_are_not_larger_than_they_need_be) {
  // The sphere round the corners of a cube, the cylinder along it.
  Points corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i % 2, i / 2 % 2, 2 * (i / 4));
  }
  const auto most = [](const SubdivisionLattice& lattice, const glm::dvec3& axis) {
    return interval_along(refined(lattice, 2).rest, axis, 0);
  };
  const SubdivisionLattice bar =
      lattice_of(scene_of(corners), "new cylinder fit=m padding=0 axes=world");
  EXPECT_NEAR(most(bar, {0, 0, 1}).low, 0, 1e-12);
  EXPECT_NEAR(most(bar, {0, 0, 1}).high, 2, 1e-12);
  EXPECT_NEAR(most(bar, {1, 0, 0}).high, 0.5 + std::sqrt(0.5), 0.02);
  const SubdivisionLattice ball =
      lattice_of(scene_of(corners), "new sphere cells=1 fit=m padding=0");
  EXPECT_NEAR(most(ball, {0, 0, 1}).high, 1 + std::sqrt(1.5), 0.06);
}

TEST(FitOperations, the_padding_is_a_part_of_the_diagonal_of_the_points_that_count) {
  write_file(::testing::TempDir() + "/espalier_fit_only.txt", "1\n2\n");
  const Scene scene = scene_of({{100, 100, 100}, {0, 0, 0}, {3, 4, 0}});
  const SubdivisionLattice box = lattice_of(
      scene, "new box fit=m padding=0.1 only=@" + ::testing::TempDir() + "/espalier_fit_only.txt");
  // Flat: half as thick as the padding says, on either side, and a thousandth more.
  EXPECT_EQ(box.rest.front(), glm::dvec3(-0.5, -0.5, -0.5 - 0.0025));
  EXPECT_EQ(box.rest.back(), glm::dvec3(3.5, 4.5, 0.5 + 0.0025));
}

TEST(PointExtent, balls_and_circles_are_nearly_the_smallest) {
  const double far = 1e6;
  const glm::dvec3 t(far, -far, 2 * far);
  // Corners of a regular triangle and tetrahedron, of a flat triangle, and a few points inside.
  const std::vector<std::pair<Points, double>> sets = {
      {{{1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}, {0.1, 0.2, 0}}, 1},
      {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0, 0.5, 0}}, std::sqrt(3.0)},
      {{{0, 0, 0}, {10, 0, 0}, {2, 1, 0}, {3, 1, 1}}, 5}};
  for (const auto& [points, radius] : sets) {
    Points there;
    for (const glm::dvec3& p : points) {
      there.push_back(1e-3 * p + t);
    }
    EXPECT_GT(enclosing_ball(points).radius, radius * (1 - 1e-12));
    EXPECT_LT(enclosing_ball(points).radius, radius * 1.01);
    EXPECT_NEAR(enclosing_ball(there).radius, 1e-3 * enclosing_ball(points).radius, 1e-8);
  }
  const Points column = {{1, 7, 0}, {-0.5, 0, std::sqrt(0.75)}, {-0.5, -9, -std::sqrt(0.75)}};
  EXPECT_NEAR(enclosing_circle(column, {0, 1, 0}).radius, 1, 0.01);
  EXPECT_LT(glm::length(enclosing_circle(column, {0, 1, 0}).center), 0.02);
}

TEST(PointExtent, axes_go_from_the_longest_side_to_the_shortest) {
  const Points points = {{0, 0, 0}, {1, 5, 3}};
  const glm::dmat3 axes = sorted_axes(points, false);
  EXPECT_EQ(axes[0], glm::dvec3(0, 1, 0));
  EXPECT_EQ(axes[1], glm::dvec3(0, 0, 1));
  EXPECT_EQ(axes[2], glm::dvec3(1, 0, 0));
  EXPECT_LT(glm::distance(sorted_axes(points, true)[0], points[1] / glm::length(points[1])), 1e-12);
}

/// A tube round a chain of joints with a radius at each.
Points tube(const Points& joints, const std::vector<double>& radii) {
  Points points;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const glm::dvec3 bone = glm::normalize(joints[i + 1] - joints[i]);
    const glm::dvec3 right = glm::normalize(glm::cross(bone, glm::dvec3(0.1, 0.2, 1)));
    const glm::dvec3 up = glm::cross(bone, right);
    for (int step = 1; step < 10; ++step) {
      const double t = step / 10.0;
      for (int k = 0; k < 12; ++k) {
        const double angle = std::numbers::pi * k / 6;
        points.push_back(joints[i] * (1 - t) + joints[i + 1] * t +
                         (radii[i] * (1 - t) + radii[i + 1] * t) *
                             (right * std::cos(angle) + up * std::sin(angle)));
      }
    }
  }
  return points;
}

TEST(FitOperations, a_limb_keeps_its_joints_and_takes_its_radii_from_the_model) {
  const Points joints = {{0, 0, 0}, {4, 0, 0}, {7, 1, 0}};
  const Points points = tube(joints, {0.8, 0.5, 0.3});
  const SubdivisionLattice limb =
      lattice_of(scene_of(points), "new limb joint=0,0,0 joint=4,0,0 joint=7,1,0 padding=0 fit=m");
  expect_inside(limb, points, "limb");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(limb.rest[27 * i], joints[i]), 1e-14);
  }
  EXPECT_NEAR(glm::length(limb.rest[1]), 0.8, 0.15);
  EXPECT_NEAR(glm::distance(limb.rest[55], joints[2]), 0.3, 0.1);
}

TEST(FitOperations, a_bar_between_given_ends_is_as_thick_as_the_model_there) {
  const Points points = tube({{1, 1, 1}, {1, 5, 1}}, {0.8, 0.4});
  for (const char* kind : {"cylinder", "ogrid"}) {
    const SubdivisionLattice bar =
        lattice_of(scene_of(points),
                   std::string("new ") + kind + " from=1,1,1 to=1,5,1 padding=0.01 fit=m layers=4");
    expect_held(bar, points, 0.005, kind);
    const Interval width = interval_along(refined(bar, 2).rest, {1, 0, 0}, 0);
    EXPECT_NEAR(width.high - 1, 0.8 + 0.01 * extent_of(points), 0.05) << kind;
  }
}

TEST(FitOperations, a_limb_of_a_surface_takes_only_what_hangs_together_round_its_bones) {
  // Two tubes side by side, closer together than they are long.
  const auto leg = [](double x) { return tube({{x, 0, 0}, {x, -4, 0}}, {0.5, 0.5}); };
  Points points = leg(0);
  const Points other = leg(1.5);
  points.insert(points.end(), other.begin(), other.end());
  std::ostringstream faces;
  for (int side = 0; side < 2; ++side) {
    for (int step = 0; step < 8; ++step) {
      for (int k = 0; k < 12; ++k) {
        const int first = 108 * side + 12 * step + 1;
        faces << "f " << first + k << " " << first + (k + 1) % 12 << " "
              << first + 12 + (k + 1) % 12 << " " << first + 12 + k << "\n";
      }
    }
  }
  const Scene scene =
      with_model({}, "m", parse_model(ModelFormat::Obj, "m.obj", obj_of(points) + faces.str()));
  const SubdivisionLattice limb =
      lattice_of(scene, "new limb joint=0,-0.2,0 joint=0,-3.8,0 padding=0.01 fit=m");
  EXPECT_LT(interval_along(limb.rest, {1, 0, 0}, 0).high, 0.7);
  expect_inside(limb, leg(0), "leg");
}

TEST(FitOperations, flat_and_straight_models_get_a_thickness) {
  const Points flat = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}};
  const Points straight = {{1, 1, 1}, {2, 3, 4}, {3, 5, 7}};
  for (const char* kind : {"box", "cylinder sectors=4", "ogrid", "star"}) {
    const std::string line = std::string("new ") + kind + " fit=m padding=";
    expect_inside(lattice_of(scene_of(flat), line + "0"), flat, line);
    expect_inside(lattice_of(scene_of(straight), line + "0.05"), straight, line);
  }
}

std::string refusal(const Points& points, const std::string& line) {
  try {
    (void)lattice_of(scene_of(points), line);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FitOperations, name_what_they_refuse) {
  EXPECT_EQ(refusal({{1, 2, 3}}, "new cylinder fit=m"),
            "the points to fit to are all in one place");
  EXPECT_EQ(refusal(blob(), "new cylinder fit=m radius=1"),
            "'fit' and --radius exclude each other");
  EXPECT_EQ(refusal(blob(), "new sphere fit=m center=0,0,0"),
            "'fit' and --center exclude each other");
  EXPECT_EQ(refusal(blob(), "new cylinder fit=m axes=world along=x"),
            "'along' and --axes exclude each other");
  EXPECT_EQ(refusal(blob(), "new cylinder fit=m from=0,0,0"),
            "'from' and --to belong together with --fit");
  EXPECT_EQ(refusal(blob(), "new cylinder along=x"), "'along' is for --fit");
  EXPECT_EQ(refusal(blob(), "new sphere padding=1"), "'padding' is for --fit");
  EXPECT_EQ(refusal(blob(), "new sphere fit=m padding=-1"),
            "'padding' is a fraction of the diagonal, from 0 to 100");
  EXPECT_EQ(refusal(blob(), "new sphere fit=m padding=nan"), "'padding' must be a finite number");
  EXPECT_EQ(refusal(blob(), "new annulus fit=m"),
            "annulus: the points leave no hole along this axis");
  EXPECT_EQ(refusal(blob(), "new torus fit=m"), "torus: the points leave no hole along this axis");
  EXPECT_EQ(
      refusal({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0.2}}, "new barbell fit=m"),
      "barbell: the points are too wide for their length, or thick between disks");
  EXPECT_EQ(refusal(blob(), "new limb joint=0,0,0 joint=1,0,0,2 fit=m"),
            "'joint' is '1,0,0,2' with a radius, which --fit finds");
  EXPECT_EQ(refusal(blob(), "new limb joint=0,0,0 joint=0,0,0 fit=m"),
            "limb: joints 0 and 1 coincide");
  EXPECT_EQ(refusal(blob(), "new limb joint=0,0,0 fit=m"), "limb: needs two joints or more");
  EXPECT_EQ(refusal(blob(), "new limb joint=0,0,0 joint=nan,0,0 fit=m"),
            "limb: a joint must have finite coordinates");
  EXPECT_EQ(refusal(blob(), "new ogrid from=1,1,1 to=1,1,1 fit=m"), "'from' and --to must differ");
  EXPECT_EQ(refusal(blob(), "new limb joint=50,0,0 joint=60,0,0 fit=m"),
            "'fit': no points of m are round the limb, between its ends");
  write_file(::testing::TempDir() + "/espalier_fit_none.txt", "# none\n");
  EXPECT_EQ(
      refusal(blob(), "new sphere fit=m only=@" + ::testing::TempDir() + "/espalier_fit_none.txt"),
      "there are no points to fit to");
  EXPECT_EQ(refusal(blob(), "new sphere fit=m only=head"),
            "m.obj has no group or object named 'head': it has none");
  write_file(::testing::TempDir() + "/espalier_fit_all.txt", "0\n1\n2\n3\n4\n5\n6\n7\n");
  EXPECT_NE(refusal(blob(), "new limb joint=3,-1,2 joint=3.1,-1,2 fit=m only=@" +
                                ::testing::TempDir() + "/espalier_fit_all.txt")
                .find("points beyond the ends of the limb: move its first or last joint outward"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier
