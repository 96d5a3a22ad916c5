/// Readers of volume meshes: MEDIT, legacy VTK, Gmsh 4.1.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "lattice/core/error.h"
#include "lattice/io/gmsh_reader.h"
#include "lattice/io/medit_reader.h"
#include "lattice/io/vtk_legacy_reader.h"
#include "lattice/topology/validate.h"
#include "tests/lattice/mesh_shape.h"

namespace espalier {
namespace {

using Parse = RawLattice (*)(const std::string&, std::string_view);

/// A hexahedron, a prism beside it, a pyramid on top of it and a tetrahedron on the prism; point 0
/// is used by no cell, and there is a triangle and a quadrilateral to skip.
const std::string kMedit =
    "MeshVersionFormatted 2\n# a comment\nDimension\n3\nVertices\n12\n9 9 9 0\n"
    "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n0 0 1 1\n1 0 1 1\n1 1 1 1\n0 1 1 1\n"
    "2 0.5 0 1\n2 0.5 1 1\n0.5 0.5 2 1\n"
    "Triangles\n1\n2 3 4 7\nQuadrilaterals 1 2 3 4 5 7\nRequiredVertices\n1\n2\n"
    "Hexahedra\n1\n2 3 4 5 6 7 8 9 3\nPrisms\n1\n3 10 4 7 11 8 3\nPyramids\n1\n6 7 8 9 12 3\n"
    "Tetrahedra 1\n7 11 8 12 4\nEnd\n";

const std::string kVtk =
    "# vtk DataFile Version 3.0\nBINARY in the title\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 12 double\n9 9 9\n0 0 0 1 0 0 1 1 0 0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "2 0.5 0\n2 0.5 1\n0.5 0.5 2\n\nCELLS 5 30\n"
    "8 1 2 3 4 5 6 7 8\n6 2 9 3 6 10 7\n5 5 6 7 8 11\n4 6 10 7 11\n3 1 2 3\n"
    "CELL_TYPES 5\n12 13 14\n10\n5\nCELL_DATA 5\nSCALARS material int\nLOOKUP_TABLE default\n"
    "1\n1\n1\n1\n1\n";

const std::string kVtk5 =
    "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 12 float\n9 9 9\n0 0 0 1 0 0 1 1 0 0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "2 0.5 0\n2 0.5 1\n0.5 0.5 2\nCELLS 6 26\nOFFSETS vtktypeint64\n0 8 14 19 23 26\n"
    "CONNECTIVITY vtktypeint64\n1 2 4 3 5 6 8 7\n2 9 3 6 10 7\n5 6 7 8 11\n6 10 7 11\n1 2 3\n"
    "CELL_TYPES 5\n11 13 14 10 5\n";

const std::string kGmsh =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"all $Nodes\"\n"
    "$EndPhysicalNames\n$Nodes\n2 12 1 99\n2 1 1 2\n99\n1\n9 9 9 0.5 0.5\n0 0 0 0 0\n"
    "3 1 0 10\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "2 0.5 0\n2 0.5 1\n0.5 0.5 2\n$EndNodes\n"
    "$Elements\n5 5 1 5\n2 1 2 1\n1 1 2 3\n3 1 5 1\n2 1 2 3 4 5 6 7 8\n3 1 6 1\n3 2 9 3 6 10 7\n"
    "3 1 7 1\n4 5 6 7 8 11\n3 1 4 1\n5 6 10 7 11\n$EndElements\n";

struct Sample {
  const char* name;
  Parse parse;
  const std::string& text;
};
const std::vector<Sample> kSamples = {{"medit", parse_medit, kMedit},
                                      {"vtk", parse_vtk_legacy, kVtk},
                                      {"vtk 5.1", parse_vtk_legacy, kVtk5},
                                      {"gmsh", parse_gmsh, kGmsh}};

std::string complaint(Parse parse, const std::string& text) {
  try {
    (void)parse("m", text);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(VolumeMeshes, of_all_formats_are_one_lattice) {
  const RawLattice medit = parse_medit("m", kMedit);
  for (const Sample& sample : kSamples) {
    const RawLattice raw = sample.parse("m", sample.text);
    EXPECT_TRUE(validate(raw.polyhedra, raw.rest).empty()) << sample.name;
    EXPECT_EQ(raw.rest.size(), 11u) << sample.name;
    const CellMesh mesh{raw.polyhedra, raw.rest};
    EXPECT_EQ(test::shape_by_place(mesh), test::shape_by_place({medit.polyhedra, medit.rest}))
        << sample.name;
    // 1 + 1/2 + 1/3 + 1/6 · |(1, 0.5, 0) × (0, 1, 0) · (-0.5, 0.5, 1)|
    EXPECT_NEAR(test::volume_of(mesh), 1 + 0.5 + 1.0 / 3 + 1.0 / 6, 1e-15) << sample.name;
    EXPECT_EQ(CellComplex(raw.polyhedra).n_faces(), 6u + 4 + 4 + 2) << sample.name;
    EXPECT_FALSE(raw.sharp_edges || raw.sharp_vertices) << sample.name;
  }
}

TEST(VolumeMeshes, cut_off_at_any_byte_are_an_error_or_a_valid_shorter_mesh) {
  for (const Sample& sample : kSamples) {
    std::size_t n_read = 0;
    for (std::size_t size = 0; size < sample.text.size(); ++size) {
      try {
        const RawLattice raw = sample.parse("m", sample.text.substr(0, size));
        ++n_read;
        for (const Defect& defect : validate(raw.polyhedra, raw.rest)) {
          EXPECT_TRUE(defect.kind == DefectKind::IntersectingCells ||
                      defect.kind == DefectKind::VertexInsideFace)
              << sample.name << " " << size << ": " << defect.message;
        }
      } catch (const FileError&) {
        continue;
      }
    }
    EXPECT_LT(n_read, sample.text.size() / 4) << sample.name;
  }
}

TEST(VolumeMeshes, are_not_believed_when_they_announce_too_much) {
  // Each would need terabytes if counts were trusted.
  const std::string huge = "999999999999";
  EXPECT_NE(complaint(parse_medit, with(kMedit, "Vertices\n12", "Vertices\n" + huge)), "");
  EXPECT_NE(complaint(parse_medit, with(kMedit, "Hexahedra\n1", "Hexahedra\n" + huge)), "");
  EXPECT_NE(complaint(parse_vtk_legacy, with(kVtk, "POINTS 12", "POINTS " + huge)), "");
  EXPECT_NE(complaint(parse_vtk_legacy, with(kVtk, "CELLS 5", "CELLS " + huge)), "");
  EXPECT_NE(complaint(parse_vtk_legacy, with(kVtk5, "CELLS 6 26", "CELLS 6 " + huge)), "");
  EXPECT_NE(complaint(parse_vtk_legacy, with(kVtk5, "CELLS 6", "CELLS " + huge)), "");
  EXPECT_NE(complaint(parse_gmsh, with(kGmsh, "3 1 0 10", "3 1 0 " + huge)), "");
  EXPECT_NE(complaint(parse_gmsh, with(kGmsh, "3 1 5 1", "3 1 5 " + huge)), "");
  for (const Sample& sample : kSamples) {
    for (std::size_t at = 0; at < sample.text.size(); ++at) {
      std::string text = sample.text;
      text[at] = text[at] == '-' ? '9' : '-';  // whatever this breaks, nothing worse than an error
      (void)complaint(sample.parse, text);
    }
  }
}

TEST(VolumeMeshes, name_what_they_refuse) {
  EXPECT_EQ(complaint(parse_medit, "MFEM mesh v1.0\n"),
            "m:1: is no MEDIT mesh: needs the header \"MeshVersionFormatted\"");
  EXPECT_EQ(complaint(parse_medit, with(kMedit, "Dimension\n3", "Dimension\n2")),
            "m:4: has 2 dimensions, a volume mesh has 3");
  EXPECT_EQ(complaint(parse_medit, with(kMedit, "2 3 4 5 6 7 8 9 3", "2 3 4 5 6 7 8 13 3")),
            "m:28: vertex 13 does not exist, there are 12 (1…12)");
  EXPECT_EQ(complaint(parse_medit, with(kMedit, "2 3 4 5 6 7 8 9 3", "0 3 4 5 6 7 8 9 3")),
            "m:28: vertex 0 does not exist, there are 12 (1…12)");
  EXPECT_EQ(complaint(parse_medit, "MeshVersionFormatted 1 Dimension 3 End"),
            "m:1: has no cells: no Tetrahedra, Pyramids, Prisms or Hexahedra");
  EXPECT_EQ(complaint(parse_vtk_legacy, with(kVtk, "ASCII", "BINARY")),
            "m:3: is binary; only ASCII files are read");
  EXPECT_EQ(complaint(parse_vtk_legacy, with(kVtk, "UNSTRUCTURED_GRID", "POLYDATA")),
            "m:4: expected UNSTRUCTURED_GRID, not 'POLYDATA'");
  EXPECT_EQ(complaint(parse_vtk_legacy, with(kVtk, "12 13 14", "25 13 14")),
            "m:23: cell 0 is of type 25; only linear tetrahedra, hexahedra, wedges and pyramids "
            "are read");
  EXPECT_EQ(complaint(parse_vtk_legacy, with(kVtk, "12 13 14", "12 14 14")),
            "m:23: cell 1 of type 14 has 6 corners, needs 5");
  EXPECT_EQ(complaint(parse_vtk_legacy, with(kVtk, "4 6 10 7 11", "4 6 10 7 12")),
            "m:20: point 12 does not exist, there are 12");
  EXPECT_EQ(complaint(parse_vtk_legacy, with(kVtk5, "0 8 14", "0 15 14")),
            "m:17: offset 2 is 14, offsets must rise from 0 to 26");
  EXPECT_EQ(complaint(parse_gmsh, with(kGmsh, "4.1 0 8", "2.2 0 8")),
            "m:2: is of version '2.2'; only 4.1 is read (gmsh -save -format msh41 converts)");
  EXPECT_EQ(complaint(parse_gmsh, with(kGmsh, "4.1 0 8", "4.1 1 8")),
            "m:2: is binary; only text files are read");
  EXPECT_EQ(complaint(parse_gmsh, with(kGmsh, "3 1 4 1\n", "3 1 11 1\n")),
            "m:47: has elements of type 11; only linear tetrahedra, hexahedra, prisms and pyramids "
            "are read");
  EXPECT_EQ(complaint(parse_gmsh, with(kGmsh, "5 6 10 7 11", "5 6 10 7 98")),
            "m:48: node 98 does not exist");
}

}  // namespace
}  // namespace espalier
