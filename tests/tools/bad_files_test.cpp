/// Files that are not what their names say: one clear line, quickly, and no output touched.

#include <chrono>
#include <functional>
#include <random>

#include "lattice/core/file.h"
#include "tests/deform/odd_obj_files.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class BadFiles : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.json"});
    done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.ovm"});
    write_file("out.obj", "v 7 7 7\n");
    write_file("out.json", "mine");
  }
  void TearDown() override {
    EXPECT_EQ(read_file("out.obj"), "v 7 7 7\n");
    EXPECT_EQ(read_file("out.json"), "mine");
    for (const std::string& file : files()) {
      EXPECT_FALSE(file.starts_with("out.") && file != "out.obj" && file != "out.json") << file;
    }
    CommandLineTest::TearDown();
  }

  /// What a command that reads a lattice says of one with these bytes.
  static std::string refused_lattice(const std::string& name, const std::string& bytes) {
    write_file(name, bytes);
    write_file("m.obj", "v 0 0 0\n");
    const auto start = std::chrono::steady_clock::now();
    const std::string what = refusal({"refine", name, "-o", "out.json"}, 1);
    EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", name, "-o", "out.obj"}, 1), what);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3)) << what;
    EXPECT_EQ(what.substr(0, name.size()), name);
    return what;
  }
  static std::string refused_json(const Json& json) {
    return refused_lattice("bad.json", json.dump());
  }
  static std::string refused_model(const std::string& bytes) {
    write_file("bad.obj", bytes);
    return refusal({"deform", "bad.obj", "--lattice", "cube.json", "-o", "out.obj"}, 1);
  }
};

TEST_F(BadFiles, missing_ones_are_named) {
  EXPECT_EQ(refusal({"deform", "no.obj", "--lattice", "cube.json", "-o", "out.obj"}, 1),
            "no.obj: cannot open: No such file or directory");
  EXPECT_EQ(refusal({"deform", "out.obj", "--lattice", "no.json", "-o", "out.obj"}, 1),
            "no.json: cannot open: No such file or directory");
  EXPECT_EQ(
      refusal({"deform", "out.obj", "--lattice", "cube.json", "--pose", "no.ovm", "-o", "out.obj"},
              1),
      "no.ovm: cannot open: No such file or directory");
  EXPECT_EQ(refusal({"eval", "cube.json", "--at", "no.csv"}, 1),
            "no.csv: cannot open: No such file or directory");
}

TEST_F(BadFiles, folders_are_named) {
  for (const std::string name : {"d.obj", "d.json", "d.ovm"}) {
    std::filesystem::create_directory(name);
    EXPECT_EQ(refusal({"info", name}, 1), name + ": is a folder, not a file");
  }
  EXPECT_EQ(refusal({"eval", "cube.json", "--at", "d.obj"}, 1), "d.obj: is a folder, not a file");
}

TEST_F(BadFiles, names_of_no_known_kind_are_refused) {
  EXPECT_EQ(refusal({"info", "hand.3ds"}, 1),
            "hand.3ds: not a model: extension '.3ds' is unknown; models that can be read: .obj, "
            ".off, .ply, .stl");
  EXPECT_EQ(refusal({"info", "noname"}, 1),
            "noname: not a model: the name has no extension; models that can be read: .obj, .off, "
            ".ply, .stl");
  EXPECT_EQ(refusal({"refine", "cube.json", "-o", "out.obj"}, 1),
            "out.obj: unknown kind of lattice file; lattice files end in .json or .ovm");
  EXPECT_EQ(refusal({"new", "box", "-o", "a.ovmb"}, 1),
            "a.ovmb: is binary OpenVolumeMesh; lattice files are .json or ASCII .ovm");
}

TEST_F(BadFiles, empty_ones_and_nonsense_are_refused) {
  EXPECT_EQ(refused_model(""),
            "bad.obj: has no vertices: an OBJ file needs lines like 'v 1.0 2.0 3.0'");
  EXPECT_EQ(refused_model("hello\nworld\n"),
            "bad.obj: has no vertices: an OBJ file needs lines like 'v 1.0 2.0 3.0'");
  EXPECT_EQ(refused_lattice("bad.json", "").substr(0, 29), "bad.json:1: is not valid JSON");
  EXPECT_EQ(refused_lattice("bad.json", "hello").substr(0, 29), "bad.json:1: is not valid JSON");
  EXPECT_EQ(refused_lattice("bad.json", "[]"), "bad.json: holds an array, not a JSON object");
  EXPECT_EQ(refused_lattice("bad.json", "{}"),
            "bad.json: is no lattice: \"format\": \"espalier/1\" is missing");
  EXPECT_EQ(refused_lattice("bad.ovm", ""), "bad.ovm: is empty, needs the header \"OVM ASCII\"");
  EXPECT_EQ(refused_lattice("bad.ovm", "hello"),
            "bad.ovm:1: is no OpenVolumeMesh file: needs the header \"OVM ASCII\"");
}

TEST_F(BadFiles, binary_garbage_is_refused) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::string bytes(3000, '\0');
    for (char& c : bytes) {
      c = static_cast<char>(random());
    }
    EXPECT_NE(refused_model(bytes), "");
    EXPECT_NE(refused_lattice("bad.json", bytes), "");
    EXPECT_NE(refused_lattice("bad.ovm", bytes), "");
  }
}

/// Cut at every step-th byte, a file works or is refused in one line that names it.
void expect_cuts_survive(const std::string& name, const std::string& bytes, std::size_t step,
                         const std::function<Outcome(const std::string&)>& run) {
  std::size_t n_refused = 0;
  for (std::size_t size = 0; size < bytes.size(); size += step) {
    write_file(name, bytes.substr(0, size));
    const Outcome outcome = run(name);
    if (outcome.status == 0) {
      EXPECT_EQ(outcome.err, "") << size;
      continue;
    }
    ++n_refused;
    EXPECT_EQ(outcome.status, 1) << size;
    EXPECT_EQ(outcome.err.substr(0, 10 + name.size()), "espalier: " + name) << size;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << size << ": " << outcome.err;
  }
  EXPECT_GT(n_refused, 0u);
}

TEST_F(BadFiles, models_cut_anywhere_work_or_are_refused) {
  expect_cuts_survive("cut.obj", kRichObj, 2, [](const std::string& name) {
    return run({"deform", name, "--lattice", "cube.json", "-o", "done.obj"});
  });
}

TEST_F(BadFiles, lattices_cut_anywhere_work_or_are_refused) {
  pose_by("cube.json", "posed.json", AffineMap());
  done({"refine", "posed.json", "-o", "fine.ovm"});
  const auto refine = [](const std::string& name) {
    return run({"refine", name, "-o", "done.json"});
  };
  expect_cuts_survive("cut.json", read_file("posed.json"), 3, refine);
  expect_cuts_survive("cut.ovm", read_file("cube.ovm"), 1, refine);
  expect_cuts_survive("cut.ovm", read_file("fine.ovm"), 13, refine);
}

TEST_F(BadFiles, coordinates_that_are_no_numbers_are_named_by_line_or_element) {
  EXPECT_EQ(refused_model("v 0 0 0\nv 0 0 nan\n"),
            "bad.obj:2: z of a vertex (v x y z) is not finite");
  EXPECT_EQ(refused_model("v 0 -inf 0\n"), "bad.obj:1: y of a vertex (v x y z) is not finite");
  EXPECT_EQ(refused_model("v 1e300 0 0\n"),
            "bad.obj:1: x of a vertex (v x y z) is beyond the largest coordinate, 1e18");
  Json json = read_json("cube.json");
  json["vertices"][3][1] = 1e300;
  EXPECT_EQ(refused_json(json),
            "bad.json: vertices[3][1]: is 1e+300, beyond the largest coordinate, 1e18");
  json["vertices"][3][1] = nullptr;
  EXPECT_EQ(refused_json(json), "bad.json: vertices[3][1]: is null, not a number");
  json["vertices"][3][1] = "1";
  EXPECT_EQ(refused_json(json), "bad.json: vertices[3][1]: is \"1\", not a number");
  EXPECT_EQ(refused_lattice("bad.json", "{\n\"vertices\": [[0, 0,\n NaN]]}").substr(0, 29),
            "bad.json:3: is not valid JSON");
  std::string ovm = read_file("cube.ovm");
  ovm.replace(ovm.find("1 1 1\n"), 5, "1 nan 1");
  EXPECT_EQ(refused_lattice("bad.ovm", ovm).substr(0, 11), "bad.ovm:11:");
}

TEST_F(BadFiles, indices_out_of_range_are_named) {
  EXPECT_EQ(refused_model("v 0 0 0\nv 1 0 0\nf 1 2 3\n"),
            "bad.obj:3: '3' refers to vertex 3, but the file has only 2 'v'");
  Json json = read_json("cube.json");
  json["faces"][2][1] = 8;
  EXPECT_EQ(refused_json(json),
            "bad.json: faces[2][1]: vertex 8 does not exist, there are 8 (0…7)");
  json = read_json("cube.json");
  json["cells"][0][5] = -1;
  EXPECT_EQ(refused_json(json), "bad.json: cells[0][5]: face -1 does not exist, there are 6 (0…5)");
}

TEST_F(BadFiles, a_cell_that_is_not_closed_is_named) {
  Json json = read_json("cube.json");
  json["cells"][0].erase(2);
  json["faces"].erase(2);
  for (Json& face : json["cells"][0]) {
    face = face.get<int>() > 2 ? face.get<int>() - 1 : face.get<int>();
  }
  EXPECT_EQ(refused_json(json).substr(0, 58),
            "bad.json: invalid lattice: cell 0: is not closed: its edge");
}

TEST_F(BadFiles, a_face_used_three_times_is_named) {
  // Three tetrahedra over one triangle.
  const Json json = Json::parse(R"({"format": "espalier/1", "type": "subdivision",
      "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1],[0,0,-1],[1,1,1]],
      "faces": [[0,1,2],[0,1,3],[1,2,3],[2,0,3],[0,1,4],[1,2,4],[2,0,4],[0,1,5],[1,2,5],[2,0,5]],
      "cells": [[0,1,2,3],[0,4,5,6],[0,7,8,9]]})");
  const std::string what = refused_json(json);
  EXPECT_EQ(what.substr(0, 35), "bad.json: invalid lattice: face 0: ") << what;
}

TEST_F(BadFiles, a_pose_of_another_length_is_named) {
  Json json = read_json("cube.json");
  json["pose"] = {{0, 0, 0}};
  EXPECT_EQ(refused_json(json), "bad.json: pose: has 1 points, needs 8, one a vertex");
}

TEST_F(BadFiles, a_billion_announced_elements_in_a_small_file_are_refused_at_once) {
  for (const std::string section :
       {"Vertices\n1000000000\n0 0 0\n", "Vertices\n1000000000000000000\n",
        "Vertices\n1\n0 0 0\nEdges\n1000000000\n0 0\n"}) {
    EXPECT_EQ(refused_lattice("bad.ovm", "OVM ASCII\n" + section).substr(0, 8), "bad.ovm:");
  }
  EXPECT_EQ(refused_lattice("bad.ovm",
                            "OVM ASCII\nVertices\n1\n0 0 0\nEdges\n0\nFaces\n1\n1000000000 1 2\n")
                .substr(0, 8),
            "bad.ovm:");
}

TEST_F(BadFiles, a_file_that_may_not_be_read_is_named) {
  std::filesystem::permissions("cube.ovm", std::filesystem::perms::none);
  const Outcome outcome = run({"info", "cube.ovm"});
  if (outcome.status != 0) {  // the superuser may read everything
    EXPECT_EQ(outcome.err, "espalier: cube.ovm: cannot open: Permission denied\n");
  }
}

}  // namespace
}  // namespace espalier::tools
