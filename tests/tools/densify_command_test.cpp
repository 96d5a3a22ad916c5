/// espalier densify, and deform --densify.

#include <gmock/gmock.h>

#include "deform/model/model_file.h"
#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

using ::testing::HasSubstr;

/// A plate of two triangles in the unit cube, in two groups, and a lattice round it.
class DensifyCommand : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    write_file("plate.obj",
               "v 0.1 0.1 0.5\nv 0.9 0.1 0.5\nv 0.9 0.9 0.5\nv 0.1 0.9 0.5\nvt 0 0\nvt 1 0\n"
               "vt 1 1\nvt 0 1\ng one\nf 1/1 2/2 3/3\ng two\nusemtl b\nf 1/1 3/3 4/4\n");
    done({"new", "box", "--cells", "8", "8", "2", "--min", "0", "0", "0", "--max", "1", "1", "1",
          "-o", "box.json"});
    pose_by("box.json", "bent.json", [](const glm::dvec3& x) {
      return glm::dvec3(x.x, x.y, x.z + 0.3 * std::sin(6 * x.x));
    });
  }
  static double longest_edge(const std::string& path) {
    const Model model = read_model(path);
    double longest = 0;
    for (std::size_t face = 0; face < model.faces().n_rows(); ++face) {
      const auto loop = model.faces()[face];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        longest = std::max(
            longest,
            glm::distance(model.points()[static_cast<std::size_t>(loop[i])],
                          model.points()[static_cast<std::size_t>(loop[(i + 1) % loop.size()])]));
      }
    }
    return longest;
  }
};

TEST_F(DensifyCommand, makes_edges_as_short_as_a_length_or_as_cells_of_a_lattice) {
  done({"densify", "plate.obj", "--length", "0.3", "-o", "dense.obj"});
  EXPECT_LE(longest_edge("dense.obj"), 0.3);
  EXPECT_GT(longest_edge("dense.obj"), 0.14);
  for (const char* method : {"midpoint", "loop", "catmull-clark"}) {
    done({"densify", "plate.obj", "--lattice", "box.json", "--method", method, "-o", "dense.obj"});
    EXPECT_LE(longest_edge("dense.obj"), 0.125) << method;
    EXPECT_GT(longest_edge("dense.obj"), 0.03) << method;
    EXPECT_THAT(read_file("dense.obj"), HasSubstr("\ng two\nusemtl b\nf "));
  }
}

TEST_F(DensifyCommand, takes_models_of_all_formats_and_keeps_theirs) {
  write_file("plate.off", "OFF\n4 1 0\n.1 .1 .5\n.9 .1 .5\n.9 .9 .5\n.1 .9 .5\n4 0 1 2 3\n");
  write_file("plate.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
             "end_header\n.1 .1 .5\n.9 .1 .5\n.9 .9 .5\n3 0 1 2\n");
  write_file("plate.stl",
             "solid\nfacet normal 0 0 1\nouter loop\nvertex .1 .1 .5\nvertex .9 .1 .5\n"
             "vertex .9 .9 .5\nendloop\nendfacet\nendsolid\n");
  for (const std::string kind : {".off", ".ply", ".stl"}) {
    done({"densify", "plate" + kind, "--lattice", "box.json", "-o", "dense" + kind});
    EXPECT_LE(longest_edge("dense" + kind), 0.125 * (1 + 1e-6)) << kind;
    done({"deform", "plate" + kind, "--lattice", "box.json", "--pose", "bent.json", "--densify",
          "midpoint", "-o", "fine" + kind});
    EXPECT_GT(read_model("fine" + kind).points().size(), 30u) << kind;
  }
  EXPECT_EQ(refusal({"densify", "plate.off", "--length", "0.3", "-o", "dense.obj"}, 1),
            "dense.obj: cannot write plate.off as '.obj': a model keeps its format; name the "
            "output *.off");
}

TEST_F(DensifyCommand, keeps_sharp_edges_sharp_where_normals_are_added) {
  const std::string faces = "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  std::string off = "OFF\n8 6 0\n";
  std::string obj;
  for (int i = 0; i < 8; ++i) {
    const std::string place =
        std::string(i & 1 ? " .9" : " .1") + (i & 2 ? " .9" : " .1") + (i & 4 ? " .9" : " .1");
    off += place + "\n";
    obj += "v" + place + "\n";
  }
  write_file("cube.off", off + faces);
  write_file("cube.obj",
             obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  pose_by("box.json", "turned.json", [](const glm::dvec3& x) { return glm::dvec3(x.y, x.z, x.x); });
  for (const std::string kind : {".off", ".obj"}) {
    done({"deform", "cube" + kind, "--lattice", "box.json", "--pose", "turned.json", "--densify",
          "midpoint:0.45", "--normals", "add", "-o", "out" + kind});
    const Model model = read_model("out" + kind);
    EXPECT_EQ(model.faces().n_rows(), 24u) << kind;
    EXPECT_EQ(model.points().size(), kind == ".off" ? 6u * 9 : 26u) << kind;
    EXPECT_EQ(model.pairs().size(), 6u * 9) << kind;
    for (const PointNormal& pair : model.pairs()) {
      const glm::dvec3& p = model.points()[static_cast<std::size_t>(pair.point)];
      const glm::dvec3& n = model.normals()[static_cast<std::size_t>(pair.normal)];
      EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6) << kind;
      EXPECT_NEAR(glm::dot(p - 0.5, n), 0.4, 1e-6) << kind;  // on the face that it is of
    }
  }
}

TEST_F(DensifyCommand, takes_a_length_or_a_lattice_and_not_both) {
  EXPECT_EQ(refusal({"densify", "plate.obj", "--length", "0.3", "--lattice", "box.json", "-o",
                     "dense.obj"},
                    2),
            "--length and --lattice exclude each other: the lattice gives a length");
}

TEST_F(DensifyCommand, lets_deform_bend_a_coarse_model) {
  done({"deform", "plate.obj", "--lattice", "box.json", "--pose", "bent.json", "--densify",
        "midpoint", "-o", "fine.obj"});
  done({"densify", "plate.obj", "--lattice", "box.json", "-o", "dense.obj"});
  done({"deform", "dense.obj", "--lattice", "box.json", "--pose", "bent.json", "-o", "same.obj"});
  EXPECT_EQ(read_file("fine.obj"), read_file("same.obj"));
  double low = 1;
  double high = 0;
  const Model fine = read_model("fine.obj");
  for (const glm::dvec3& p : fine.points()) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_LT(low, 0.3);
  EXPECT_GT(high, 0.7);
  done({"deform", "plate.obj", "--lattice", "box.json", "--densify", "midpoint:0.5", "-o",
        "rest.obj"});
  EXPECT_LE(longest_edge("rest.obj"), 0.5);
}

TEST_F(DensifyCommand, of_many_poses_gives_models_of_one_topology) {
  pose_by("box.json", "pose1.json", [](const glm::dvec3& x) { return 2.0 * x; });
  pose_by("box.json", "pose2.json", [](const glm::dvec3& x) { return x + 1.0; });
  done({"deform", "plate.obj", "--lattice", "box.json", "--pose", "pose*.json", "--densify",
        "midpoint", "-o", "out-{}.obj"});
  const Model one = read_model("out-pose1.obj");
  const Model two = read_model("out-pose2.obj");
  ASSERT_EQ(one.points().size(), two.points().size());
  for (std::size_t i = 0; i < one.points().size(); ++i) {
    EXPECT_LT(glm::distance(one.points()[i] / 2.0 + 1.0, two.points()[i]), 1e-6);
  }
}

TEST_F(DensifyCommand, names_what_is_wrong) {
  EXPECT_EQ(refusal({"densify", "plate.obj", "-o", "x.obj"}, 2),
            "densify: give a length, or a lattice that it is for");
  EXPECT_EQ(refusal({"densify", "plate.obj", "--length", "0", "-o", "x.obj"}, 2),
            "--length must be positive");
  EXPECT_THAT(refusal({"densify", "plate.obj", "--length", "1e-7", "-o", "x.obj"}, 2),
              HasSubstr("faces or more, the limit is 5e+07"));
  EXPECT_THAT(
      refusal({"deform", "plate.obj", "--lattice", "box.json", "--densify", "more", "-o", "x.obj"},
              2),
      HasSubstr("--densify is 'more', must be midpoint, loop or catmull-clark"));
  done({"bind", "plate.obj", "--lattice", "box.json", "-o", "plate.binding"});
  EXPECT_THAT(refusal({"deform", "plate.obj", "--lattice", "box.json", "--binding", "plate.binding",
                       "--densify", "loop", "-o", "x.obj"},
                      2),
              HasSubstr("--densify changes the model"));
  write_file("far.obj", "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 1 2 3\n");
  EXPECT_THAT(refusal({"densify", "far.obj", "--lattice", "box.json", "-o", "x.obj"}, 2),
              HasSubstr("no point of the model is inside the lattice"));
}

}  // namespace
}  // namespace espalier::tools
