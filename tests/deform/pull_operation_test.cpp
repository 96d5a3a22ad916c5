/// The operation `pull` on scenes: what it takes, for lattices of all types.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "deform/embed/embed.h"
#include "deform/evaluate/displace.h"
#include "deform/injectivity/injectivity.h"
#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/operation_text.h"
#include "deform/scene/operations.h"
#include "deform/scene/pull.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

/// A flat plate of 9 × 9 points and quadrilaterals at z = 4 over [1,7]², in two groups by x; point
/// 81 is far outside.
std::string plate() {
  std::string text;
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i) {
      text += "v " + std::to_string(1 + 0.75 * i) + " " + std::to_string(1 + 0.75 * j) + " 4\n";
    }
  }
  text += "v 20 0 0\n";
  for (const auto& [name, first, last] : {std::tuple("left", 0, 4), std::tuple("right", 4, 8)}) {
    text += std::string("g ") + name + "\n";
    for (int j = 0; j < 8; ++j) {
      for (int i = first; i < last; ++i) {
        const int a = 1 + i + 9 * j;
        text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
                std::to_string(a + 10) + " " + std::to_string(a + 9) + "\n";
      }
    }
  }
  return text;
}

constexpr std::size_t kMiddle = 4 + 9 * 4;  // of the plate, at (4, 4, 4)

/// A model "m" and a lattice "box" that fills [0,8]³.
Scene scene_with(const std::string& made) {
  Scene scene = with_model({}, "m", parse_model(ModelFormat::Obj, "m.obj", plate()));
  return apply(parse_call(made + " min=0,0,0 max=8,8,8 output=box"), scene);
}

Scene box_scene() {
  return scene_with("new box cells=8,8,8");
}

std::vector<std::string> all_lattices() {
  return {"new box cells=8,8,8",
          "new bezier counts=5,5,5",
          "new bspline counts=9,9,9 ends=tripled,natural,open",
          "new bspline counts=11,11,11 ends=uniform",
          "new nurbs counts=7,7,7",
          "new thb counts=8,8,8"};
}

PulledScene pulled(const Scene& scene, const std::string& options) {
  const OperationCall call = parse_call("pull lattice=box model=m " + options);
  return pull(scene, checked(operation_named("pull").parameters, call.arguments));
}

std::string refusal(const Scene& scene, const std::string& options) {
  try {
    (void)pulled(scene, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::vector<glm::dvec3> moved_points(const Scene& scene, std::span<const glm::dvec3> points) {
  const Lattice& lattice = lattice_in(scene, "box");
  const Volume volume = lattice.freeze();
  return displaced_points(volume, embed(volume, points), points,
                          volume.displacements(lattice.posed_points()));
}

std::vector<glm::dvec3> moved_model(const Scene& scene) {
  return moved_points(scene, model_in(scene, "m").points());
}

glm::dvec3 mirrored(glm::dvec3 p) {
  p.x = 8 - p.x;
  return p;
}

TEST(PullOperation, takes_points_by_index_and_on_the_surface_to_their_targets_on_every_lattice) {
  for (const std::string& made : all_lattices()) {
    const PulledScene after =
        pulled(scene_with(made), "pick=40=4.25,4,4.5 pick-at=2.2,6.1,9=2.2,6.1,3.75");
    ASSERT_EQ(after.report.picks.size(), 2u);
    EXPECT_LT(glm::length(after.report.picks[0].residual), 1e-12) << made;
    EXPECT_LT(glm::length(after.report.picks[1].residual), 1e-12) << made;
    EXPECT_EQ(after.report.picks[0].index, kMiddle);
    EXPECT_FALSE(after.report.picks[1].index);
    EXPECT_LT(glm::distance(after.report.picks[1].place, {2.2, 6.1, 4}), 1e-14);
    EXPECT_EQ(after.report.sentence(), "");
    const auto moved = moved_model(after.scene);
    EXPECT_LT(glm::distance(moved[kMiddle], {4.25, 4, 4.5}), 1e-12) << made;
    EXPECT_EQ(moved[81], glm::dvec3(20, 0, 0));
  }
}

TEST(PullOperation, of_a_place_on_a_face_moves_the_combination_of_its_corners_there) {
  Scene scene = box_scene();
  scene = with_model(
      scene, "m", parse_model(ModelFormat::Obj, "m.obj", "v 2 2 4\nv 6 2 4\nv 2 6 4\nf 1 2 3\n"));
  const PulledScene after = pulled(scene, "pick-at=3,4,4.5=3,4,5");
  const auto moved = moved_model(after.scene);
  const glm::dvec3 place = 0.25 * moved[0] + 0.25 * moved[1] + 0.5 * moved[2];
  EXPECT_LT(glm::distance(place, {3, 4, 5}), 1e-12);
}

TEST(PullOperation, starts_from_the_pose_and_keeps_what_is_bound) {
  Scene scene = with_bound(box_scene(), "m", "box", {});
  scene = pulled(scene, "pick=40=4.5,4,4").scene;
  const PulledScene after = pulled(scene, "pick=40=4.5,4.5,4");
  EXPECT_LT(glm::distance(moved_model(after.scene)[kMiddle], {4.5, 4.5, 4}), 1e-12);
  EXPECT_EQ(after.scene.bound.at({"m", "box"}).binding, scene.bound.at({"m", "box"}).binding);
  const auto before = lattice_in(scene, "box").posed_points();
  const auto posed = lattice_in(after.scene, "box").posed_points();
  EXPECT_EQ(posed[0], before[0]);
}

TEST(PullOperation, of_a_symmetric_lattice_is_symmetric_if_that_is_asked_for) {
  for (const std::string& made : all_lattices()) {
    const PulledScene after = pulled(scene_with(made), "pick=20=3,3,4.5 symmetry=x:4");
    ASSERT_EQ(after.report.picks.size(), 2u) << made;
    EXPECT_TRUE(after.report.picks[1].is_image);
    EXPECT_LT(glm::length(after.report.picks[1].residual), 1e-12);
    const std::vector<glm::dvec3> points = {{1.3, 2.2, 3.1}, {3.2, 5.1, 4.6}, {4, 2, 4}};
    std::vector<glm::dvec3> images(3);
    std::transform(points.begin(), points.end(), images.begin(), mirrored);
    const auto moved = moved_points(after.scene, points);
    const auto moved_images = moved_points(after.scene, images);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(glm::distance(mirrored(moved[i]), moved_images[i]), 1e-12) << made;
    }
  }
}

TEST(PullOperation, of_points_on_the_plane_of_symmetry_may_move_in_it) {
  const PulledScene after = pulled(box_scene(), "pick=40=4,4.5,4 symmetry=x:4");
  EXPECT_EQ(after.report.picks.size(), 1u);
  EXPECT_LT(glm::distance(moved_model(after.scene)[kMiddle], {4, 4.5, 4}), 1e-12);
  EXPECT_EQ(refusal(box_scene(), "pick=40=4.5,4,4 symmetry=x:4"),
            "'pick' takes point 40 at (4, 4, 4) off the plane of symmetry x = 4, on which it lies: "
            "give it a goal on the plane");
  EXPECT_NE(refusal(box_scene(), "pick=40=4.5,4,4 symmetry=x:9")
                .find("'symmetry' mirrors point 40 to (14, 4, 4), which lies outside the lattice"),
            std::string::npos);
}

TEST(PullOperation, magnet_moves_a_group_as_one_and_little_else) {
  for (const std::string& made : all_lattices()) {
    const Scene scene = scene_with(made);
    const PulledScene after = pulled(scene, "magnet=left=0,0.1,0.4");
    ASSERT_EQ(after.report.groups.size(), 1u);
    EXPECT_EQ(after.report.groups[0].n_points, 45u);
    EXPECT_LT(after.report.groups[0].largest_residual, 1e-11) << made;
    const auto rest = model_in(scene, "m").points();
    const auto moved = moved_model(after.scene);
    for (std::size_t i = 0; i < 81; ++i) {
      if (i % 9 <= 4) {
        EXPECT_LT(glm::distance(moved[i], rest[i] + glm::dvec3(0, 0.1, 0.4)), 1e-11) << made;
      }
    }
    if (made.find("bezier") == std::string::npos) {  // a polynomial moves all of a plane alike
      EXPECT_LT(glm::distance(moved[8], rest[8]), 0.3) << made;
    }
  }
  const PulledScene some = pulled(box_scene(), "magnet=0-2,81=0,0,1");
  EXPECT_EQ(some.report.groups[0].n_points, 3u);
  EXPECT_EQ(some.report.groups[0].n_outside, 1u);
}

TEST(PullOperation, flatten_presses_a_group_against_a_plane_and_lets_it_slide) {
  for (const std::string& made : all_lattices()) {
    Scene scene = pulled(scene_with(made), "pick=40=4,4,4.7 pick=10=1.75,1.75,3.8").scene;
    const auto before = moved_model(scene);
    scene = pulled(scene, "flatten=0-80 plane=0,0,4.2,0,0,2").scene;
    const auto after = moved_model(scene);
    double slid = 0;
    for (std::size_t i = 0; i < 81; ++i) {
      EXPECT_NEAR(after[i].z, 4.2, 1e-10) << made;
      slid =
          std::max({slid, std::abs(after[i].x - before[i].x), std::abs(after[i].y - before[i].y)});
    }
    EXPECT_LT(slid, 1e-13) << made;  // nothing asked for it
  }
}

TEST(PullOperation, flatten_goes_to_slanted_planes_with_picks_at_the_same_time) {
  const PulledScene after = pulled(box_scene(), "flatten=0-8 plane=0,0,3,1,0,4 pick=76=4.5,7,4.25");
  const auto moved = moved_model(after.scene);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(moved[i].x + 4 * (moved[i].z - 3), 0, 1e-11);
  }
  EXPECT_LT(glm::distance(moved[76], {4.5, 7, 4.25}), 1e-12);
  EXPECT_EQ(after.report.groups[0].name, "flatten 0-8");
}

TEST(PullOperation, respects_pins_and_stiffness) {
  const PulledScene after =
      pulled(box_scene(), "pick=40=4.5,4,4 pin=0-363 stiffness=364-372=4 smooth=false");
  const Lattice& lattice = lattice_in(after.scene, "box");
  for (std::size_t i = 0; i < 364; ++i) {
    EXPECT_EQ(lattice.posed_points()[i], lattice.rest_points()[i]);
  }
  EXPECT_LT(glm::length(after.report.picks[0].residual), 1e-12);
  const auto moved = [&](std::size_t i) {
    return lattice.posed_points()[i].x - lattice.rest_points()[i].x;
  };
  const std::size_t middle = 4 + 9 * (4 + 9 * 4);
  // A knot sees its neighbours a quarter as much, and this one is not four times as stiff.
  EXPECT_NEAR(moved(middle), moved(middle + 9), 1e-14);
  EXPECT_GT(moved(middle), 0);
}

TEST(PullOperation, smooth_reaches_farther_and_stays_where_pinned) {
  for (const std::string& made : all_lattices()) {
    const Scene scene = scene_with(made);
    const auto shift_of = [&](const std::string& options) {
      const PulledScene after = pulled(scene, "pick=40=4.2,4,4 " + options);
      EXPECT_LT(glm::length(after.report.picks[0].residual), 1e-12) << made;
      const auto moved = moved_model(after.scene);
      return glm::distance(moved[0], model_in(scene, "m").points()[0]);
    };
    EXPECT_NEAR(shift_of("smooth=true"), 0.2, 1e-12) << made;
    const double pinned = shift_of("smooth=true pin=0");
    EXPECT_GT(pinned, 0.01) << made;
    EXPECT_LT(pinned, 0.2) << made;
  }
}

TEST(PullOperation, stops_before_the_first_fold_on_every_lattice) {
  for (const std::string& made : all_lattices()) {
    const PulledScene after = pulled(scene_with(made), "pick=40=7.9,4,4 stop-at-fold=true");
    EXPECT_LT(after.report.step, 1) << made;
    EXPECT_GT(after.report.step, 0.05) << made;
    EXPECT_NE(after.report.sentence().find("begins to fold"), std::string::npos) << made;
    const Lattice& lattice = lattice_in(after.scene, "box");
    const auto volume = std::make_shared<const Volume>(lattice.freeze());
    // With tripled ends space is singular at the border, at rest too.
    EXPECT_EQ(InjectivityCheck(volume).local(lattice.posed_points()).verdict,
              made.find("tripled") == std::string::npos ? Verdict::Certified : Verdict::Undecided)
        << made;
    EXPECT_NEAR(after.report.picks[0].residual.x, 3.9 * (1 - after.report.step), 1e-9) << made;
  }
}

TEST(PullOperation, shares_out_what_a_coarse_lattice_cannot_do_and_says_so) {
  const PulledScene after =
      pulled(scene_with("new bezier counts=3,3,3"),
             "pick=37=1.75,4,5 pick=38=2.5,4,3 pick=39=3.25,4,5 pick=40=4,4,3 pick=41=4.75,4,5");
  EXPECT_TRUE(after.report.has_misses);
  EXPECT_NE(after.report.sentence().find("too coarse"), std::string::npos);
  glm::dvec3 sum(0);  // a Bézier lattice can shift all: nothing is left of that
  for (const auto& pick : after.report.picks) {
    sum += pick.residual;
  }
  EXPECT_LT(glm::length(sum), 1e-12);
}

TEST(PullOperation, refine_meets_what_a_coarse_lattice_cannot_and_keeps_the_deformation) {
  Scene scene = scene_with("new thb counts=4,4,4");
  scene = pulled(scene, "pick=0=1.1,1,4.2").scene;
  const std::string picks =
      "pick=38=2.5,4,4.2 pick=39=3.25,4,3.8 pick=40=4,4,4.2 pick=41=4.75,4,3.8 pick=42=5.5,4,4.2 "
      "pick=31=4,3.25,3.8 pick=49=4,4.75,3.8";
  EXPECT_TRUE(pulled(scene, picks).report.has_misses);
  const PulledScene after = pulled(scene, picks + " refine=true");
  EXPECT_GT(after.report.n_added_control_points, 0u);
  for (const auto& pick : after.report.picks) {
    EXPECT_LT(glm::length(pick.residual), 2e-11);
  }
  const auto moved = moved_model(after.scene);
  EXPECT_LT(glm::distance(moved[40], {4, 4, 4.2}), 1e-10);
  // The refined lattice began in the pose there was: no pick, no motion.
  const PulledScene still = pulled(scene, "pick=0=1.1,1,4.2 pick=80=7,7,4 refine=true");
  EXPECT_LT(glm::distance(moved_model(still.scene)[0], {1.1, 1, 4.2}), 1e-10);
  EXPECT_NE(refusal(box_scene(), picks + " refine=true"), "no error");
}

TEST(PullOperation, refine_keeps_control_points_close_and_the_motion_local) {
  const Scene scene = scene_with("new thb counts=6,6,6");
  const std::string picks =
      "pick=40=4,4,5 pick=39=3.25,4,4 pick=41=4.75,4,4 pick=31=4,3.25,4 "
      "pick=49=4,4.75,4 ";
  const PulledScene coarse = pulled(scene, picks);
  const PulledScene fine = pulled(scene, picks + "refine=true");
  EXPECT_LT(coarse.report.picks[0].residual.z, 1e-12);
  EXPECT_GT(coarse.report.gain, 3);
  EXPECT_LT(fine.report.gain, 3);
  EXPECT_GT(fine.report.n_added_control_points, 0u);
  const auto rest = model_in(scene, "m").points();
  EXPECT_GT(glm::distance(moved_model(coarse.scene)[20], rest[20]), 0.01);
  EXPECT_LT(glm::distance(moved_model(fine.scene)[20], rest[20]), 0.01);
}

TEST(PullOperation, groups_do_what_they_can_without_throwing_control_points_away) {
  // Half of a plate up, half down, in a lattice that has no crease there.
  const PulledScene after = pulled(
      scene_with("new bspline counts=6,6,6"),
      "magnet=0-3,9-12,18-21,27-30=0,0,0.3 magnet=4-8,13-17,22-26=0,0,-0.3 pick=58=4,5.5,4.1");
  EXPECT_LE(after.report.gain, 3.5);
  EXPECT_LT(glm::length(after.report.picks[0].residual), 1e-12);
  EXPECT_GT(after.report.groups[0].largest_residual, 1e-6);
  EXPECT_LT(after.report.groups[0].largest_residual, 0.3);
  EXPECT_TRUE(after.report.has_misses);
}

TEST(PullOperation, refine_stops_at_the_most_levels_and_leaves_a_lattice_that_needs_none) {
  const Scene scene = scene_with("new thb counts=8,8,8");
  const PulledScene met = pulled(scene, "pick=40=4.1,4,4 refine=true");
  EXPECT_EQ(met.report.n_added_control_points, 0u);
  EXPECT_EQ(lattice_in(met.scene, "box").as<ThbLattice>()->hierarchy->n_levels(), 1);
  std::string picks;
  for (int i = 0; i < 81; ++i) {
    picks += "pick=" + std::to_string(i) + "=" + std::to_string(1 + 0.75 * (i % 9)) + "," +
             std::to_string(1 + 0.75 * (i / 9)) + "," + (i % 2 == 0 ? "4.05 " : "3.95 ");
  }
  const PulledScene one = pulled(scene, picks + "refine=true levels=1");
  EXPECT_LE(lattice_in(one.scene, "box").as<ThbLattice>()->hierarchy->n_levels(), 2);
}

TEST(PullOperation, refine_keeps_pinned_what_was_pinned) {
  const Scene scene = scene_with("new thb counts=4,4,4");
  // All control points of the lower half.
  const PulledScene after =
      pulled(scene,
             "pick=40=4,4,4.2 pick=39=3.25,4,3.9 pick=41=4.75,4,3.9 pick=38=2.5,4,4.2 "
             "pick=42=5.5,4,4.2 pin=0-31 refine=true");
  EXPECT_LT(after.report.picks[0].residual.z, 1e-9);
  const std::vector<glm::dvec3> low = {{4, 4, 0}, {1, 7, 0}, {8, 8, 0}};
  const auto moved = moved_points(after.scene, low);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(moved[i], low[i]), 1e-13);
  }
}

TEST(PullOperation, gives_the_same_bits_for_any_number_of_threads) {
  const auto posed = [](int threads, const std::string& options) {
    set_thread_count(threads);
    const Scene after = pulled(box_scene(), "magnet=left=0,0.1,0.4 " + options).scene;
    const auto points = lattice_in(after, "box").posed_points();
    return std::vector<glm::dvec3>(points.begin(), points.end());
  };
  for (const char* options : {"smooth=false", "smooth=true pin=0-80"}) {
    EXPECT_EQ(posed(2, options), posed(1, options));
  }
  set_thread_count(0);
}

TEST(PullOperation, is_a_line_of_the_journal) {
  const OperationCall call = {
      "pull", Arguments({{"lattice", std::string("box")},
                         {"model", std::string("m")},
                         {"pick", std::vector<std::string>{"40=4,4,4.5", "0=1,1,4"}},
                         {"pick-at", std::vector<std::string>{"6,6,9=6,6,3.8"}},
                         {"smooth", true}})};
  const std::string line = text_of(call);
  EXPECT_EQ(line,
            "pull lattice=box model=m pick=\"40=4,4,4.5\" pick=\"0=1,1,4\" "
            "pick-at=\"6,6,9=6,6,3.8\" smooth=true");
  const Scene before = box_scene();
  const Scene after = apply(parse_call(line), before);
  const Scene direct = apply(call, before);
  EXPECT_TRUE(std::ranges::equal(lattice_in(after, "box").posed_points(),
                                 lattice_in(direct, "box").posed_points()));
  EXPECT_LT(glm::distance(moved_model(after)[kMiddle], {4, 4, 4.5}), 1e-12);
}

TEST(PullOperation, names_contradictions_and_changes_nothing) {
  const Scene scene =
      with_model(box_scene(), "m",
                 parse_model(ModelFormat::Obj, "m.obj", "v 4 4 4\nv 4 4 4\nv 2 2 2\nf 1 2 3\n"));
  EXPECT_EQ(refusal(scene, "pick=0=4,4,5 pick=1=4,4,4"),
            "'pick' takes point 0 apart from point 1, which is at the same place (4, 4, 4): give "
            "both the same goal");
  EXPECT_EQ(refusal(scene, "pick=0=4,4,5 pick=1=4,4,5"), "no error");
  EXPECT_EQ(
      refusal(scene, "pick=0=4,4,5 magnet=1,2=0,0,0.5"),
      "'pick' takes point 0 apart from point 1 of --magnet, which is at the same place (4, 4, "
      "4): give both the same goal");
  EXPECT_EQ(refusal(scene, "pick=0=5,4,4 flatten=1 plane=0,0,4,0,0,1"), "no error");
  EXPECT_NE(refusal(scene, "pick=0=4,4,5 flatten=1 plane=0,0,4,0,0,1"), "no error");
}

TEST(PullOperation, names_a_folded_pose_and_a_singular_lattice) {
  Scene scene = box_scene();
  scene = apply(parse_call("move points lattice=box points=364 by=7,0,0"), scene);
  EXPECT_NE(refusal(scene, "pick=40=4.5,4,4 stop-at-fold=true")
                .find("box: the pose is folded before anything moves, in patch"),
            std::string::npos);
  const TensorAxis axis = TensorAxis::make(4, 3, Ends::Open);
  TensorLattice flat = make_tensor_lattice(TensorKind::Bezier, {axis, axis, axis}, {});
  for (glm::dvec3& p : flat.rest) {  // z = 4 + 4 (2w − 1)³, whose slope is zero half way up
    p = {8 * p.x, 8 * p.y, std::lround(3 * p.z) % 2 == 0 ? 0 : 8};
  }
  EXPECT_EQ(
      refusal(with_lattice(box_scene(), "box", flat), "pick=40=4.5,4,4"),
      "box: the lattice at rest is singular in patch 0, round (4, 4, 4): a point there has no "
      "place in it");
}

TEST(PullOperation, names_what_it_refuses) {
  const Scene scene = box_scene();
  const auto refused = [&](const std::string& options) { return refusal(scene, options); };
  EXPECT_EQ(refused(""), "'pick', --pick-at, --magnet or --flatten must be given");
  EXPECT_EQ(refused("pick=81=1,1,1"),
            "'pick' names point 81 at (20, 0, 0), which lies outside the lattice: no control point "
            "moves it");
  EXPECT_EQ(refused("pick-at=20,0,0=1,2"),
            "'pick-at' is '20,0,0=1,2', must be x,y,z=tx,ty,tz with six finite numbers: a place on "
            "the model's surface and its goal");
  EXPECT_NE(refused("pick-at=1,nan,0=1,2,3"), "no error");
  EXPECT_EQ(refused("magnet=left=1,2"),
            "'magnet' is 'left=1,2', must be NAME=dx,dy,dz or INDICES=dx,dy,dz with three finite "
            "numbers");
  EXPECT_NE(refused("magnet=middle=1,2,3").find("has no group or object named 'middle': it has"),
            std::string::npos);
  EXPECT_EQ(refused("magnet=82=1,2,3"),
            "'magnet' names point 82 of 82 points of the model, counted from 0");
  EXPECT_EQ(refused("magnet=81=1,2,3"), "'magnet 81': all its points lie outside the lattice");
  EXPECT_EQ(refused("flatten=left"),
            "'flatten' and --plane go together: what is flattened, and to what");
  EXPECT_NE(refused("flatten=left plane=0,0,0,0,0,0").find("'plane' has a normal that is zero"),
            std::string::npos);
  EXPECT_EQ(refused("flatten=left plane=0,0,0,0,0,1 symmetry=x"),
            "'symmetry' is for picks and magnets, not for --flatten");
  for (const char* bad : {"w", "x:", "x:nan", "xy", "x:1e300", ":"}) {
    EXPECT_NE(refused(std::string("pick=40=4,4,4 symmetry=") + bad).find("'symmetry' is "),
              std::string::npos)
        << bad;
  }
  EXPECT_NE(
      refused("pick=40=4,4,4 pin=729").find("'pin' is '729', must be the index of one of 729"),
      std::string::npos);
  for (const char* bad : {"0=0", "0=-1", "0", "0=nan", "=1"}) {
    EXPECT_NE(refused(std::string("pick=40=4,4,4 stiffness=") + bad).find("'stiffness' is "),
              std::string::npos)
        << bad;
  }
  EXPECT_EQ(refused("pick=40=4,4,4 levels=2"), "'levels' is for --refine");
  EXPECT_EQ(refusal(scene_with("new thb counts=8,8,8"), "pick=40=4,4,4 refine=true levels=0"),
            "'levels' must be 1 to 15");
  EXPECT_EQ(refused("pick=40=4,4,4 refine=true"),
            "'refine' needs a thb lattice, this one is of type subdivision");
}

}  // namespace
}  // namespace espalier
