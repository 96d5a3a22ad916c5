/// espalier convert, of lattices; of meshes see lattice_commands_test.cpp.

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class ConvertLattice : public CommandLineTest {};

TEST_F(ConvertLattice, to_the_other_format_and_back_changes_nothing) {
  done({"new", "cylinder", "--sectors", "5", "--scheme", "mj96", "-o", "a.json"});
  pose_by("a.json", "posed.json", AffineMap());
  done({"convert", "posed.json", "-o", "a.ovm"});
  done({"convert", "a.ovm", "-o", "b.json"});
  done({"convert", "b.json", "-o", "b.ovm"});
  EXPECT_EQ(read_json("b.json"), read_json("posed.json"));
  EXPECT_EQ(read_file("b.ovm"), read_file("a.ovm"));
}

TEST_F(ConvertLattice, to_vtu_draws_the_control_cells_or_the_volume) {
  done({"new", "box", "--cells", "2", "1", "1", "-o", "box.json"});
  EXPECT_EQ(done({"convert", "box.json", "-o", "cells.vtu"}),
            "cells.vtu: 12 vertices, 20 edges, 11 faces, 2 cells\n"
            "  faces at inner edges     none\n"
            "  faces at boundary edges  16 × 2, 4 × 3\n"
            "  faces of cells           2 × 6\n"
            "  cells meet in an edge only at 0 edges, in a vertex only at 0 vertices\n"
            "  cells inverted at a corner: 0\n");
  done({"convert", "box.json", "--volume", "-o", "volume.vtu"});
  done({"convert", "box.json", "--volume", "--freeze", "uniform:1", "-o", "uniform.VTU"});
  const auto has = [](const std::string& path, const std::string& text) {
    return read_file(path).find(text) != std::string::npos;
  };
  EXPECT_TRUE(has("cells.vtu", R"(NumberOfPoints="12" NumberOfCells="2")"));
  EXPECT_FALSE(has("cells.vtu", "HigherOrderDegrees"));
  EXPECT_TRUE(has("volume.vtu", R"(NumberOfPoints="112" NumberOfCells="2")"));
  EXPECT_TRUE(has("volume.vtu", "HigherOrderDegrees"));
  EXPECT_TRUE(has("uniform.VTU", R"(NumberOfPoints="45" NumberOfCells="16")"));
}

TEST_F(ConvertLattice, to_vtu_takes_the_pose_unless_it_is_asked_for_the_rest) {
  done({"new", "box", "-o", "box.json"});
  pose_by("box.json", "posed.json", AffineMap());
  for (const char* kind : {"--rest", "--volume"}) {
    const bool is_rest = kind == std::string("--rest");
    done({"convert", "box.json", "--volume", "-o", "rest.vtu"});
    done({"convert", "posed.json", "--volume", kind, "-o", "posed.vtu"});
    EXPECT_EQ(read_file("posed.vtu") == read_file("rest.vtu"), is_rest);
  }
}

TEST_F(ConvertLattice, other_commands_write_vtu_too) {
  done({"new", "box", "-o", "box.json"});
  done({"convert", "box.json", "-o", "a.vtu"});
  done({"new", "box", "-o", "b.vtu"});
  EXPECT_EQ(read_file("a.vtu"), read_file("b.vtu"));
}

TEST_F(ConvertLattice, refuses_what_has_no_meaning) {
  done({"new", "box", "-o", "box.json"});
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(refusal({"convert", "box.json", "--extrude", "0", "0", "1", "-o", "a.json"}, 2),
            "--extrude is for surface meshes, not for lattices");
  EXPECT_EQ(refusal({"convert", "box.json", "--sharp", "none", "-o", "a.json"}, 2),
            "--sharp is for surface meshes, not for lattices");
  EXPECT_EQ(refusal({"convert", "cube.obj", "-o", "a.json"}, 2),
            "--extrude is missing: direction and length dx dy dz; or --thicken, --solid, --wrap or "
            "--sweep");
  EXPECT_EQ(refusal({"convert", "box.json", "--volume", "-o", "a.json"}, 2),
            "--volume is for lattices that become .vtu files");
  EXPECT_EQ(refusal({"convert", "box.json", "-o", "a.obj"}, 1).substr(0, 7), "a.obj: ");
  EXPECT_EQ(files(), (std::vector<std::string>{"box.json", "cube.obj"}));
}

TEST_F(ConvertLattice, tells_how_large_a_volume_would_be_before_it_writes_half_a_gigabyte) {
  done({"new", "bspline", "--counts", "68", "68", "68", "-o", "big.json"});
  EXPECT_EQ(refusal({"convert", "big.json", "--volume", "-o", "big.vtu"}, 2),
            "big.vtu: the frozen volume has 274625 patches, a file of about 0.6 GB: --freeze "
            "adaptive:1e-5 writes it all the same");
  EXPECT_EQ(files(), std::vector<std::string>{"big.json"});
}

class ConvertModel : public CommandLineTest {};

/// A staple: a bar along x with a leg at each end.
std::string staple_obj() {
  return "v 0 0 0\nv 3 0 0\nv 3 5 0\nv 2 5 0\nv 2 1 0\nv 1 1 0\nv 1 5 0\nv 0 5 0\n"
         "v 0 0 1\nv 3 0 1\nv 3 5 1\nv 2 5 1\nv 2 1 1\nv 1 1 1\nv 1 5 1\nv 0 5 1\n"
         "f 8 7 6 5 4 3 2 1\nf 9 10 11 12 13 14 15 16\nf 1 2 10 9\nf 2 3 11 10\nf 3 4 12 11\n"
         "f 4 5 13 12\nf 5 6 14 13\nf 6 7 15 14\nf 7 8 16 15\nf 8 1 9 16\n";
}

TEST_F(ConvertModel, blames_the_mesh_and_not_the_file_to_be_written_where_no_lattice_comes_of_it) {
  write_file("staple.obj", staple_obj());
  const std::string why = refusal({"convert", "staple.obj", "--thicken", "-2", "-o", "w.json"}, 1);
  EXPECT_EQ(why.substr(0, why.find("cell")), "staple.obj: --thicken: invalid lattice: ");
}

TEST_F(ConvertModel, by_wrap_holds_the_whole_model_and_is_certified) {
  write_file("staple.obj", staple_obj());
  const Json report =
      Json::parse(done({"convert", "staple.obj", "--wrap", "8", "--json", "-o", "w.json"}));
  EXPECT_EQ(report["model"], Json::parse(R"({"points": 16, "inside": 16, "share_inside": 1.0})"));
  EXPECT_EQ(report["shared"], Json::array());
  EXPECT_EQ(report["inverted_at_corner"], 0);
  EXPECT_EQ(report["non_manifold"], Json::parse(R"({"edges": 0, "vertices": 0})"));
  EXPECT_EQ(run({"check", "w.json"}).status, 0);
  const Json bound = Json::parse(
      done({"deform", "staple.obj", "--lattice", "w.json", "--json", "-o", "same.obj"}));
  EXPECT_EQ(bound["inside"], 16);
  EXPECT_EQ(read_file("same.obj"), staple_obj());
}

TEST_F(ConvertModel, by_wrap_names_where_limbs_share_cells_and_what_would_part_them) {
  write_file("staple.obj", staple_obj());
  const std::string text = done({"convert", "staple.obj", "--wrap", "4", "-o", "w.json"});
  EXPECT_NE(text.find("  16 of the model's 16 points inside: 100 %\n"), std::string::npos) << text;
  EXPECT_NE(text.find("though they do not touch there\n  to keep them apart try --wrap "),
            std::string::npos)
      << text;
}

TEST_F(ConvertModel, by_sweep_follows_a_path_as_wide_as_the_model) {
  write_file("cube.obj", cube_obj());
  const Json box = Json::parse(done({"info", "cube.obj", "--json"}));
  const glm::dvec3 low = point_of(box["min"]);
  const glm::dvec3 high = point_of(box["max"]);
  const glm::dvec3 middle = 0.5 * (low + high);
  const std::string x = std::to_string(middle.x) + " " + std::to_string(middle.y) + " ";
  write_file("path.obj", "v " + x + std::to_string(low.z - 1) + "\nv " + x +
                             std::to_string(high.z + 1) + "\nl 1 2\n");
  const Json report =
      Json::parse(done({"convert", "cube.obj", "--sweep", "path.obj", "--json", "-o", "w.json"}));
  EXPECT_EQ(report["model"]["share_inside"], 1.0);
  const Json thin = Json::parse(done({"convert", "cube.obj", "--sweep", "path.obj", "--radius",
                                      "0.01", "--layers", "3", "--json", "-o", "w.json"}));
  EXPECT_EQ(thin["model"]["inside"], 0);
  EXPECT_EQ(thin["cells"], 3 * (4 + 8));
}

TEST_F(ConvertModel, counts_the_points_of_another_model_if_asked) {
  write_file("cube.obj", cube_obj());
  write_file("staple.obj", staple_obj());
  const Json report = Json::parse(done({"convert", "cube.obj", "--thicken", "9", "--model",
                                        "staple.obj", "--json", "-o", "a.json"}));
  EXPECT_EQ(report["model"]["points"], 16);
  const Json again =
      Json::parse(done({"convert", "a.json", "--model", "staple.obj", "--json", "-o", "a.ovm"}));
  EXPECT_EQ(again["model"], report["model"]);
}

TEST_F(ConvertModel, takes_polygons_of_any_size_from_all_formats_of_surfaces) {
  const std::string pentagon = "0 0 0\n2 0 0\n3 1 0\n1 2 0\n0 1 0\n";
  write_file("a.off", "OFF\n5 1 0\n" + pentagon + "5 0 1 2 3 4\n");
  write_file("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
             "end_header\n" +
                 pentagon + "5 0 1 2 3 4\n");
  write_file("a.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n");
  write_file("a.stl",
             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\n"
             "vertex 3 1 0\nendloop\nendfacet\nendsolid a\n");
  for (const char* file : {"a.off", "a.ply", "a.obj", "a.stl"}) {
    const bool is_triangle = file == std::string("a.stl");
    for (const std::vector<std::string>& way :
         {std::vector<std::string>{"--extrude", "0", "0", "1"}, {"--thicken", "1"}}) {
      std::vector<std::string> words = {"convert", file, "--json", "-o", "a.json"};
      words.insert(words.begin() + 2, way.begin(), way.end());
      const Json report = Json::parse(done(words));
      EXPECT_EQ(report["cells"], 1) << file;
      EXPECT_EQ(report["vertices"], is_triangle ? 6 : 10) << file;
    }
  }
}

TEST_F(ConvertModel, refuses_options_of_another_way_and_numbers_out_of_range) {
  write_file("staple.obj", staple_obj());
  const auto refused = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"convert", "staple.obj"});
    words.insert(words.end(), {"-o", "a.json"});
    return refusal(words, 2);
  };
  EXPECT_EQ(refused({"--wrap", "0"}),
            "wrap: the cells along the longest side are 0, must be 1 to 128");
  EXPECT_EQ(refused({"--wrap", "4", "--layers", "2"}),
            "--layers is for --extrude, --thicken and --sweep");
  EXPECT_EQ(refused({"--wrap", "4", "--radius", "2"}), "--radius is for --sweep");
  EXPECT_EQ(refused({"--wrap", "4", "--solid"}),
            "--extrude, --thicken, --solid, --wrap and --sweep exclude each other");
  EXPECT_EQ(refused({"--sweep", "staple.obj"}),
            "staple.obj: sweep: has no lines: a path is an OBJ file with lines like 'l 1 2 3'");
  EXPECT_EQ(refused({"--sweep", "staple.obj", "--radius", "-1"}), "--radius must be positive");
}

}  // namespace
}  // namespace espalier::tools
