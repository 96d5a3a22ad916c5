#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class InfoCommand : public CommandLineTest {};

TEST_F(InfoCommand, tells_a_lattice_in_words) {
  done({"new", "box", "--cells", "2", "2", "1", "--max", "1", "1", "0.5", "-o", "box.json"});
  EXPECT_EQ(done({"info", "box.json"}),
            "subdivision lattice, catmull-clark scheme\n"
            "  18 vertices, 33 edges, 20 faces, 4 cells\n"
            "  faces at inner edges     1 × 4\n"
            "  faces at boundary edges  20 × 2, 12 × 3\n"
            "  faces of cells           4 × 6\n"
            "  cells meet in an edge only at 0 edges, in a vertex only at 0 vertices\n"
            "  cells inverted at a corner: 0\n"
            "  sharp edges 20, semi-sharp 0; corners 8, semi-sharp 0\n"
            "  box 0 0 0  to  1 1 0.5\n"
            "  valid\n");
}

TEST_F(InfoCommand, tells_a_lattice_as_json) {
  done({"new", "cylinder", "--sectors", "5", "--layers", "2", "--to", "0", "0", "1", "--scheme",
        "mj96", "-o", "bar.ovm"});
  const Json info = Json::parse(done({"info", "bar.ovm", "--json"}));
  EXPECT_EQ(info["type"], "subdivision");
  EXPECT_EQ(info["scheme"], "mj96");
  EXPECT_EQ(info["vertices"], 18);
  EXPECT_EQ(info["edges"], 42);
  EXPECT_EQ(info["faces"], 35);
  EXPECT_EQ(info["cells"], 10);
  EXPECT_EQ(info["valences"], Json::parse(R"({"faces_at_inner_edges": {"4": 5, "5": 2},
      "faces_at_boundary_edges": {"2": 10, "3": 25}, "faces_of_cells": {"5": 10}})"));
  EXPECT_EQ(info["tags"], Json::parse(R"({"sharp_edges": 10, "semi_sharp_edges": 0, "corners": 0,
      "semi_sharp_vertices": 0})"));
  EXPECT_EQ(info["has_pose"], false);
  EXPECT_EQ(info["valid"], true);
  EXPECT_EQ(info["defects"], Json::array());
  EXPECT_EQ(info["min"][2], 0.0);
  EXPECT_EQ(info["max"][2], 1.0);
}

TEST_F(InfoCommand, counts_tags_of_every_kind) {
  done({"new", "box", "-o", "box.json"});
  Json json = read_json("box.json");
  json["sharp_edges"] = {{0, 1, 10}, {1, 2, 2.5}, {0, 3, 0.5}};
  json["sharp_vertices"] = {{0, 1e30}, {2, 1}};
  write_json("tagged.json", json);
  EXPECT_EQ(Json::parse(done({"info", "tagged.json", "--json"}))["tags"],
            Json::parse(R"({"sharp_edges": 1, "semi_sharp_edges": 2, "corners": 1,
                            "semi_sharp_vertices": 1})"));
}

TEST_F(InfoCommand, tells_that_a_lattice_is_posed) {
  done({"new", "box", "-o", "box.json"});
  pose_by("box.json", "posed.json", AffineMap());
  EXPECT_EQ(Json::parse(done({"info", "posed.json", "--json"}))["has_pose"], true);
  EXPECT_EQ(done({"info", "posed.json"}).substr(0, 49),
            "subdivision lattice, catmull-clark scheme, posed\n");
}

TEST_F(InfoCommand, tells_a_model_in_words_and_as_json) {
  write_file("m.obj", "v -1 0.5 2\nv 1 0 0\nv 0 3 0\nv 0 0 0\nvn 0 0 1\nf 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(done({"info", "m.obj"}),
            "model with 4 points, 2 faces, 1 normals\n  box -1 0 0  to  1 3 2\n");
  EXPECT_EQ(Json::parse(done({"info", "m.obj", "--json"})),
            Json::parse(R"({"type": "model", "points": 4, "faces": 2, "normals": 1,
                            "min": [-1.0, 0.0, 0.0], "max": [1.0, 3.0, 2.0]})"));
}

TEST_F(InfoCommand, of_an_invalid_lattice_fails_and_lists_every_defect) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.json"});
  Json json = read_json("cube.json");
  json["cells"][0].erase(0);
  write_json("open.json", json);

  const Outcome text = run({"info", "open.json"});
  EXPECT_EQ(text.status, 1);
  EXPECT_EQ(text.err, "");
  EXPECT_EQ(text.out.substr(0, text.out.find("\n  cell-")),
            "subdivision lattice with 8 vertices, 6 faces, 1 cell\n  not valid, 2 defects");

  const Outcome report = run({"info", "open.json", "--json"});
  EXPECT_EQ(report.status, 1);
  const Json info = Json::parse(report.out);
  EXPECT_EQ(info["valid"], false);
  EXPECT_EQ(info["vertices"], 8);
  EXPECT_EQ(info["edges"], nullptr);
  ASSERT_EQ(info["defects"].size(), 2u);
  EXPECT_EQ(info["defects"][0]["kind"], "cell-not-closed");
  EXPECT_EQ(info["defects"][0]["element"], "cell");
  EXPECT_EQ(info["defects"][0]["index"], 0);
  EXPECT_EQ(info["defects"][1]["kind"], "unused-face");
  EXPECT_EQ(info["defects"][1]["index"], 0);
}

TEST_F(InfoCommand, says_nothing_when_quiet_and_answers_by_its_exit_status) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.json"});
  EXPECT_EQ(done({"info", "cube.json", "--quiet"}), "");
  Json json = read_json("cube.json");
  json["cells"][0].erase(0);
  write_json("open.json", json);
  const Outcome outcome = run({"info", "open.json", "--quiet"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

}  // namespace
}  // namespace espalier::tools
