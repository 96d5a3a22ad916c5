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
            "cells.vtu: 12 vertices, 20 edges, 11 faces, 2 cells\n");
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
            "--extrude is missing: direction and length dx dy dz; or --thicken, or --solid");
  EXPECT_EQ(refusal({"convert", "box.json", "--volume", "-o", "a.json"}, 2),
            "--volume is for lattices that become .vtu files");
  EXPECT_EQ(refusal({"convert", "box.json", "-o", "a.obj"}, 1).substr(0, 7), "a.obj: ");
  EXPECT_EQ(files(), (std::vector<std::string>{"box.json", "cube.obj"}));
}

}  // namespace
}  // namespace espalier::tools
