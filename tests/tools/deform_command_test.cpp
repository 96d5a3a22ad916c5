#include <cmath>
#include <cstdio>

#include "deform/model/model_file.h"
#include "lattice/core/file.h"
#include "tests/deform/odd_obj_files.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class DeformCommand : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    done({"new", "box", "--cells", "3", "2", "2", "--min", "-1", "-1", "-1", "--max", "2", "1", "1",
          "-o", "rest.json"});
  }
};

/// The n-th line of three numbers that begins with a word.
glm::dvec3 triple(const std::string& text, const std::string& word, std::size_t n = 0) {
  std::size_t at = text.find(word + " ");
  for (; n > 0; --n) {
    at = text.find("\n" + word + " ", at) + 1;
  }
  glm::dvec3 point(NAN);
  EXPECT_EQ(
      std::sscanf(text.c_str() + at + word.size(), "%lf %lf %lf", &point.x, &point.y, &point.z), 3);
  return point;
}

glm::dvec3 quarter_turn(const glm::dvec3& x) {
  return {-x.y, x.x, x.z};
}

TEST_F(DeformCommand, at_rest_writes_every_file_byte_for_byte) {
  for (const OddObjFile& file : odd_obj_files()) {
    write_file("in.obj", file.bytes);
    done({"deform", "in.obj", "--lattice", "rest.json", "--freeze", "uniform:1", "-o", "out.obj"});
    EXPECT_EQ(read_file("out.obj"), file.bytes) << file.what;
  }
}

TEST_F(DeformCommand, counts_the_points_by_status) {
  write_file("m.obj", "v 0 0 0\nv 0.5 0.5 0.5\nv 2 0 0\nv 5 0 0\nf 1 2 3 4\n");
  EXPECT_EQ(done({"deform", "m.obj", "--lattice", "rest.json", "-o", "out.obj"}),
            "out.obj: 4 points, 1 faces\n"
            "  2 inside, 1 on the border, 1 outside, 0 unconverged\n");
  const Json report =
      Json::parse(done({"deform", "m.obj", "--lattice", "rest.json", "-o", "out.obj", "--json"}));
  EXPECT_EQ(report["output"], "out.obj");
  EXPECT_EQ(report["points"], 4);
  EXPECT_EQ(report["faces"], 1);
  EXPECT_EQ(report["inside"], 2);
  EXPECT_EQ(report["border"], 1);
  EXPECT_EQ(report["outside"], 1);
  EXPECT_EQ(report["unconverged"], 0);
}

TEST_F(DeformCommand, an_affine_pose_moves_points_by_the_affine_map_wherever_it_is_found) {
  write_file("m.obj", "v 0.25 -0.5 0.125\nv 1.5 0.75 -0.875\n");
  const AffineMap map;
  pose_by("rest.json", "posed.json", map);
  Json moved = read_json("posed.json");
  moved["vertices"] = moved["pose"];
  moved.erase("pose");
  write_json("moved.json", moved);
  done({"deform", "m.obj", "--lattice", "posed.json", "-o", "own_pose.obj"});
  done({"deform", "m.obj", "--lattice", "rest.json", "--pose", "posed.json", "-o", "pose_key.obj"});
  done({"deform", "m.obj", "--lattice", "rest.json", "--pose", "moved.json", "-o", "points.obj"});
  for (const char* file : {"own_pose.obj", "pose_key.obj", "points.obj"}) {
    const std::string text = read_file(file);
    EXPECT_LT(glm::distance(triple(text, "v"), map({0.25, -0.5, 0.125})), 3e-6) << file;
    EXPECT_LT(glm::distance(triple(text, "v", 1), map({1.5, 0.75, -0.875})), 3e-6) << file;
  }
  EXPECT_EQ(read_file("own_pose.obj"), read_file("pose_key.obj"));
  EXPECT_EQ(read_file("own_pose.obj"), read_file("points.obj"));
}

TEST_F(DeformCommand, the_pose_option_wins_over_the_pose_in_the_lattice) {
  write_file("m.obj", "v 0.25 -0.5 0.125\n");
  pose_by("rest.json", "posed.json", AffineMap());
  done({"deform", "m.obj", "--lattice", "posed.json", "--pose", "rest.json", "-o", "out.obj"});
  EXPECT_EQ(read_file("out.obj"), "v 0.25 -0.5 0.125\n");
}

TEST_F(DeformCommand, json_and_ovm_lattices_mix) {
  write_file("m.obj", "v 0.25 -0.5 0.125\nv 1.5 0.75 -0.875\n");
  pose_by("rest.json", "posed.json", AffineMap());
  done({"deform", "m.obj", "--lattice", "posed.json", "-o", "json.obj"});
  // Refining needs no pose: what it writes as OVM and JSON is one lattice.
  done({"refine", "posed.json", "-o", "fine.json"});
  done({"refine", "posed.json", "-o", "fine.ovm"});
  done({"deform", "m.obj", "--lattice", "fine.ovm", "-o", "a.obj"});
  done({"deform", "m.obj", "--lattice", "fine.json", "--pose", "fine.ovm", "-o", "b.obj"});
  done({"deform", "m.obj", "--lattice", "fine.ovm", "--pose", "fine.json", "-o", "c.obj"});
  EXPECT_EQ(read_file("a.obj"), read_file("b.obj"));
  EXPECT_EQ(read_file("a.obj"), read_file("c.obj"));
  const AffineMap map;
  EXPECT_LT(glm::distance(triple(read_file("a.obj"), "v"), map({0.25, -0.5, 0.125})), 3e-6);
}

TEST_F(DeformCommand, points_outside_keep_their_bytes_and_so_do_the_unreached) {
  done({"new", "box", "--cells", "8", "1", "1", "-o", "bar.json"});
  drag("bar.json", "posed.json", 0, {-0.1, 0, 0});
  write_file("m.obj", "v 0.0500 .5 5.0e-1 # moves\nv +3.000 -3.50 3\nv 0.9000 .50 5e-1\n");
  done({"deform", "m.obj", "--lattice", "posed.json", "-o", "out.obj"});
  const std::string out = read_file("out.obj");
  EXPECT_EQ(out.substr(out.find('\n')), "\nv +3.000 -3.50 3\nv 0.9000 .50 5e-1\n");
  EXPECT_TRUE(out.substr(0, out.find('\n')).ends_with(" .5 5.0e-1 # moves")) << out;
  EXPECT_LT(triple(out, "v").x, 0.05);
}

TEST_F(DeformCommand, normals_turn_with_the_space_round_their_point) {
  write_file("m.obj", "v 0.5 0.25 0\nvn 1 0 0\nvn 0 0 1\nf 1//1 1//2 1//1\n");
  pose_by("rest.json", "turned.json", quarter_turn);
  done({"deform", "m.obj", "--lattice", "turned.json", "-o", "out.obj"});
  const std::string out = read_file("out.obj");
  EXPECT_EQ(triple(out, "v"), glm::dvec3(-0.25, 0.5, 0));
  EXPECT_LT(glm::distance(triple(out, "vn"), glm::dvec3(0, 1, 0)), 1e-15);
  EXPECT_NE(out.find("\nvn 0 0 1\nf 1//1 1//2 1//1\n"), std::string::npos) << out;

  // Under x' = x + y a plane's normal goes with the inverse transpose: (1, 0) to (1, -1).
  write_file("m.obj", "v 0.5 0.25 0\nvn 1 0 0\nf 1//1 1//1 1//1\n");
  pose_by("rest.json", "sheared.json",
          [](const glm::dvec3& x) { return glm::dvec3(x.x + x.y, x.y, x.z); });
  done({"deform", "m.obj", "--lattice", "sheared.json", "-o", "out.obj"});
  EXPECT_LT(glm::distance(triple(read_file("out.obj"), "vn"),
                          glm::dvec3(std::sqrt(0.5), -std::sqrt(0.5), 0)),
            1e-6);
}

TEST_F(DeformCommand, a_file_without_normals_gets_them_only_when_asked) {
  write_file("m.obj", cube_obj());
  pose_by("rest.json", "turned.json", quarter_turn);
  done({"deform", "m.obj", "--lattice", "turned.json", "-o", "out.obj"});
  EXPECT_EQ(read_file("out.obj").find("vn"), std::string::npos);
  done({"deform", "m.obj", "--lattice", "turned.json", "--normals", "add", "-o", "out.obj"});
  EXPECT_EQ(Json::parse(done({"info", "out.obj", "--json"}))["normals"], 24);
  done({"deform", "m.obj", "--lattice", "turned.json", "--normals", "add:90", "-o", "out.obj"});
  EXPECT_EQ(Json::parse(done({"info", "out.obj", "--json"}))["normals"], 8);
  for (const char* word : {"add:", "add:200", "add:-1", "add:nan", "more"}) {
    EXPECT_EQ(
        refusal({"deform", "m.obj", "--lattice", "turned.json", "--normals", word, "-o", "out.obj"},
                2),
        "--normals is '" + std::string(word) +
            "', must be deform, keep, add or add:DEGREES, from 0 to 180");
  }
}

/// Under x' = x + y the side of a prism that stands at 45 degrees turns as cof J turns its normal
/// at rest, also where the moved faces are no longer sharp.
TEST_F(DeformCommand, added_normals_are_those_at_rest_turned) {
  write_file("m.obj",
             "v 0 0 0\nv 0.5 0 0\nv 0.5 0 0.5\nv 0 0 0.5\nv 0 0.5 0\nv 0 0.5 0.5\n"
             "f 1 2 3 4\nf 1 4 6 5\n");
  pose_by("rest.json", "sheared.json",
          [](const glm::dvec3& x) { return glm::dvec3(x.x + x.y, x.y, x.z); });
  done({"deform", "m.obj", "--lattice", "sheared.json", "--normals", "add", "-o", "out.obj"});
  const Model model = read_model("out.obj");
  ASSERT_EQ(model.normals().size(), 8u);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const PointNormal& pair = model.pairs()[static_cast<std::size_t>(model.corner_pairs()[corner])];
    const glm::dvec3 expected =
        corner < 4 ? glm::dvec3(0, -1, 0) : glm::dvec3(-std::sqrt(0.5), std::sqrt(0.5), 0);
    EXPECT_LT(glm::distance(model.normals()[static_cast<std::size_t>(pair.normal)], expected), 1e-6)
        << corner;
  }
}

TEST_F(DeformCommand, the_result_may_replace_the_model_or_sit_behind_a_link) {
  const std::string model = "v 0.5 0.25 0\n";
  write_file("m.obj", model);
  pose_by("rest.json", "turned.json", quarter_turn);
  EXPECT_EQ(done({"deform", "m.obj", "--lattice", "turned.json", "-o", "m.obj"}),
            "m.obj: 1 points, 0 faces\n  1 inside, 0 on the border, 0 outside, 0 unconverged\n");
  EXPECT_EQ(read_file("m.obj"), "v -0.25 0.5 0\n");
  std::filesystem::create_symlink("m.obj", "link.obj");
  done({"deform", "link.obj", "--lattice", "turned.json", "-o", "link.obj"});
  EXPECT_EQ(read_file("m.obj"), "v -0.5 -0.25 0\n");
  EXPECT_TRUE(std::filesystem::is_symlink("link.obj"));
  done({"refine", "rest.json", "-o", "rest.json"});
  EXPECT_EQ(read_json("rest.json")["cells"].size(), 96u);
  EXPECT_EQ(files(), (std::vector<std::string>{"link.obj", "m.obj", "rest.json", "turned.json"}));
}

TEST_F(DeformCommand, a_pose_of_another_topology_is_named) {
  write_file("m.obj", "v 0 0 0\n");
  done({"new", "box", "--cells", "2", "2", "2", "-o", "other.json"});
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "rest.json", "--pose", "other.json", "-o",
                     "out.obj"},
                    1),
            "other.json: has 27 vertices and 8 cells, the lattice rest.json has 36 and 12");
  done({"new", "box", "--cells", "2", "3", "2", "-o", "turned.json"});
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "rest.json", "--pose", "turned.json", "-o",
                     "out.obj"},
                    1),
            "turned.json: its cells are not those of the lattice rest.json");
  EXPECT_EQ(files(), (std::vector<std::string>{"m.obj", "other.json", "rest.json", "turned.json"}));
}

TEST_F(DeformCommand, a_pose_may_fold_but_not_a_rest_lattice) {
  write_file("m.obj", "v 0.5 0.25 0\n");
  Json json = read_json("rest.json");
  for (Json& vertex : json["vertices"]) {
    vertex[0] = -vertex[0].get<double>();
    vertex[1] = 0;
  }
  write_json("folded.json", json);
  done({"deform", "m.obj", "--lattice", "rest.json", "--pose", "folded.json", "-o", "out.obj"});
  EXPECT_LT(glm::distance(triple(read_file("out.obj"), "v"), {-0.5, 0, 0}), 1e-7);
  EXPECT_EQ(
      refusal({"deform", "m.obj", "--lattice", "folded.json", "-o", "x.obj"}, 1).substr(0, 29),
      "folded.json: invalid lattice:");
}

TEST_F(DeformCommand, any_number_of_threads_gives_the_same_bytes) {
  std::string model;
  for (int i = 0; i < 4000; ++i) {
    model += "v " + std::to_string(std::sin(i)) + " " + std::to_string(std::cos(2.3 * i)) + " " +
             std::to_string(std::sin(0.7 * i)) + "\nvn 0 0 1\n";
  }
  model += "f 1//1 2//2 3//3\n";
  write_file("m.obj", model);
  drag("rest.json", "posed.json", 17, {0.3, 0.2, 0.1});
  done({"deform", "m.obj", "--lattice", "posed.json", "-o", "1.obj", "--threads", "1"});
  done({"deform", "m.obj", "--lattice", "posed.json", "-o", "4.obj", "--threads", "4"});
  EXPECT_EQ(read_file("1.obj"), read_file("4.obj"));
  EXPECT_NE(read_file("1.obj"), model);
}

TEST_F(DeformCommand, an_output_that_cannot_be_written_leaves_no_file_behind) {
  write_file("m.obj", "v 0 0 0\n");
  const std::vector<std::string> before = files();
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "rest.json", "-o", "no/such.obj"}, 1),
            "no/such.obj: cannot write: No such file or directory");
  std::filesystem::create_directory("folder.obj");
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "rest.json", "-o", "folder.obj"}, 1),
            "folder.obj: cannot write: Is a directory");
  EXPECT_TRUE(std::filesystem::is_empty("folder.obj"));
  std::filesystem::remove("folder.obj");
  EXPECT_EQ(files(), before);
}

TEST_F(DeformCommand, a_model_keeps_its_format) {
  write_file("m.obj", "v 0 0 0\n");
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "rest.json", "-o", "m.ply"}, 1),
            "m.ply: cannot write m.obj as '.ply': a model keeps its format; name the output "
            "*.obj");
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "m.obj", "-o", "out.obj"}, 1),
            "m.obj: unknown kind of lattice file; lattice files end in .json or .ovm");
  EXPECT_EQ(refusal({"deform", "hand.3ds", "--lattice", "rest.json", "-o", "out.off"}, 1),
            "hand.3ds: not a model: extension '.3ds' is unknown; models that can be read: .obj, "
            ".off, .ply, .stl");
}

TEST_F(DeformCommand, to_standard_output_writes_the_model_and_nothing_else) {
  write_file("m.obj", "v 0.5 0.25 0\n");
  pose_by("rest.json", "turned.json", quarter_turn);
  EXPECT_EQ(done({"deform", "m.obj", "--lattice", "turned.json", "-o", "/dev/stdout"}),
            "v -0.25 0.5 0\n");
}

}  // namespace
}  // namespace espalier::tools
