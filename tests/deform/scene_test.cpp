#include "deform/scene/scene.h"

#include <gtest/gtest.h>

#include "deform/evaluate/displace.h"
#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

constexpr const char* kModel = "v 0.5 0.5 0.5\nv 0.25 0.5 0.75\nv 3 3 3\n";

/// A model "m" and a lattice "rest": two by two by two cells from 0 to 2 by 2 by 2.
Scene small_scene() {
  Scene scene = with_model({}, "m", parse_model(ModelFormat::Obj, "m.obj", kModel));
  return with_lattice(std::move(scene), "rest", test::prism(test::grid_section(2, 2), 2));
}

/// The same lattice moved by a vector.
SubdivisionLattice moved_by(const SubdivisionLattice& lattice, const glm::dvec3& by) {
  SubdivisionLattice moved = lattice;
  moved.pose = lattice.rest;
  for (glm::dvec3& point : moved.pose) {
    point += by;
  }
  return moved;
}

Scene deformed_scene(const Scene& scene, const std::string& model, const std::string& output) {
  return apply(operation_named("deform"), scene,
               Arguments({{"model", model},
                          {"lattice", std::string("rest")},
                          {"freeze", std::string("uniform:1")},
                          {"output", output}}));
}

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Scene, says_what_it_has_not) {
  const Scene scene = small_scene();
  EXPECT_EQ(error_of([&] { (void)model_in(scene, "rest"); }),
            "the scene has no model named 'rest'");
  EXPECT_EQ(error_of([&] { (void)lattice_in(scene, "m"); }), "the scene has no lattice named 'm'");
  EXPECT_EQ(error_of([&] { (void)pose_in(scene, "rest"); }), "the scene has no pose named 'rest'");
}

TEST(Scene, a_copy_shares_what_did_not_change_and_is_its_own_otherwise) {
  const Scene before = with_bound(small_scene(), "m", "rest", {"uniform:1", "keep"});
  const Scene after = with_model(before, "n", model_in(before, "m"));
  EXPECT_FALSE(before.models.contains("n"));
  EXPECT_EQ(lattice_in(after, "rest").as<SubdivisionLattice>(),
            lattice_in(before, "rest").as<SubdivisionLattice>());
  EXPECT_EQ(model_in(after, "n").bytes().data(), model_in(before, "m").bytes().data());
  EXPECT_EQ(after.bound.at({"m", "rest"}).volume, before.bound.at({"m", "rest"}).volume);
}

TEST(Scene, binding_twice_keeps_the_binding_and_another_freeze_replaces_it) {
  const Scene once = with_bound(small_scene(), "m", "rest", {"uniform:1", "keep"});
  const Scene twice = with_bound(once, "m", "rest", {"uniform:1", "keep"});
  const Scene finer = with_bound(once, "m", "rest", {"uniform:2", "keep"});
  const auto bound = [](const Scene& scene) { return scene.bound.at({"m", "rest"}); };
  EXPECT_EQ(bound(once).binding->counts().inside, 2u);
  EXPECT_EQ(bound(twice).binding, bound(once).binding);
  EXPECT_NE(bound(finer).binding, bound(once).binding);
  EXPECT_EQ(bound(finer).freeze, "uniform:2");
  EXPECT_EQ(bound(finer).volume->n_patches(), 8 * bound(once).volume->n_patches());
}

TEST(Scene, replacing_a_model_or_a_lattice_drops_its_bindings_and_no_others) {
  Scene scene = with_bound(small_scene(), "m", "rest", {"uniform:1", "keep"});
  scene =
      with_bound(with_model(scene, "n", model_in(scene, "m")), "n", "rest", {"uniform:1", "keep"});
  const Scene other_model = with_model(scene, "m", model_in(scene, "n"));
  EXPECT_FALSE(other_model.bound.contains({"m", "rest"}));
  EXPECT_TRUE(other_model.bound.contains({"n", "rest"}));
  const Scene other_lattice = with_lattice(scene, "rest", lattice_in(scene, "rest"));
  EXPECT_TRUE(other_lattice.bound.empty());
}

TEST(Scene, deforming_a_model_in_place_binds_it_anew_where_it_went) {
  Scene scene = small_scene();
  scene =
      with_lattice(scene, "rest", moved_by(subdivision_lattice_in(scene, "rest"), {0.25, 0, 0}));
  const Scene once = deformed_scene(scene, "m", "m");
  EXPECT_FALSE(once.bound.contains({"m", "rest"}));
  EXPECT_EQ(model_in(once, "m").points()[0], glm::dvec3(0.75, 0.5, 0.5));
  const Scene twice = deformed_scene(once, "m", "m");
  EXPECT_EQ(model_in(twice, "m").points()[0], glm::dvec3(1, 0.5, 0.5));
  // Six more steps leave the lattice at x = 2: the point stays where it is outside.
  Scene last = twice;
  for (int i = 0; i < 8; ++i) {
    last = deformed_scene(last, "m", "m");
  }
  EXPECT_EQ(model_in(last, "m").points()[0], glm::dvec3(2.25, 0.5, 0.5));
  EXPECT_EQ(model_in(last, "m").points()[2], glm::dvec3(3));
}

TEST(Scene, deforming_leaves_the_model_and_keeps_its_binding_for_the_next_pose) {
  Scene scene = small_scene();
  scene.poses["there"] = std::make_shared<const Pose>(
      Pose{*subdivision_lattice_in(scene, "rest").complex,
           moved_by(subdivision_lattice_in(scene, "rest"), {0, 0, 0.5}).pose});
  const Scene once = deformed_scene(scene, "m", "out");
  const Arguments posed({{"model", std::string("m")},
                         {"lattice", std::string("rest")},
                         {"pose", std::string("there")},
                         {"freeze", std::string("uniform:1")},
                         {"output", std::string("out")}});
  const Scene twice = apply(operation_named("deform"), once, posed);
  EXPECT_EQ(model_in(once, "out").bytes(), kModel);
  EXPECT_EQ(model_in(twice, "m").bytes(), kModel);
  EXPECT_EQ(model_in(twice, "out").points()[1], glm::dvec3(0.25, 0.5, 1.25));
  EXPECT_EQ(twice.bound.at({"m", "rest"}).binding, once.bound.at({"m", "rest"}).binding);
}

TEST(Scene, an_operation_that_fails_leaves_it_as_it_was) {
  const Scene scene = small_scene();
  EXPECT_EQ(error_of([&] { (void)deformed_scene(scene, "nobody", "out"); }),
            "the scene has no model named 'nobody'");
  EXPECT_EQ(scene.models.size(), 1u);
  EXPECT_EQ(scene.lattices.size(), 1u);
  EXPECT_TRUE(scene.bound.empty());
}

TEST(Scene, freezes_adaptively_or_uniformly_and_refuses_all_else) {
  const SubdivisionLattice lattice = test::prism(test::grid_section(1, 1), 1);
  EXPECT_EQ(freeze(lattice, "uniform:2").n_patches(), 64u);
  EXPECT_EQ(freeze(lattice, "adaptive").n_patches(), 1u);
  EXPECT_EQ(freeze(lattice, "adaptive:1e-7").n_patches(), 1u);
  for (const std::string word :
       {"", "uniform", "uniform:0", "uniform:9", "uniform: 2", "adaptive:", "adaptive:0",
        "adaptive:nan", "adaptive:1", "adaptively", "adaptive:1e-3:", "adaptive:1e-3:2",
        "adaptive:1e-3:nan", "adaptive::1e-3", "adaptive:1e-3:1e-3:1e-3"}) {
    EXPECT_EQ(error_of([&] { (void)freeze(lattice, word); }),
              "'freeze' is '" + word +
                  "', must be adaptive, adaptive:TOLERANCE from 1e-12 to 0.1, "
                  "adaptive:TOLERANCE:TOLERANCE_OF_DERIVATIVES, or uniform:N with N from 1 to 8");
  }
}

TEST(Scene, freezes_with_finer_derivatives_where_they_are_asked_for) {
  const SubdivisionLattice lattice = test::prism(test::flower_section(5), 1);
  EXPECT_EQ(freeze(lattice, "adaptive:1e-5:1e-2").n_patches(),
            freeze(lattice, "adaptive").n_patches());
  EXPECT_GT(freeze(lattice, "adaptive:1e-5:1e-5").n_patches(),
            freeze(lattice, "adaptive").n_patches());
}

}  // namespace
}  // namespace espalier
