/// espalier extrude … crease, the inventory, and volume meshes, from the command line.

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class BuildingCommands : public CommandLineTest {};

/// Vertices, edges, faces and cells, from the first line of a report.
std::string counts(const std::string& text) {
  const std::size_t begin = text.find(": ") + 2;
  return text.substr(begin, text.find('\n') + 1 - begin);
}

TEST_F(BuildingCommands, build_a_lattice_step_by_step_in_one_file) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "a.json"});
  EXPECT_EQ(done({"extrude", "a.json", "--faces", "1", "--by", "1", "0", "0", "-o", "a.json"}),
            "a.json: 12 vertices, 20 edges, 11 faces, 2 cells\n");
  EXPECT_EQ(done({"split", "a.json", "--edge", "0-2", "-o", "a.json"}),
            "a.json: 18 vertices, 33 edges, 20 faces, 4 cells\n");
  EXPECT_EQ(done({"mirror", "a.json", "--across", "0", "0", "1", "-o", "a.json"}),
            "a.json: 27 vertices, 54 edges, 36 faces, 8 cells\n");
  EXPECT_EQ(done({"delete", "a.json", "--cells", "0,4-5", "-o", "a.json"}),
            "a.json: 22 vertices, 41 edges, 25 faces, 5 cells\n");
  done({"crease", "a.json", "--all", "--sharpness", "0", "-o", "a.json"});
  EXPECT_EQ(read_json("a.json")["sharp_edges"], Json::array());
  const Json info = Json::parse(done({"info", "a.json", "--json"}));
  EXPECT_EQ(info["valid"], true);
}

TEST_F(BuildingCommands, leave_the_file_as_it_was_when_they_refuse) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "a.json"});
  const std::string bytes = read_file("a.json");
  EXPECT_NE(
      refusal({"extrude", "a.json", "--faces", "0", "--by", "0.5", "0", "0", "-o", "a.json"}, 1)
          .find("invalid lattice: "),
      std::string::npos);
  EXPECT_EQ(refusal({"extrude", "a.json", "--faces", "6", "--normal", "1", "-o", "a.json"}, 2),
            "extrude: face 6 does not exist, there are 6");
  EXPECT_EQ(refusal({"split", "a.json", "--edge", "0", "-o", "a.json"}, 2),
            "--edge is '0', must be edges by their vertices, such as 0-1,4-5");
  EXPECT_EQ(read_file("a.json"), bytes);
  EXPECT_EQ(files(), std::vector<std::string>{"a.json"});
}

TEST_F(BuildingCommands, info_tells_where_cells_only_touch) {
  done({"new", "box", "--cells", "2", "2", "1", "-o", "a.json"});
  done({"delete", "a.json", "--cells", "0,3", "-o", "a.json"});
  const Json info = Json::parse(done({"info", "a.json", "--json"}));
  EXPECT_EQ(info["non_manifold"]["edges"], 1);
}

TEST_F(BuildingCommands, new_makes_every_kind_of_the_inventory) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> kinds = {
      {{"ogrid", "--core", "1", "--layers", "1"}, "5 cells\n"},
      {{"annulus", "--sectors", "6", "--layers", "2"}, "12 cells\n"},
      {{"torus", "--segments", "5"}, "40 cells\n"},
      {{"sphere", "--cells", "1"}, "7 cells\n"},
      {{"star", "--tips", "6"}, "6 cells\n"},
      {{"barbell", "--cells", "1"}, "66 cells\n"},
      {{"junction", "--kind", "Y", "--layers", "1"}, "56 cells\n"},
      {{"limb", "--joint", "0,0,0", "--joint", "1,0,0,0.2", "--sectors", "3"}, "9 cells\n"}};
  for (const auto& [words, expected] : kinds) {
    std::vector<std::string> command = {"new"};
    command.insert(command.end(), words.begin(), words.end());
    command.insert(command.end(), {"-o", "a.json"});
    const std::string text = done(command);
    EXPECT_EQ(text.substr(text.rfind(", ") + 2), expected) << words[0];
  }
  EXPECT_EQ(refusal({"new", "limb", "--joint", "0,0", "--joint", "1,0,0", "-o", "b.json"}, 2),
            "--joint is '0,0', must be x,y,z or x,y,z,radius");
}

TEST_F(BuildingCommands, convert_thickens_along_normals_and_fills_closed_meshes) {
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(counts(done({"convert", "cube.obj", "--thicken", "0.5", "-o", "shell.json"})),
            "16 vertices, 32 edges, 24 faces, 6 cells\n");
  const glm::dvec3 lowest = point_of(Json::parse(done({"info", "shell.json", "--json"}))["min"]);
  EXPECT_LT(glm::distance(lowest, glm::dvec3(-0.5)), 1e-15);
  EXPECT_EQ(counts(done({"convert", "cube.obj", "--solid", "-o", "cell.json"})),
            "8 vertices, 12 edges, 6 faces, 1 cells\n");
  EXPECT_EQ(read_json("cell.json")["sharp_edges"], Json::array());
  write_file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(refusal({"convert", "open.obj", "--solid", "-o", "b.json"}, 1),
            "solid: the mesh is not closed: edge 0-1 has 1 face, needs two");
  write_file("turned.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n");
  EXPECT_EQ(refusal({"convert", "turned.obj", "--thicken", "1", "-o", "b.json"}, 1),
            "thicken: two faces run along edge 1-2 in the same direction; the mesh needs one "
            "outside");
  EXPECT_EQ(refusal({"convert", "cube.obj", "--solid", "--thicken", "1", "-o", "b.json"}, 2),
            "--extrude, --thicken, --solid, --wrap and --sweep exclude each other");
}

TEST_F(BuildingCommands, read_volume_meshes_and_never_write_them) {
  write_file(
      "a.mesh",
      "MeshVersionFormatted 1\nDimension 3\nVertices\n5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n"
      "1 1 1 1\nTetrahedra\n2\n1 2 3 4 1\n5 2 3 4 1\nEnd\n");
  EXPECT_EQ(done({"convert", "a.mesh", "-o", "a.ovm"}),
            "a.ovm: 5 vertices, 9 edges, 7 faces, 2 cells\n"
            "  faces at inner edges     none\n"
            "  faces at boundary edges  6 × 2, 3 × 3\n"
            "  faces of cells           2 × 4\n"
            "  cells meet in an edge only at 0 edges, in a vertex only at 0 vertices\n"
            "  cells inverted at a corner: 0\n");
  EXPECT_EQ(done({"refine", "a.mesh", "-o", "b.json"}).substr(0, 8), "b.json: ");
  for (const char* output : {"b.mesh", "b.vtk", "b.msh"}) {
    EXPECT_EQ(refusal({"convert", "a.mesh", "-o", output}, 1),
              std::string(output) +
                  ": volume meshes are only read; lattices are written to .json or .ovm");
  }
}

}  // namespace
}  // namespace espalier::tools
