#include <gtest/gtest.h>

#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/operation_text.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// A model "m" in a lattice "box" of eight cells from 0 to 2.
Scene bound_scene() {
  Scene scene = with_model({}, "m", parse_model(ModelFormat::Obj, "m.obj", "v 1 1 1\n"));
  scene = with_lattice(std::move(scene), "box", test::prism(test::grid_section(2, 2), 2));
  return with_bound(scene, "m", "box", {});
}

Scene done(const Scene& scene, const std::string& line) {
  return apply(parse_call(line), scene);
}

std::string refusal(const std::string& line) {
  try {
    (void)done(bound_scene(), line);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(PoseOperations, move_points_moves_these_and_no_others_and_keeps_what_is_bound) {
  const Scene before = bound_scene();
  const Scene after = done(before, "move points lattice=box points=3,0 to=7,8,9,-1,-2,-3");
  std::vector<glm::dvec3> expected = subdivision_lattice_in(before, "box").rest;
  expected[3] = {7, 8, 9};
  expected[0] = {-1, -2, -3};
  EXPECT_EQ(subdivision_lattice_in(after, "box").pose, expected);
  EXPECT_EQ(subdivision_lattice_in(after, "box").rest, subdivision_lattice_in(before, "box").rest);
  EXPECT_EQ(after.bound.at({"m", "box"}).binding, before.bound.at({"m", "box"}).binding);
  const Scene further = done(after, "move points lattice=box points=3 by=1,0,-1");
  EXPECT_EQ(subdivision_lattice_in(further, "box").pose[3], glm::dvec3(8, 8, 8));
}

TEST(PoseOperations, moving_points_at_rest_unties_the_models_and_refuses_an_invalid_lattice) {
  const Scene after = done(bound_scene(), "move points lattice=box points=0 by=-1,0,0 shape=rest");
  EXPECT_EQ(subdivision_lattice_in(after, "box").rest[0], glm::dvec3(-1, 0, 0));
  EXPECT_TRUE(after.bound.empty());
  EXPECT_NE(refusal("move points lattice=box points=0 by=9,0,0 shape=rest"), "no error");
}

TEST(PoseOperations, control_points_of_grids_are_moved_at_rest_too) {
  for (const char* line : {"new bspline output=grid", "new nurbs output=grid",
                           "new bezier output=grid", "new thb output=grid"}) {
    Scene scene = done(bound_scene(), line);
    scene = done(scene, "bind model=m lattice=grid");
    const Scene after = done(scene, "move points lattice=grid points=0 by=-.1,0,0 shape=rest");
    const glm::dvec3 before = lattice_in(scene, "grid").rest_points()[0];
    EXPECT_EQ(lattice_in(after, "grid").rest_points()[0], before + glm::dvec3(-.1, 0, 0));
    EXPECT_EQ(lattice_in(after, "grid").posed_points()[0], before + glm::dvec3(-.1, 0, 0));
    EXPECT_EQ(after.bound.size(), 1u);  // to the box
  }
}

TEST(PoseOperations, a_grid_at_rest_is_not_turned_inside_out) {
  const Scene scene = done({}, "new bezier output=grid counts=2,2,2");
  const std::string line = "move points lattice=grid points=1,3,5,7 by=-2,0,0 shape=rest";
  EXPECT_NO_THROW((void)done(scene, line));  // as a whole it may be a mirror image
  const Scene spline = done({}, "new bspline output=grid counts=4,2,2 degree=1,1,1");
  EXPECT_THROW(
      (void)done(spline, "move points lattice=grid points=2,6,10,14 by=-0.5,0,0 shape=rest"),
      LatticeError);
}

TEST(PoseOperations, set_pose_goes_back_to_rest) {
  const Scene posed = done(bound_scene(), "move points lattice=box points=0 by=1,1,1");
  EXPECT_TRUE(subdivision_lattice_in(done(posed, "set pose lattice=box"), "box").pose.empty());
}

TEST(PoseOperations, a_models_influence_says_how_much_of_the_motion_is_saved) {
  std::string all = "0";
  for (int i = 1; i < 27; ++i) {
    all += "," + std::to_string(i);
  }
  Scene scene = done(bound_scene(), "move points lattice=box points=" + all + " by=1,0,0");
  scene = done(scene, "set influence model=m strength=0.25");
  const std::string path = ::testing::TempDir() + "/espalier_influence.obj";
  (void)done(scene, "save deformed model=m path=" + path);
  EXPECT_EQ(read_file(path), "v 1.25 1 1\n");
  EXPECT_EQ(with_model(scene, "m", model_in(scene, "m")).influences.size(), 0u);
  EXPECT_NE(refusal("set influence model=m only=nothing"), "no error");
  EXPECT_NE(refusal("set influence model=none"), "no error");
}

TEST(PoseOperations, poses_of_limbs_keep_what_is_bound_and_may_stay_in_place) {
  const Scene before = bound_scene();
  const std::string turn = "pose rotate lattice=box about=1,1,0 angle=90 axis=0,0,1";
  const Scene after = done(before, turn);
  EXPECT_LT(glm::distance(subdivision_lattice_in(after, "box").pose[0], glm::dvec3(2, 0, 0)),
            1e-15);
  EXPECT_EQ(after.bound.at({"m", "box"}).binding, before.bound.at({"m", "box"}).binding);
  const Scene copy = done(before, turn + " output=other");
  EXPECT_TRUE(subdivision_lattice_in(copy, "box").pose.empty());
  EXPECT_EQ(subdivision_lattice_in(copy, "other").pose, subdivision_lattice_in(after, "box").pose);
  const Scene still =
      done(before, "pose bend lattice=box from=0,0,0 to=1,0,0 towards=0,1,0 angle=0");
  EXPECT_TRUE(subdivision_lattice_in(still, "box").pose.empty());
}

TEST(PoseOperations, limb_turns_one_of_two_legs_that_lie_beyond_the_joint) {
  Scene scene = done({}, "new box output=u cells=5,4,1 min=0,0,0 max=5,4,1");
  scene = done(scene, "delete lattice=u cells=1,2,3,6,7,8,11,12,13 output=u");
  const std::string turn =
      "pose rotate lattice=u about=0.5,1.5,0.5 along=0,-1,0 axis=1,0,0 angle=30 falloff=0.5";
  const auto n_moved = [](const Scene& posed) {
    const SubdivisionLattice& lattice = subdivision_lattice_in(posed, "u");
    int n = 0;
    for (std::size_t i = 0; i < lattice.rest.size(); ++i) {
      n += lattice.pose[i] != lattice.rest[i] ? 1 : 0;
      EXPECT_TRUE(lattice.pose[i] == lattice.rest[i] || lattice.rest[i].y <= 1);
    }
    return n;
  };
  EXPECT_EQ(n_moved(done(scene, turn)), 16);
  EXPECT_EQ(n_moved(done(scene, turn + " limb=true")), 8);
  EXPECT_EQ(refusal("pose rotate lattice=box about=0,0,0 angle=30 limb=true"),
            "'limb' needs --along, the direction of the limb, not zero");
  EXPECT_EQ(refusal("pose rotate lattice=box about=0,0,0 along=1,0,0 angle=30 limb=true "
                    "vertices=0"),
            "'limb' and --vertices exclude each other");
  EXPECT_THROW((void)done(scene,
                          "pose rotate lattice=u about=2.5,3.5,0.5 along=0,-1,0 axis=1,0,0 "
                          "angle=30 limb=true"),
               ParameterError)
      << "both legs and all between them";
}

TEST(PoseOperations, save_deformed_writes_what_the_bound_lattices_do_and_leaves_the_scene) {
  std::string all = "0";
  for (int i = 1; i < 27; ++i) {
    all += "," + std::to_string(i);
  }
  const Scene posed = done(bound_scene(), "move points lattice=box points=" + all + " by=0,0,2");
  const std::string path = ::testing::TempDir() + "/espalier_save_deformed.obj";
  const Scene after = done(posed, "save deformed model=m path=" + path);
  EXPECT_EQ(read_file(path), "v 1 1 3\n");
  EXPECT_EQ(after.models.size(), 1u);
  EXPECT_EQ(model_in(after, "m").bytes(), "v 1 1 1\n");
}

TEST(PoseOperations, name_what_they_refuse) {
  EXPECT_EQ(refusal("move points lattice=box points=27 by=0,0,0"),
            "'points' has 27, must be from 0 to 26");
  EXPECT_EQ(refusal("move points lattice=box points=-1 by=0,0,0"),
            "'points' has -1, must be from 0 to 26");
  EXPECT_EQ(refusal("move points lattice=box points=0"),
            "needs 'to', positions, or 'by', a vector: one of them");
  EXPECT_EQ(refusal("move points lattice=box points=0,1 to=1,2,3"),
            "'to' has 3 numbers, must have three for each of 2 points");
  EXPECT_EQ(refusal("move points lattice=box points=5 by=1e300,0,0"),
            "point 5 of box would be too far away, or nowhere");
  EXPECT_EQ(refusal("set pose lattice=box pose=none"), "the scene has no pose named 'none'");
  EXPECT_EQ(refusal("save deformed model=none path=x.obj"),
            "none is not bound to a lattice: nothing deforms it");
}

}  // namespace
}  // namespace espalier
