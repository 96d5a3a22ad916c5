#include "lattice/io/lattice_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <random>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/json_lattice.h"
#include "lattice/io/ovm_reader.h"
#include "lattice/topology/validate.h"
#include "tests/lattice/shapes.h"

namespace espalier {
namespace {

using shapes::Shape;

class LatticeFile : public ::testing::Test {
 protected:
  LatticeFile()
      : folder_(std::filesystem::temp_directory_path() /
                ("espalier_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~LatticeFile() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;  // thousands: without waiting for the disk
    return path(name);
  }

  /// The message that reading `text` ends with, without the file's name; empty if it is valid.
  std::string error_of(const std::string& name, const std::string& text) const {
    return error_of_reading(write(name, text),
                            [](const std::string& file) { (void)read_lattice(file); });
  }

  /// The same without a file: as read_lattice() does once it has read one.
  std::string error_of_text(const std::string& name, const std::string& text) const {
    return error_of_reading(path(name),
                            [&](const std::string& file) { (void)lattice_from_text(file, text); });
  }

  static SubdivisionLattice lattice_from_text(const std::string& file, const std::string& text) {
    return build_lattice(
        file.ends_with(".ovm") ? parse_ovm(file, text) : parse_json_lattice(file, text), file);
  }

 private:
  /// read: called with `file`.
  template <class Read>
  static std::string error_of_reading(const std::string& file, const Read& read) {
    try {
      read(file);
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find(file), 0u) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_LT(what.size(), file.size() + 400) << what;
      return what.substr(std::min(file.size(), what.size()));
    }
    return "";
  }

  std::filesystem::path folder_;
};

bool same_bits(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [&](const glm::dvec3& p, const glm::dvec3& q) {
        return bits(p.x) == bits(q.x) && bits(p.y) == bits(q.y) && bits(p.z) == bits(q.z);
      });
}

bool same_rows(const CompressedRows<std::int32_t>& a, const CompressedRows<std::int32_t>& b) {
  bool is_same = a.n_rows() == b.n_rows();
  for (std::size_t i = 0; is_same && i < a.n_rows(); ++i) {
    is_same = std::equal(a[i].begin(), a[i].end(), b[i].begin(), b[i].end());
  }
  return is_same;
}

void expect_equal(const SubdivisionLattice& a, const SubdivisionLattice& b) {
  const Polyhedra p = a.complex->polyhedra();
  const Polyhedra q = b.complex->polyhedra();
  EXPECT_TRUE(same_rows(p.faces, q.faces));
  EXPECT_TRUE(same_rows(p.cells, q.cells));
  EXPECT_TRUE(same_bits(a.rest, b.rest));
  EXPECT_TRUE(same_bits(a.pose, b.pose));
  EXPECT_EQ(a.sharpness, b.sharpness);
  EXPECT_EQ(a.scheme, b.scheme);
  EXPECT_EQ(a.extra_json, b.extra_json);
}

/// A lattice that uses everything a file can hold, at coordinates that are hard to print.
SubdivisionLattice full_lattice() {
  SubdivisionLattice lattice = shapes::lattice(shapes::warped_grid(2, 2, 1));
  lattice.rest[0] = {-0.0, 0.1, 1.0 / 3};
  lattice.pose = lattice.rest;
  for (std::size_t i = 0; i < lattice.pose.size(); ++i) {
    lattice.pose[i] += glm::dvec3(1e-17, 123456789.123, 1e17 / 3) * static_cast<double>(i);
  }
  lattice.pose[3] = {5e-324, -1e18, 123456789012345680.0};
  lattice.scheme = Scheme::MacCrackenJoy;
  lattice.sharpness.edges[EdgeId{0}] = 0.3f;
  lattice.sharpness.edges[EdgeId{1}] = 0.0f;
  lattice.sharpness.vertices[VertexId{0}] = 2.7182817f;
  lattice.extra_json = R"({"keys":[0.1,1,-2,null,true],"note":"Zürich: \"a\"\nb"})";
  return lattice;
}

const char* const kCube = R"({
  "format": "espalier/1", "type": "subdivision",
  "vertices": [[0,0,0],[1,0,0],[0,1,0],[1,1,0],[0,0,1],[1,0,1],[0,1,1],[1,1,1]],
  "faces": [[0,1,3,2],[4,5,7,6],[0,1,5,4],[3,2,6,7],[4,6,2,0],[7,5,1,3]],
  "cells": [[5,3,1,4,2,0]]
})";

std::string cube_with(const std::string& from, const std::string& to) {
  std::string text = kCube;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string cube_and(const std::string& member) {
  return cube_with("\"cells\"", member + ", \"cells\"");
}

const char* const kTetrahedronOvm = R"(OVM ASCII
Vertices
4
0 0 0
0 0 1
1 0 0
0 1 0
Edges
6
0 1
1 2
2 0
2 3
3 1
3 0
Faces
4
3 0 2 4
3 2 6 8
3 5 6 10
3 0 9 10
Polyhedra
1
4 0 3 4 7
)";

std::string tetrahedron_with(const std::string& from, const std::string& to) {
  std::string text = kTetrahedronOvm;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

#define EXPECT_ERROR(name, text, fragment)                           \
  do {                                                               \
    const std::string message = error_of(name, text);                \
    EXPECT_NE(message.find(fragment), std::string::npos) << message; \
  } while (false)

TEST_F(LatticeFile, keeps_every_bit_through_json_and_ovm) {
  const SubdivisionLattice lattice = full_lattice();
  write_lattice(path("a.json"), lattice);
  const SubdivisionLattice first = read_lattice(path("a.json"));
  expect_equal(lattice, first);
  write_lattice(path("b.ovm"), first);
  const SubdivisionLattice second = read_lattice(path("b.ovm"));
  expect_equal(lattice, second);
  write_lattice(path("c.JSON"), second);
  EXPECT_EQ(read_file(path("a.json")), read_file(path("c.JSON")));
}

TEST_F(LatticeFile, keeps_every_family) {
  for (const Shape& shape :
       {shapes::tetrahedron(), shapes::pyramid_on_cube(), shapes::regular_prism(7),
        shapes::wedge_cylinder(5), shapes::columns_sharing_a_line(2),
        shapes::cubes_sharing_a_vertex(), shapes::concave_cell_with_box_in_notch()}) {
    const SubdivisionLattice lattice = shapes::lattice(shape);
    for (const char* name : {"a.json", "a.ovm"}) {
      write_lattice(path(name), lattice);
      expect_equal(lattice, read_lattice(path(name)));
    }
  }
}

TEST_F(LatticeFile, leaves_out_what_is_as_usual) {
  write_lattice(path("a.json"), shapes::lattice(shapes::cube()));
  const std::string json = read_file(path("a.json"));
  EXPECT_EQ(json.find("sharp"), std::string::npos);
  EXPECT_EQ(json.find("pose"), std::string::npos);
  EXPECT_NE(json.find("\n    [1,0,1],\n"), std::string::npos) << "one vertex a line";
  write_lattice(path("a.ovm"), shapes::lattice(shapes::cube()));
  EXPECT_EQ(read_file(path("a.ovm")).find("Prop"), std::string::npos);
}

TEST_F(LatticeFile, tags_automatically_where_a_list_is_absent) {
  const SubdivisionLattice plain = read_lattice(write("a.json", kCube));
  EXPECT_EQ(plain.sharpness, automatic_sharpness(*plain.complex));
  EXPECT_EQ(plain.scheme, Scheme::CatmullClark);
  EXPECT_TRUE(plain.pose.empty());

  const SubdivisionLattice none = read_lattice(write("b.json", cube_and("\"sharp_edges\": []")));
  EXPECT_EQ(none.sharpness.edges, smooth_sharpness(*none.complex).edges);
  EXPECT_EQ(none.sharpness.vertices, plain.sharpness.vertices);

  const SubdivisionLattice some =
      read_lattice(write("c.json", cube_and("\"sharp_vertices\": [[3, 1.5]]")));
  EXPECT_EQ(some.sharpness.edges, plain.sharpness.edges);
  EXPECT_EQ(some.sharpness.vertices[VertexId{3}], 1.5f);
  EXPECT_EQ(some.sharpness.vertices[VertexId{0}], 0.0f);

  // Nothing sharp is written as empty lists.
  SubdivisionLattice smooth = plain;
  smooth.sharpness = smooth_sharpness(*plain.complex);
  for (const char* name : {"d.json", "d.ovm"}) {
    write_lattice(path(name), smooth);
    expect_equal(smooth, read_lattice(path(name)));
  }
}

TEST_F(LatticeFile, orients_faces_in_any_order_and_winding) {
  const SubdivisionLattice lattice = read_lattice(write("a.json", kCube));
  EXPECT_DOUBLE_EQ(signed_volume(lattice.complex->polyhedra(), 0, lattice.rest), 1.0);
}

TEST_F(LatticeFile, refuses_unknown_extensions) {
  EXPECT_ERROR("a.txt", kCube, "lattice files end in .json or .ovm");
  EXPECT_ERROR("a.ovmb", "OVMB", "is binary OpenVolumeMesh");
  EXPECT_THROW(write_lattice(path("a.vtk"), shapes::lattice(shapes::cube())), FileError);
  EXPECT_FALSE(std::filesystem::exists(path("a.vtk")));
  EXPECT_THROW((void)read_lattice(path("missing.json")), FileError);
}

TEST_F(LatticeFile, refuses_to_write_what_it_could_not_read) {
  SubdivisionLattice lattice = shapes::lattice(shapes::cube());
  lattice.pose.resize(3);
  EXPECT_THROW(write_lattice(path("a.json"), lattice), LatticeError);
  lattice.pose = lattice.rest;
  lattice.pose[2].x = std::nan("");
  EXPECT_THROW(write_lattice(path("a.ovm"), lattice), LatticeError);
  lattice.pose.clear();
  lattice.sharpness.edges[EdgeId{0}] = -1;
  EXPECT_THROW(write_lattice(path("a.ovm"), lattice), LatticeError);
  lattice.sharpness = smooth_sharpness(*lattice.complex);
  lattice.extra_json = "[1]";
  EXPECT_THROW(write_lattice(path("a.json"), lattice), LatticeError);
  EXPECT_THROW(write_lattice(path("a.ovm"), lattice), LatticeError);
}

TEST_F(LatticeFile, says_what_is_wrong_with_the_syntax_of_json) {
  EXPECT_ERROR("a.json", "", ":1: is not valid JSON: syntax error");
  EXPECT_ERROR("a.json", kTetrahedronOvm, ":1: is not valid JSON: syntax error");
  EXPECT_ERROR("a.json", "{\n\"a\": 1,\n}", ":3: is not valid JSON: syntax error");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[NaN,0,0]"), ":3: is not valid JSON");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[Infinity,0,0]"), ":3: is not valid JSON");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[1e999,0,0]"), ":3: is not valid JSON: number");
  EXPECT_ERROR("a.json", "[1]", ": holds an array, not a JSON object");
  EXPECT_ERROR("a.json", cube_and("\"cells\": []"), ": the key \"cells\" is given twice");
  EXPECT_ERROR("a.json", std::string(100000, '['), ": is nested deeper than 100 levels");
  EXPECT_ERROR("a.json", cube_and("\"x\": " + std::string(100000, '[')), "nested deeper");
  EXPECT_ERROR("a.json", "{\"a\": \"" + std::string(100000, 'x'), "is not valid JSON");
}

TEST_F(LatticeFile, says_what_kind_of_json_it_reads) {
  EXPECT_ERROR("a.json", "{}", ": is no lattice: \"format\": \"espalier/1\" is missing");
  EXPECT_ERROR("a.json", cube_with("espalier/1", "espalier/2"),
               ": format: is \"espalier/2\", this version reads \"espalier/1\"");
  EXPECT_ERROR(
      "a.json", cube_with("\"subdivision\"", "\"nurbs\""),
      ": type: is \"nurbs\", not subdivision; grids are of type bezier, bspline, nurbs or thb");
  EXPECT_ERROR("a.json", cube_with(", \"type\": \"subdivision\"", ""),
               ": \"type\" is missing: subdivision, bezier, bspline, nurbs or thb");
  EXPECT_ERROR("a.json", cube_and("\"scheme\": \"loop\""), ": scheme: is \"loop\", not");
  EXPECT_ERROR("a.json", cube_and("\"scheme\": 3"), ": scheme: is 3, not");
  EXPECT_ERROR("a.json", cube_with("\"faces\"", "\"fences\""), ": \"faces\" is missing");
}

TEST_F(LatticeFile, names_the_place_of_wrong_values_in_json) {
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[1,\"0\",0]"), ": vertices[1][1]: is \"0\", not a");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[1,null,0]"), ": vertices[1][1]: is null, not a");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[1,0]"), ": vertices[1]: has 2 values, needs [x,");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[1,0,0,1]"), ": vertices[1]: has 4 values");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "7"), ": vertices[1]: is 7, not [x, y, z]");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[1,-1.1e18,0]"),
               ": vertices[1][1]: is -1.1e+18, be");
  EXPECT_ERROR("a.json", cube_with("[0,1,3,2]", "[0,1,3,8]"),
               ": faces[0][3]: vertex 8 does not exist, there are 8 (0…7)");
  EXPECT_ERROR("a.json", cube_with("[0,1,3,2]", "[0,1,-3,2]"), ": faces[0][2]: vertex -3 does not");
  EXPECT_ERROR("a.json", cube_with("[0,1,3,2]", "[0,1,3.5,2]"), ": faces[0][2]: is 3.5, not a wh");
  EXPECT_ERROR("a.json", cube_with("[0,1,3,2]", "[0,1,1e18,2]"), ": faces[0][2]: vertex 1e+18 d");
  EXPECT_ERROR("a.json", cube_with("[0,1,3,2]", "[0,1,18446744073709551615,2]"),
               ": faces[0][2]: v");
  EXPECT_ERROR("a.json", cube_with("[0,1,3,2]", "{\"a\":1}"), ": faces[0]: is object, not a list");
  EXPECT_ERROR("a.json", cube_with("[[5,3,1,4,2,0]]", "[[5,99,1,4,2,0]]"),
               ": cells[0][1]: face 99 does not exist, there are 6 (0…5)");
  EXPECT_ERROR("a.json", cube_with("[[5,3,1,4,2,0]]", "1000000000"), ": cells: is 1000000000, not");
  EXPECT_ERROR("a.json", cube_and("\"pose\": [[0,0,0]]"), ": pose: has 1 points, needs 8");
  EXPECT_ERROR("a.json", cube_and("\"pose\": []"), ": pose: has 0 points, needs 8");
  EXPECT_ERROR("a.json", cube_and("\"sharp_edges\": [[0,1]]"), ": sharp_edges[0]: has 2 values");
  EXPECT_ERROR("a.json", cube_and("\"sharp_edges\": [[0,8,1]]"), ": sharp_edges[0][1]: vertex 8");
  EXPECT_ERROR("a.json", cube_and("\"sharp_edges\": [[0,1,-1]]"),
               ": sharp_edges[0][2]: sharpness -1 is not a finite number from 0 up");
  EXPECT_ERROR("a.json", cube_and("\"sharp_edges\": [[0,1,1e300]]"), ": sharp_edges[0][2]: sharp");
  EXPECT_ERROR("a.json", cube_and("\"sharp_vertices\": [[0,\"1\"]]"), ": sharp_vertices[0][1]: sh");
}

TEST_F(LatticeFile, names_sharp_elements_that_cannot_be) {
  EXPECT_ERROR("a.json", cube_and("\"sharp_edges\": [[0,1,1],[0,3,1]]"),
               ": sharp_edges[1]: edge 0-3 does not exist");
  EXPECT_ERROR("a.json", cube_and("\"sharp_edges\": [[0,1,1],[1,0,2]]"),
               ": sharp_edges[1]: edge 1-0 is listed twice");
  EXPECT_ERROR("a.json", cube_and("\"sharp_vertices\": [[3,1],[3,1]]"),
               ": sharp_vertices[1]: vertex 3 is listed twice");
  SubdivisionLattice grid = shapes::lattice(shapes::box_grid(2, 2, 2));
  grid.sharpness.edges[grid.complex->find_edge(VertexId{4}, VertexId{13})] = 1;
  write_lattice(path("b.json"), grid);
  EXPECT_ERROR("b.json", read_file(path("b.json")), "edge 4-13 is not on the boundary");
  grid = shapes::lattice(shapes::box_grid(2, 2, 2));
  grid.sharpness.vertices[VertexId{13}] = 1;
  write_lattice(path("b.ovm"), grid);
  EXPECT_ERROR("b.ovm", read_file(path("b.ovm")), "vertex 13 is not on the boundary");
}

TEST_F(LatticeFile, names_defects_of_the_lattice) {
  EXPECT_ERROR("a.json", cube_with("[[5,3,1,4,2,0]]", "[[5,3,1,4,2]]"),
               ": invalid lattice: cell 0: is not closed");
  EXPECT_ERROR("a.json", cube_with("[[5,3,1,4,2,0]]", "[]"), ": invalid lattice: has no cells");
  EXPECT_ERROR("a.json", cube_with("[1,0,0]", "[0,0,0]"), ": invalid lattice: edge 0-1: its ends");
  const RawLattice raw = read_raw_lattice(write("b.json", cube_with("[1,0,0]", "[0,0,0]")));
  EXPECT_FALSE(validate(raw.polyhedra, raw.rest).empty()) << "a raw lattice may be invalid";
}

TEST_F(LatticeFile, checks_raw_lattices_that_no_file_made) {
  const RawLattice raw = read_raw_lattice(write("a.json", kCube));
  RawLattice bad = raw;
  bad.pose.resize(7);
  EXPECT_THROW((void)build_lattice(bad, "a.json"), LatticeError);
  bad = raw;
  bad.rest.pop_back();
  EXPECT_THROW((void)build_lattice(bad, "a.json"), LatticeError);
  bad = raw;
  bad.sharp_edges = {{{0, 8}, 1.0f}};
  EXPECT_THROW((void)build_lattice(bad, "a.json"), LatticeError);
  bad = raw;
  bad.sharp_vertices = {{-1, 1.0f}};
  EXPECT_THROW((void)build_lattice(bad, "a.json"), LatticeError);
}

TEST_F(LatticeFile, reads_plain_ovm_with_comments_blank_lines_and_any_case) {
  std::string text =
      tetrahedron_with("OVM ASCII\nVertices", "# made by hand\n\novm ascii\r\nVERTICES");
  const SubdivisionLattice lattice = read_lattice(write("a.ovm", text));
  EXPECT_EQ(lattice.complex->n_edges(), 6u);
  EXPECT_EQ(lattice.rest[1], glm::dvec3(0, 0, 1));
  EXPECT_EQ(lattice.scheme, Scheme::CatmullClark);
  EXPECT_EQ(lattice.sharpness, automatic_sharpness(*lattice.complex));
}

TEST_F(LatticeFile, skips_foreign_properties_of_ovm_by_their_counts) {
  const std::string text = std::string(kTetrahedronOvm) +
                           "VProp int \"a\"\n1\n2\n3\n4\n"
                           "EProp vec3d \"VProp int\"\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n"
                           "MProp string \"s\"\n12:MProp int \"x\"\n"
                           "CProp string \"two lines\"\n9:one\nCProp\n"
                           "FProp vector_double \"v\"\n2\n1.5\n2.5\n0\n1\n3\n0\n"
                           "MProp map_he_int \"m\"\n2\n0\n5\n1\n7\n"
                           "MProp vector_vector_hfh \"h\"\n2\n1\n3\n2\n4\n5\n"
                           "HFProp bool \"b\"\n1\n0\n1\n0\n1\n0\n1\n0\n"
                           "VProp float \"espalier:sharpness\"\n0\n0.5\n0\n10\n"
                           "MProp string \"espalier:scheme\"\n4:mj96\n";
  const SubdivisionLattice lattice = read_lattice(write("a.ovm", text));
  EXPECT_EQ(lattice.scheme, Scheme::MacCrackenJoy);
  EXPECT_EQ(lattice.sharpness.vertices.values(), (std::vector<float>{0, 0.5f, 0, 10}));
}

TEST_F(LatticeFile, names_the_line_of_what_is_wrong_in_ovm) {
  EXPECT_ERROR("a.ovm", "", ": is empty");
  EXPECT_ERROR("a.ovm", kCube, ":1: is no OpenVolumeMesh file");
  EXPECT_ERROR("a.ovm", tetrahedron_with("ASCII", "BINARY"), ": is binary OpenVolumeMesh");
  EXPECT_ERROR("a.ovm", "OVMB\n\x1a\n", ": is binary OpenVolumeMesh");
  EXPECT_ERROR("a.ovm", "OVM ASCII\nVertices\n1000000000\n0 0 0\n",
               ":3: announces 1000000000 vert");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Edges\n6", "Edges\n1000000000"), ":9: announces 1000000");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Faces\n4", "Faces\n1000000000"), ":17: announces");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Polyhedra\n1", "Polyhedra\n999999999999"), ":23: ann");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Vertices\n4", "Vertices\n-4"), ":3: number of vertices");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Vertices\n4", "Vertices\n5"), ":8: x is 'Edges', not a");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Vertices\n4", "Vertices\n3"), "expected the section Edg");
  EXPECT_ERROR("a.ovm", tetrahedron_with("1 0 0", "1 nan 0"), ":6: y is not finite");
  EXPECT_ERROR("a.ovm", tetrahedron_with("1 0 0", "1 2e18 0"), ":6: y is beyond the largest");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0\nFaces", "3 3\nFaces"), ":15: edge 5 joins vertex 3");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0\nFaces", "3 1\nFaces"), ": edges 4 and 5 both join");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0\nFaces", "3 4\nFaces"), ":15: vertex 4 does not exi");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0 2 4", "3 0 2 12"), ":18: half-edge 12 does not exis");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0 2 4", "3 0 3 4"), ":18: face 0: half-edge 3 begins");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0 2 4", "2 0 2"), ":18: face 0: its half-edges end at");
  EXPECT_ERROR("a.ovm", tetrahedron_with("3 0 2 4", "1000000000 0 2"), ":18: half-edge is missing");
  EXPECT_ERROR("a.ovm", tetrahedron_with("4 0 3 4 7", "4 0 3 4 8"), ":24: half-face 8 does not ex");
  EXPECT_ERROR("a.ovm", tetrahedron_with("4 0 3 4 7", "3 0 3 4 7"), ":24: unexpected '7' after");
  EXPECT_ERROR("a.ovm", tetrahedron_with("Edges\n6\n", "Edges\n7\n0 1\n"), "edges 0 and 1 both");
}

TEST_F(LatticeFile, names_edges_of_no_face_in_ovm) {
  std::string text = tetrahedron_with("Vertices\n4\n", "Vertices\n5\n");
  text.replace(text.find("Edges\n6\n"), 8, "3 3 3\nEdges\n7\n");
  text.replace(text.find("Faces"), 5, "0 4\nFaces");
  EXPECT_ERROR("a.ovm", text, ": edge 6 (0-4) belongs to no face");
}

TEST_F(LatticeFile, names_what_is_wrong_in_properties_of_ovm) {
  const std::string plain = kTetrahedronOvm;
  EXPECT_ERROR("a.ovm", plain + "Prop\n", ":25: expected a property");
  EXPECT_ERROR("a.ovm", plain + "VProp int \"a\n", ":25: a property needs a type and a name");
  EXPECT_ERROR("a.ovm", plain + "VProp int \"a\"\n1\n2\n", "the file ends after 2 of 4 values of");
  EXPECT_ERROR("a.ovm", plain + "MProp string \"a\"\n999999999:x\n",
               "the file ends inside a strin");
  EXPECT_ERROR("a.ovm", plain + "MProp string \"a\"\nabc\n", ":26: property \"a\": expected a str");
  EXPECT_ERROR("a.ovm", plain + "MProp vector_int \"a\"\n999999999\n1",
               "the file ends inside prop");
  EXPECT_ERROR("a.ovm", plain + "MProp string \"espalier:scheme\"\n4:loop\n",
               "the scheme is neith");
  EXPECT_ERROR("a.ovm", plain + "MProp string \"espalier:extra\"\n3:[1]\n", "not a JSON object");
  EXPECT_ERROR("a.ovm", plain + "VProp float \"espalier:sharpness\"\n0\n-1\n",
               ":27: sharpness -1 ");
  EXPECT_ERROR("a.ovm", plain + "VProp float \"espalier:sharpness\"\n0\nnan\n",
               ":27: sharpness na");
}

TEST_F(LatticeFile, survives_truncation_at_every_byte) {
  for (const char* name : {"a.json", "a.ovm"}) {
    write_lattice(path(name), full_lattice());
    const std::string whole = read_file(path(name));
    std::size_t n_valid = 0;
    for (std::size_t n = 0; n < whole.size(); ++n) {
      n_valid += error_of_text(name, whole.substr(0, n)).empty();
    }
    if (std::string(name) == "a.json") {
      EXPECT_EQ(n_valid, 1u) << "but for its last line end a JSON file is needed whole";
    }
  }
}

TEST_F(LatticeFile, survives_random_bytes) {
  std::mt19937 random(1);
  const std::string alphabet = "0123456789-+.eE[]{},:\"\n #abVEFCMP\0\xff";
  for (const char* name : {"a.json", "a.ovm"}) {
    SubdivisionLattice lattice = shapes::lattice(shapes::pyramid_on_cube());
    lattice.pose = lattice.rest;
    lattice.sharpness.edges[EdgeId{0}] = 0.5f;
    lattice.extra_json = "{\"a\":[1,2]}";
    write_lattice(path(name), lattice);
    const std::string whole = read_file(path(name));
    for (int round = 0; round < 3000; ++round) {
      std::string text = whole;
      for (unsigned i = 0, n = 1 + random() % 4; i < n; ++i) {
        const std::size_t at = random() % text.size();
        switch (random() % 3) {
          case 0:
            text[at] = alphabet[random() % alphabet.size()];
            break;
          case 1:
            text.erase(at, 1 + random() % 8);
            break;
          default:
            text.insert(at, 1, alphabet[random() % alphabet.size()]);
        }
      }
      if (error_of_text(name, text).empty()) {
        const SubdivisionLattice read = lattice_from_text(path(name), text);
        EXPECT_TRUE(validate(read.complex->polyhedra(), read.rest).empty());
      }
    }
  }
}

}  // namespace
}  // namespace espalier
