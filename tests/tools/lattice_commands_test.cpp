/// espalier new, convert and refine.

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class LatticeCommands : public CommandLineTest {};

void expect_near(const glm::dvec3& point, const glm::dvec3& expected, double tolerance) {
  EXPECT_NEAR(point.x, expected.x, tolerance);
  EXPECT_NEAR(point.y, expected.y, tolerance);
  EXPECT_NEAR(point.z, expected.z, tolerance);
}

TEST_F(LatticeCommands, a_new_box_has_its_points_in_grid_order) {
  EXPECT_EQ(done({"new", "box", "--cells", "2", "1", "4", "--min", "-1", "-.5", "-2e-3", "--max",
                  "3", "+1.5", "1.998", "-o", "box.json"}),
            "box.json: 30 vertices, 59 edges, 38 faces, 8 cells\n");
  const Json vertices = read_json("box.json")["vertices"];
  ASSERT_EQ(vertices.size(), 30u);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3 place(i % 3, i / 3 % 2, i / 6);
    expect_near(point_of(vertices[i]), glm::dvec3(-1, -0.5, -2e-3) + place * glm::dvec3(2, 2, 0.5),
                1e-15);
  }
}

TEST_F(LatticeCommands, a_new_box_is_two_cells_wide_and_fills_the_unit_cube_by_default) {
  EXPECT_EQ(done({"new", "box", "-o", "box.ovm"}),
            "box.ovm: 27 vertices, 54 edges, 36 faces, 8 cells\n");
  const Json info = Json::parse(done({"info", "box.ovm", "--json"}));
  EXPECT_EQ(point_of(info["min"]), glm::dvec3(0));
  EXPECT_EQ(point_of(info["max"]), glm::dvec3(1));
}

TEST_F(LatticeCommands, numbers_are_decimal_even_with_a_leading_zero) {
  EXPECT_EQ(done({"new", "box", "--cells", "010", "1", "1", "-o", "box.json"}),
            "box.json: 44 vertices, 84 edges, 51 faces, 10 cells\n");
}

TEST_F(LatticeCommands, the_scheme_is_what_was_asked_for) {
  done({"new", "box", "-o", "default.json"});
  done({"new", "cylinder", "--scheme", "mj96", "-o", "paper.json"});
  EXPECT_EQ(read_json("default.json")["scheme"], "catmull-clark");
  EXPECT_EQ(read_json("paper.json")["scheme"], "mj96");
}

/// A bar along a slanted axis whose radius changes from 0.7 to 0.4.
struct Bar {
  glm::dvec3 from{1, 2, 3};
  glm::dvec3 to{3, 5, 9};
  double radius = 0.7;
  double end_radius = 0.4;
};

std::string points_round(const Bar& bar, double scale) {
  const glm::dvec3 axis = glm::normalize(bar.to - bar.from);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(axis, right);
  std::string csv = "x,y,z\n";
  for (int i = 1; i < 20; ++i) {
    const double t = i / 20.0;
    for (int j = 0; j < 72; ++j) {
      const double angle = 2 * std::numbers::pi * j / 72;
      const double r = scale * (bar.radius * (1 - t) + bar.end_radius * t);
      const glm::dvec3 x =
          bar.from * (1 - t) + bar.to * t + r * (std::cos(angle) * right + std::sin(angle) * up);
      csv += std::to_string(x.x) + "," + std::to_string(x.y) + "," + std::to_string(x.z) + "\n";
    }
  }
  return csv;
}

std::size_t count_status(const std::string& csv, const std::string& status) {
  std::size_t n = 0;
  for (const auto& row : rows_of(csv)) {
    n += row.at(3) == status ? 1 : 0;
  }
  return n;
}

TEST_F(LatticeCommands, a_new_cylinder_holds_every_point_within_its_radius) {
  write_file("within.csv", points_round(Bar(), 1 - 4e-6));  // the CSV has six digits
  write_file("beyond.csv", points_round(Bar(), 1.5));
  for (const auto& [sectors, layers] : {std::pair("3", "4"), std::pair("8", "1")}) {
    done({"new",          "cylinder", "--from",    "1",     "2",        "3",
          "--to",         "3",        "5",         "9",     "--radius", "0.7",
          "--end-radius", "0.4",      "--sectors", sectors, "--layers", layers,
          "-o",           "bar.json"});
    EXPECT_EQ(count_status(done({"eval", "bar.json", "--at", "within.csv"}), "inside"), 1368u)
        << sectors << " sectors, " << layers << " layers";
  }
  EXPECT_EQ(count_status(done({"eval", "bar.json", "--at", "beyond.csv"}), "outside"), 1368u);
}

TEST_F(LatticeCommands, a_new_cylinder_lists_the_centre_and_the_ring_of_every_step) {
  EXPECT_EQ(done({"new", "cylinder", "--to", "0", "0", "6", "--sectors", "5", "--layers", "3", "-o",
                  "bar.json"}),
            "bar.json: 24 vertices, 58 edges, 50 faces, 15 cells\n");
  const Json vertices = read_json("bar.json")["vertices"];
  ASSERT_EQ(vertices.size(), 24u);
  for (std::size_t step = 0; step < 4; ++step) {
    expect_near(point_of(vertices[6 * step]), {0, 0, 2.0 * static_cast<double>(step)}, 1e-15);
    const double radius = glm::length(point_of(vertices[6 * step + 1]) * glm::dvec3(1, 1, 0));
    EXPECT_GT(radius, 0.5);
    for (std::size_t i = 2; i < 6; ++i) {
      EXPECT_NEAR(glm::length(point_of(vertices[6 * step + i]) * glm::dvec3(1, 1, 0)), radius,
                  1e-15);
    }
  }
}

TEST_F(LatticeCommands, convert_extrudes_every_face_into_a_stack_of_cells) {
  write_file(
      "strip.obj",
      "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 2 3 6 5\nf 3 4 7 6\n");
  EXPECT_EQ(done({"convert", "strip.obj", "--extrude", "0.5", "0", "-2", "--layers", "2", "-o",
                  "strip.json"}),
            "strip.json: 18 vertices, 33 edges, 20 faces, 4 cells\n"
            "  faces at inner edges     1 × 4\n"
            "  faces at boundary edges  20 × 2, 12 × 3\n"
            "  faces of cells           4 × 6\n"
            "  cells meet in an edge only at 0 edges, in a vertex only at 0 vertices\n"
            "  cells inverted at a corner: 0\n"
            "  6 of the model's 7 points inside: 85.71 %\n");
  const Json vertices = read_json("strip.json")["vertices"];
  ASSERT_EQ(vertices.size(), 18u);
  for (std::size_t i = 0; i < 18; ++i) {
    const auto layer = static_cast<double>(i / 6);
    expect_near(point_of(vertices[i]),
                glm::dvec3(i % 3, i / 3 % 2, 0) + layer * glm::dvec3(0.25, 0, -1), 1e-15);
  }
}

TEST_F(LatticeCommands, convert_refuses_a_mesh_without_faces_and_a_zero_direction) {
  write_file("points.obj", "v 0 0 0\nv 1 0 0\n");
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(refusal({"convert", "points.obj", "--extrude", "0", "0", "1", "-o", "a.json"}, 2),
            "points.obj: has no faces to make cells of");
  EXPECT_EQ(refusal({"convert", "cube.obj", "--extrude", "0", "0", "0", "-o", "a.json"}, 2),
            "extrude: the direction must be finite and not zero");
}

TEST_F(LatticeCommands, refining_a_lattice_gives_its_grid_at_half_the_spacing) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.json"});
  EXPECT_EQ(done({"refine", "cube.json", "--levels", "2", "-o", "fine.ovm"}),
            "fine.ovm: 125 vertices, 300 edges, 240 faces, 64 cells\n");
  done({"refine", "fine.ovm", "-o", "finer.json"});
  const Json info = Json::parse(done({"info", "finer.json", "--json"}));
  EXPECT_EQ(info["cells"], 512);
  EXPECT_EQ(point_of(info["max"]), glm::dvec3(1));
  const Json finer = read_json("finer.json");
  for (const Json& vertex : finer["vertices"]) {
    const glm::dvec3 eighths = 8.0 * point_of(vertex);
    EXPECT_EQ(eighths, glm::round(eighths));
  }
}

TEST_F(LatticeCommands, refining_a_smooth_cube_moves_corner_and_edge_points_as_its_surface) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.json"});
  Json json = read_json("cube.json");
  json["sharp_edges"] = Json::array();
  json["sharp_vertices"] = Json::array();
  write_json("smooth.json", json);
  write_file("cube.obj", cube_obj());
  done({"refine", "smooth.json", "-o", "fine.json"});
  EXPECT_EQ(done({"refine", "cube.obj", "-o", "fine.obj"}), "fine.obj: 26 points, 24 faces\n");

  // Corner: (mean of 3 face points + 2 · mean of 3 edge midpoints) / 3.
  expect_near(point_of(read_json("fine.json")["vertices"][0]), glm::dvec3(2.0 / 9), 1e-15);
  double x = 0;
  double y = 0;
  double z = 0;
  ASSERT_EQ(std::sscanf(read_file("fine.obj").c_str() + read_file("fine.obj").find("v "),
                        "v %lf %lf %lf", &x, &y, &z),
            3);
  expect_near({x, y, z}, glm::dvec3(2.0 / 9), 1e-7);
}

TEST_F(LatticeCommands, refining_a_lattice_refines_its_pose_and_its_tags) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "cube.json"});
  Json json = read_json("cube.json");
  json["sharp_edges"] = {{0, 1, 2.5}};
  json["sharp_vertices"] = {{7, 1.25}};
  json["note"] = "mine";
  write_json("tagged.json", json);
  const AffineMap map;
  pose_by("tagged.json", "posed.json", map);
  done({"refine", "posed.json", "--scheme", "mj96", "-o", "fine.json"});

  const Json fine = read_json("fine.json");
  EXPECT_EQ(fine["scheme"], "mj96");
  EXPECT_EQ(fine["note"], "mine");
  ASSERT_EQ(fine["sharp_edges"].size(), 2u);  // 0 and 1 with the point of the edge between
  EXPECT_EQ(fine["sharp_edges"][0], Json({0, 8, 1.5}));
  EXPECT_EQ(fine["sharp_edges"][1], Json({1, 8, 1.5}));
  EXPECT_EQ(fine["sharp_vertices"], Json::parse("[[7, 0.25]]"));
  ASSERT_EQ(fine["pose"].size(), 27u);
  for (std::size_t i = 0; i < 27; ++i) {
    expect_near(point_of(fine["pose"][i]), map(point_of(fine["vertices"][i])), 1e-14);
  }
}

TEST_F(LatticeCommands, refine_refuses_levels_out_of_range_and_a_scheme_for_models) {
  done({"new", "box", "-o", "box.json"});
  write_file("cube.obj", cube_obj());
  for (const char* levels : {"0", "-1", "9"}) {
    EXPECT_EQ(refusal({"refine", "box.json", "--levels", levels, "-o", "fine.json"}, 2),
              "--levels must be 1 to 8");
  }
  EXPECT_EQ(refusal({"refine", "cube.obj", "--scheme", "mj96", "-o", "fine.obj"}, 2),
            "--scheme is for lattices; a model is refined as a Catmull-Clark surface");
  EXPECT_EQ(refusal({"refine", "cube.obj", "-o", "fine.json"}, 1),
            "fine.json: a refined model is written as .obj; name the output *.obj");
  EXPECT_EQ(files(), (std::vector<std::string>{"box.json", "cube.obj"}));
}

TEST_F(LatticeCommands, refine_makes_an_obj_of_a_model_in_any_format) {
  write_file("tile.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  done({"refine", "tile.off", "-o", "fine.obj"});
  EXPECT_THAT(done({"info", "fine.obj"}), ::testing::HasSubstr("model with 9 points, 4 faces"));
  EXPECT_EQ(refusal({"refine", "tile.off", "-o", "fine.off"}, 1),
            "fine.off: a refined model is written as .obj; name the output *.obj");
}

TEST_F(LatticeCommands, convert_says_that_a_closed_mesh_cannot_be_extruded) {
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(refusal({"convert", "cube.obj", "--extrude", "0", "0", "1", "-o", "c.json"}, 2),
            "extrude: the mesh is closed, only an open surface can be extruded: draw the section "
            "of the lattice, or cut the mesh open");
  EXPECT_EQ(files(), std::vector<std::string>{"cube.obj"});
}

TEST_F(LatticeCommands, a_lattice_that_would_not_be_valid_is_named_by_its_file) {
  EXPECT_EQ(refusal({"new", "box", "--max", "1e-200", "1", "1", "-o", "flat.json"}, 1),
            "flat.json: invalid lattice: edge 0-1: its ends coincide (and 25 more defects)");
  EXPECT_EQ(refusal({"new", "cylinder", "--end-radius", "0", "-o", "cone.json"}, 2),
            "--end-radius must be positive: cells cannot end in a point");
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace espalier::tools
