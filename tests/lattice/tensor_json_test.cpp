#include "lattice/io/tensor_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

const std::string kStart = R"({"format": "espalier/1", "type": )";
const std::string kEight =
    R"("rest": [[0,0,0],[1,0,0],[0,1,0],[1,1,0],[0,0,1],[1,0,1],[0,1,1],[1,1,1]])";

TensorLattice parse_tensor(const std::string& text) {
  return std::get<TensorLattice>(parse_json_tensor("a.json", text));
}

ThbLattice parse_thb(const std::string& text) {
  return std::get<ThbLattice>(parse_json_tensor("a.json", text));
}

/// What is wrong with a file, after its name.
std::string complaint(const std::string& text) {
  try {
    (void)parse_json_tensor("a.json", text);
  } catch (const FileError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find("a.json: "), 0u) << what;
    return what.substr(std::min<std::size_t>(8, what.size()));
  }
  return "";
}

void expect_equal(const TensorLattice& a, const TensorLattice& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.axes, b.axes);
  EXPECT_EQ(a.rest, b.rest);
  EXPECT_EQ(a.pose, b.pose);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.pose_weights, b.pose_weights);
  EXPECT_EQ(a.thickness, b.thickness);
  EXPECT_EQ(a.extra_json, b.extra_json);
}

TEST(TensorJson, reads_a_lattice_as_it_is_written_by_hand) {
  const TensorLattice lattice = parse_tensor(
      kStart + R"("bspline", "counts": [2,2,2], "degree": [1,1,1], )" + kEight + R"(, "mine": 7})");
  EXPECT_EQ(lattice.kind, TensorKind::BSpline);
  EXPECT_EQ(lattice.rest[6], glm::dvec3(0, 1, 1));
  EXPECT_TRUE(lattice.axes[0].is_bezier());
  EXPECT_EQ(lattice.extra_json, R"({"mine":7})");
  const TensorLattice bezier =
      parse_tensor(kStart + R"("bezier", "counts": [2,2,2], )" + kEight + "}");
  EXPECT_EQ(bezier.kind, TensorKind::Bezier);
  EXPECT_EQ(bezier.axes, lattice.axes);
}

TEST(TensorJson, gives_back_every_kind_bit_for_bit) {
  const std::array<TensorAxis, 3> axes = {TensorAxis::make(6, 3, Ends::Natural),
                                          TensorAxis::from_knots(2, {0, 0, 0, 0.3, 1, 1, 1}),
                                          TensorAxis()};
  for (const TensorKind kind : {TensorKind::BSpline, TensorKind::Nurbs}) {
    TensorLattice lattice = make_tensor_lattice(kind, axes, {});
    lattice.pose = test::jittered(lattice.rest, 0.2, 1);
    lattice.extra_json = R"({"mine":[1,2]})";
    if (kind == TensorKind::Nurbs) {
      lattice.weights[3] = 1.0 / 3;
      lattice.pose_weights = lattice.weights;
      lattice.pose_weights[4] = 0.1;
    }
    expect_equal(parse_tensor(json_text(lattice)), lattice);
  }
  for (const Ends ends : {Ends::Uniform, Ends::Tripled, Ends::Periodic}) {
    const TensorAxis axis = TensorAxis::make(4, 3, Ends::Open);
    const TensorLattice lattice =
        make_tensor_lattice(TensorKind::BSpline, {axis, TensorAxis::make(5, 3, ends), axis}, {});
    expect_equal(parse_tensor(json_text(lattice)), lattice);
  }
}

TEST(TensorJson, gives_back_hierarchies_bit_for_bit) {
  ThbLattice lattice = make_thb_lattice({6, 5, 7}, {3, 2, 3}, {});
  lattice.pose = test::jittered(lattice.rest, 0.1, 2);
  lattice.extra_json = R"({"mine":true})";
  lattice = with_cells(
      lattice, 1,
      std::vector<GridIndex>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 3}, {1, 1, 1}});
  lattice = with_cells(lattice, 2, std::vector<GridIndex>{{1, 1, 1}, {2, 1, 1}, {5, 4, 7}});
  const ThbLattice read = parse_thb(json_text(lattice));
  EXPECT_EQ(read.hierarchy->domains(), lattice.hierarchy->domains());
  EXPECT_EQ(read.hierarchy->controls(), lattice.hierarchy->controls());
  EXPECT_EQ(read.rest, lattice.rest);
  EXPECT_EQ(read.pose, lattice.pose);
  EXPECT_EQ(read.extra_json, lattice.extra_json);
}

TEST(TensorJson, a_hierarchy_without_points_is_the_unit_box_at_rest) {
  const ThbLattice lattice = parse_thb(kStart + R"("thb", "counts": [5,5,5], "degree": [2,2,2],
                            "levels": [[[[0,0,0],[1,1,0.6666666666666666]]], [[[0,0,0],[0.5,0.5,0.5]]]]})");
  EXPECT_EQ(lattice.hierarchy->n_levels(), 3);
  EXPECT_EQ(lattice.hierarchy->domain(1).size(), 18u);
  EXPECT_EQ(lattice.hierarchy->domain(2).size(), 27u);
  EXPECT_TRUE(lattice.pose.empty());
  const Volume volume = freeze(lattice);
  const auto leaves = lattice.hierarchy->leaves();
  for (const glm::dvec3& uvw : {glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(0.9, 0.6, 0.7)}) {
    const PatchPlace place = place_of(*lattice.hierarchy, leaves, uvw);
    const glm::dvec3 at = volume.bezier(place.patch, volume.rest_points()).value(place.uvw);
    EXPECT_LT(glm::distance(at, uvw), 1e-15);
  }
}

TEST(TensorJson, says_where_and_what_is_wrong) {
  const std::string start = kStart + R"("bspline", "counts": [2,2,2], "degree": [1,1,1], )";
  EXPECT_EQ(complaint(kStart + R"("lattice"})"),
            "type: is \"lattice\", not bezier, bspline, nurbs or thb");
  EXPECT_EQ(complaint(kStart + R"("bspline"})"), "\"counts\" is missing");
  EXPECT_EQ(complaint(kStart + R"("bspline", "counts": [2,2]})"),
            "counts: has 2 values, needs 3, one an axis");
  EXPECT_EQ(complaint(kStart + R"("bspline", "counts": [2,2.5,2]})"),
            "counts[1]: is 2.5, not a whole number from 1 to 65536");
  EXPECT_EQ(complaint(start + R"("rest": [[0,0,0]]})"),
            "rest: has 1 points, counts 2 × 2 × 2 need 8");
  EXPECT_EQ(
      complaint(kStart + R"("bspline", "counts": [2,2,2], "degree": [1,3,1], )" + kEight + "}"),
      "counts[1]: 2 control points: open ends of degree 3 need at least 4");
  EXPECT_EQ(complaint(start + kEight + R"(, "ends": "closed"})"),
            "ends: is \"closed\", not open, uniform, natural, tripled or periodic");
  EXPECT_EQ(complaint(start + kEight + R"(, "ends": ["open", "open", 3]})"),
            "ends[2]: is 3, not open, uniform, natural, tripled or periodic");
  EXPECT_EQ(complaint(start + kEight + R"(, "knots": [[0,0,1],[],[]]})"),
            "knots[0]: has 3 knots, 2 control points of degree 1 need 4");
  EXPECT_EQ(complaint(start + kEight + R"(, "knots": [[],[0,1,0,1],[]]})"),
            "knots[1]: knot 2 is 0, less than knot 1, which is 1");
  EXPECT_EQ(complaint(start + kEight + R"(, "pose": [[0,0,0]]})"),
            "has 1 posed points, its counts ask for 8");
  EXPECT_EQ(complaint(start + kEight + R"(, "weights": [1,1,1,1,1,1,1,1]})"),
            "is a bspline lattice, which has no weights");
  const std::string nurbs = kStart + R"("nurbs", "counts": [2,2,2], "degree": [1,1,1], )" + kEight;
  EXPECT_EQ(complaint(nurbs + "}"), "\"weights\" is missing");
  EXPECT_EQ(complaint(nurbs + R"(, "weights": [1,1,1,1,0,1,1,1]})"),
            "weights[4] is 0, must be positive");
  EXPECT_EQ(complaint(nurbs + R"(, "weights": [1,1,1]})"), "has 3 weights, its counts ask for 8");
}

TEST(TensorJson, says_what_is_wrong_with_a_hierarchy) {
  const std::string start = kStart + R"("thb", "counts": [4,4,4], "degree": [2,2,2])";
  EXPECT_EQ(
      complaint(kStart + R"("thb", "counts": [60000,60000,60000], "degree": [2,2,2]})"),
      "counts: ask for 216000000000000 control points or more, without points at most 1000000");
  EXPECT_EQ(complaint(start + R"(, "levels": [[[[0,0,0],[0.3,1,1]]]]})"),
            "levels[0][0]: the box's side at u = 0.3 is no line between cells: a multiple of 1/2 "
            "from 0 to 1");
  EXPECT_EQ(
      complaint(
          kStart +
          R"("thb", "counts": [3,3,3], "degree": [2,2,2], "levels": [[[[0,0,0],[0.3,1,1]]]]})"),
      "levels[0][0]: the box's side at u = 0.3 is no line between cells: 0 or 1");
  EXPECT_EQ(complaint(start + R"(, "levels": [[[0,0,0]]]})"),
            "levels[0][0]: is not a box: [[u0, v0, w0], [u1, v1, w1]]");
  EXPECT_EQ(complaint(start + R"(, "levels": [[], [[[0,0,0],[0.5,0.5,0.5]]]]})"),
            "levels: the domain of level 2 holds the cell (0, 0, 0) of level 1, which lies outside "
            "the domain of level 1");
  EXPECT_EQ(complaint(start + R"(, "points": [[0,0,0]]})"),
            "counts: ask for 64 control points or more, there are 1");
  std::string text = json_text(make_thb_lattice({4, 4, 4}, {2, 2, 2}, {}));
  const auto first = text.find("[0,0,0,0,");
  text.replace(first, 9, "[0,1,0,0,");
  EXPECT_EQ(complaint(text), "points[1]: is given twice");
  text.replace(first, 9, "[0,4,0,0,");
  EXPECT_EQ(complaint(text), "points[0]: (4, 0, 0) is no control point of level 0");
}

TEST(TensorJson, survives_truncation_at_every_byte) {
  TensorLattice lattice = make_tensor_lattice(
      TensorKind::Nurbs,
      {TensorAxis(), TensorAxis::make(3, 2, Ends::Open), TensorAxis::from_knots(1, {0, 0, 1, 1})},
      {});
  for (const std::string& whole :
       {json_text(lattice), json_text(make_thb_lattice({2, 2, 2}, {1, 1, 1}, {}))}) {
    for (std::size_t n = 0; n + 2 < whole.size(); ++n) {
      EXPECT_THROW((void)parse_json_tensor("a.json", whole.substr(0, n)), FileError);
    }
  }
}

}  // namespace
}  // namespace espalier
