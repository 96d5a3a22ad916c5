#include "deform/scene/lock.h"

#include <gtest/gtest.h>

#include "deform/scene/bind.h"
#include "lattice/core/error.h"
#include "tests/support/families.h"
#include "tests/support/lock_jumps.h"

namespace espalier {
namespace {

using test::crossing_scene;
using test::Jumps;
using test::largest_jumps;

struct Case {
  std::string name;
  SubdivisionLattice lattice;
  std::vector<glm::dvec2> lines;
};

/// Lattices that stand on z = 0, with lines through regular and extraordinary parts.
std::vector<Case> cases() {
  return {{"grid", test::prism(test::grid_section(3, 3), 4), {{0.3, 0.4}, {1.5, 1.25}, {2, 2.9}}},
          {"flower", test::prism(test::flower_section(5), 3), {{0.1, 0.05}, {0.4, -0.3}}},
          {"wheel", test::prism(test::wheel_section(6), 3), {{0.25, 0.1}, {-0.3, 0.2}}}};
}

TEST(Lock, joins_the_motion_to_what_stays_in_value_slope_and_curvature) {
  for (const auto& [name, lattice, lines] : cases()) {
    const Scene scene = crossing_scene(lattice, lines);
    const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.8, 3);
    const Jumps free = largest_jumps(scene, pose);
    EXPECT_GT(free[0], 0.05) << name;
    EXPECT_GT(free[1], 0.05) << name;
    const Jumps c0 = largest_jumps(with_lock(scene, "m", "rest", "C0"), pose);
    EXPECT_LT(c0[0], 1e-14) << name;
    EXPECT_GT(c0[1], 0.05) << name;
    for (const char* option : {"C1", "C2"}) {
      const Jumps jumps = largest_jumps(with_lock(scene, "m", "rest", option), pose);
      EXPECT_LT(jumps[0], 1e-14) << name << option;
      EXPECT_LT(jumps[1], 1e-13) << name << option;
      EXPECT_LT(jumps[2], 1e-12) << name << option;
      EXPECT_GT(jumps[3], 0.05) << name << option << ": it must move farther in";
    }
  }
}

TEST(Lock, of_faces_by_number_is_that_of_the_faces_the_model_crosses) {
  for (const auto& [name, lattice, lines] : cases()) {
    const Scene scene = crossing_scene(lattice, lines);
    const Lock crossed = with_lock(scene, "m", "rest", "C1").bound.at({"m", "rest"}).lock;
    ASSERT_FALSE(crossed.faces.empty());
    std::string option = "C1:";
    for (const std::int32_t face : crossed.faces) {
      option += (option.size() > 3 ? "," : "") + std::to_string(face);
      for (const VertexId vertex : lattice.complex->vertices(FaceId{face})) {
        EXPECT_EQ(lattice.rest[vertex.index()].z, 0) << name;
      }
    }
    const Lock named = with_lock(scene, "m", "rest", option).bound.at({"m", "rest"}).lock;
    EXPECT_EQ(named.faces, crossed.faces);
    EXPECT_EQ(named.controls, crossed.controls);
    EXPECT_EQ(named.option, option);
  }
}

TEST(Lock, goes_when_it_is_none_and_when_the_model_is_bound_anew) {
  const Scene scene = crossing_scene(cases()[0].lattice, cases()[0].lines);
  const Scene locked = with_lock(scene, "m", "rest", "C0");
  const Lock none = with_lock(locked, "m", "rest", "none").bound.at({"m", "rest"}).lock;
  EXPECT_TRUE(none.controls.empty());
  const Scene anew = with_bound(locked, "m", "rest", {"uniform:1", "keep"});
  EXPECT_EQ(anew.bound.at({"m", "rest"}).lock.option, "none");
}

TEST(Lock, refuses_words_that_are_none_and_faces_that_are_not_on_the_boundary) {
  const Scene scene = crossing_scene(test::prism(test::grid_section(2, 1), 1), {{0.5, 0.5}});
  const auto error = [&](const std::string& option) -> std::string {
    try {
      (void)with_lock(scene, "m", "rest", option);
    } catch (const ParameterError& caught) {
      return caught.what();
    }
    return "no error";
  };
  for (const std::string option : {"", "C", "C3", "c1", "C1:", "C1:1,", "C1:,1", "C1:1;2", "C1:x",
                                   "C1:1.5", "C1:99999999999", "none:1"}) {
    EXPECT_EQ(error(option).find("'lock' is '" + option + "', must be none, C0, C1 or C2"), 0u)
        << error(option);
  }
  EXPECT_EQ(error("C1:11"),
            "'lock' is 'C1:11': in rest face 11 does not exist: the lattice has 11");
  EXPECT_EQ(error("C2:-1"),
            "'lock' is 'C2:-1': in rest face -1 does not exist: the lattice has 11");
}

TEST(TornFaces, are_those_that_move_where_they_leave_the_lattice) {
  const auto [name, lattice, lines] = cases()[0];
  const Scene scene = with_crossings(crossing_scene(lattice, lines), "m", "rest");
  const Crossings& crossings = *scene.bound.at({"m", "rest"}).crossings;
  // Faces 2i and 2i + 1 cross at line i.
  const auto torn = [&](const std::vector<glm::dvec3>& pose, const Influence& influence = {}) {
    return torn_faces(crossings, lattice.rest, pose, influence, 1e-9);
  };
  EXPECT_EQ(torn(lattice.rest), (std::vector<std::int32_t>{}));
  std::vector<glm::dvec3> shifted = lattice.rest;
  for (glm::dvec3& point : shifted) {
    point.x += 0.5;
  }
  EXPECT_EQ(torn(shifted), (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(torn(shifted, {0, {}}), (std::vector<std::int32_t>{}));
  // Points 6 … 11 belong to the second line.
  Influence some;
  some.weights.assign(18, 1.0);
  std::fill(some.weights.begin() + 6, some.weights.begin() + 12, 0.0);
  EXPECT_EQ(torn(shifted, some), (std::vector<std::int32_t>{0, 1, 4, 5}));
  // What the border does not do does not tear: only layers above the first move.
  std::vector<glm::dvec3> above = shifted;
  std::copy(lattice.rest.begin(), lattice.rest.begin() + 16, above.begin());
  EXPECT_EQ(torn(above), (std::vector<std::int32_t>{}));
  // The corner control point at (0, 0) reaches two cells far: the first line and the second.
  std::vector<glm::dvec3> corner = lattice.rest;
  corner[0].z -= 0.25;
  EXPECT_EQ(torn(corner), (std::vector<std::int32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace espalier
