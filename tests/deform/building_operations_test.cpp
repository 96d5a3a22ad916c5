/// The operations that build lattices, on a scene.

#include <gtest/gtest.h>

#include <map>

#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "lattice/io/json_lattice.h"

namespace espalier {
namespace {

using Values = std::map<std::string, Value>;
using Numbers = std::vector<double>;

/// A scene with a box of 2 × 1 × 1 unit cells named "box".
Scene scene_with_box() {
  return apply(operation_named("new box"), {},
               Arguments({{"cells", std::vector<std::int64_t>{2, 1, 1}},
                          {"max", Numbers{2, 1, 1}},
                          {"output", std::string("box")}}));
}

/// The scene after an operation on "box" whose result is "new".
Scene after(const Scene& scene, const std::string& name, Values values) {
  values.emplace("lattice", std::string("box"));
  values.emplace("output", std::string("new"));
  return apply(operation_named(name), scene, Arguments(std::move(values)));
}

std::string refusal(const std::string& name, Values values) {
  try {
    (void)after(scene_with_box(), name, std::move(values));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string word(const char* text) {
  return text;
}

TEST(BuildingOperations, leave_the_scene_before_as_it_was_byte_for_byte) {
  const Scene before = scene_with_box();
  const std::string bytes = json_text(subdivision_lattice_in(before, "box"));
  const std::vector<std::pair<std::string, Values>> edits = {
      {"extrude", {{"faces", word("0-1")}, {"normal", 0.5}}},
      {"split", {{"edge", word("0-1")}}},
      {"delete", {{"cells", word("1")}}},
      {"mirror", {}},
      {"weld", {{"tolerance", 0.25}}},
      {"transform", {{"rotate", 30.0}, {"scale", Numbers{2, 1, 1}}}},
      {"relax", {}},
      {"crease", {{"all", true}, {"sharpness", 0.0}}}};
  for (const auto& [name, values] : edits) {
    Values in_place = values;
    in_place.emplace("output", word("box"));
    const Scene changed = after(before, name, in_place);
    EXPECT_EQ(json_text(subdivision_lattice_in(before, "box")), bytes) << name;
    if (name != "weld" && name != "relax") {
      EXPECT_NE(json_text(subdivision_lattice_in(changed, "box")), bytes) << name;
    }
  }
}

TEST(BuildingOperations, transform_scales_then_rotates_then_moves) {
  const Scene scene = after(scene_with_box(), "transform",
                            {{"scale", Numbers{3, 1, 1}},
                             {"rotate", 90.0},
                             {"move", Numbers{0, 0, 5}},
                             {"about", Numbers{1, 0, 0}}});
  const SubdivisionLattice& box = subdivision_lattice_in(scene, "box");
  const SubdivisionLattice& moved = subdivision_lattice_in(scene, "new");
  for (std::size_t i = 0; i < box.rest.size(); ++i) {
    const glm::dvec3 p = box.rest[i];
    EXPECT_NEAR(moved.rest[i].x, 1 - p.y, 1e-14);
    EXPECT_NEAR(moved.rest[i].y, 3 * (p.x - 1), 1e-14);
    EXPECT_EQ(moved.rest[i].z, p.z + 5);
  }
}

TEST(BuildingOperations, transform_of_some_vertices_leaves_the_others) {
  const Scene scene = after(scene_with_box(), "transform",
                            {{"vertices", word("2,5,8,11")}, {"move", Numbers{1, 0, 0}}});
  const SubdivisionLattice& moved = subdivision_lattice_in(scene, "new");
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(moved.rest[i].x, i % 3 == 2 ? 3.0 : static_cast<double>(i % 3));
  }
}

TEST(BuildingOperations, crease_marks_lines_and_bends_and_clears) {
  const auto n_sharp = [](const Scene& scene) {
    int n = 0;
    for (const float s : subdivision_lattice_in(scene, "new").sharpness.edges) {
      n += s == 2.5f ? 1 : 0;
    }
    return n;
  };
  // Round the waist at x = 1; the box's 12 edges, four of them of two parts.
  EXPECT_EQ(n_sharp(after(scene_with_box(), "crease", {{"line", word("1-4")}, {"sharpness", 2.5}})),
            4);
  EXPECT_EQ(n_sharp(after(scene_with_box(), "crease", {{"angle", 45.0}, {"sharpness", 2.5}})), 16);
  EXPECT_EQ(
      n_sharp(after(scene_with_box(), "crease", {{"edges", word("0-1,1-2")}, {"sharpness", 2.5}})),
      2);
  const Scene cleared = after(scene_with_box(), "crease", {{"all", true}, {"sharpness", 0.0}});
  EXPECT_EQ(subdivision_lattice_in(cleared, "new").sharpness,
            smooth_sharpness(*subdivision_lattice_in(cleared, "new").complex));
}

TEST(BuildingOperations, merge_joins_any_number) {
  Scene scene = scene_with_box();
  for (int i = 1; i < 3; ++i) {
    scene = apply(operation_named("transform"), scene,
                  Arguments({{"lattice", word("box")},
                             {"move", Numbers{2.0 * i, 0, 0}},
                             {"output", "box" + std::to_string(i)}}));
  }
  scene = apply(operation_named("merge"), scene,
                Arguments({{"lattice", std::vector<std::string>{"box", "box1", "box2"}},
                           {"output", word("bar")}}));
  const SubdivisionLattice& bar = subdivision_lattice_in(scene, "bar");
  EXPECT_EQ(bar.complex->n_cells(), 6u);
  EXPECT_EQ(bar.complex->n_vertices(), 28u);
  EXPECT_EQ(bar.sharpness, automatic_sharpness(*bar.complex));
}

TEST(BuildingOperations, name_what_they_refuse) {
  EXPECT_EQ(refusal("extrude", {{"faces", word("0")}}),
            "'by' or --normal must be given, and not both");
  for (const char* bad : {"x", "", "1,", "3-1", "-1", "1-2-3", "1.5", "9999999999"}) {
    EXPECT_NE(refusal("extrude", {{"faces", word(bad)}, {"normal", 1.0}}).find("'faces' "),
              std::string::npos)
        << bad;
  }
  EXPECT_EQ(refusal("extrude", {{"faces", word("11")}, {"normal", 1.0}}),
            "extrude: face 11 does not exist, there are 11");
  EXPECT_EQ(refusal("split", {{"edge", word("0-1,1-2")}}), "'edge' must be one edge");
  EXPECT_EQ(refusal("crease", {{"edges", word("0-4")}}), "there is no edge 0-4");
  EXPECT_EQ(refusal("crease", {{"edges", word("0-1")}, {"sharpness", -1.0}}),
            "the sharpness must be a finite number from 0 up");
  EXPECT_EQ(refusal("transform", {}), "'move', --rotate or --scale must be given");
  EXPECT_EQ(refusal("delete", {{"cells", word("0-1")}}), "delete: no cell would be left");
  EXPECT_EQ(refusal("merge", {}), "lattice: two or more are merged");
  EXPECT_NE(refusal("transform", {{"scale", Numbers{1, 0, 1}}}).find("invalid lattice"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier
