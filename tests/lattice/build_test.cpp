#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <set>

#include "lattice/build/extrude.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/osd/refine_surface.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/subdivision/refine.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/validate.h"
#include "tests/lattice/mesh_shape.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

using test::volume_of;
using Rows = CompressedRows<std::int32_t>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What a builder says when it refuses its parameters; "" if it does not.
template <class Build>
std::string complaint(const Build& build) {
  try {
    (void)build();
    return "";
  } catch (const ParameterError& error) {
    return error.what();
  }
}

/// Vertices of every cell and of every face, faces sorted.
std::pair<std::vector<std::set<VertexId>>, std::set<std::set<VertexId>>> shape_of(
    const CellComplex& complex) {
  std::vector<std::set<VertexId>> cells;
  std::set<std::set<VertexId>> faces;
  for (const CellId cell : complex.cells()) {
    const auto vertices = complex.vertices(cell);
    cells.emplace_back(vertices.begin(), vertices.end());
  }
  for (const FaceId face : complex.faces()) {
    const auto vertices = complex.vertices(face);
    faces.emplace(vertices.begin(), vertices.end());
  }
  return {cells, faces};
}

TEST(Extrude, puts_vertex_i_of_step_l_at_i_plus_l_n) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const CellMesh mesh = extrude(points, {{0, 1, 2}}, {1, 2, 8}, 4);
  ASSERT_EQ(mesh.points.size(), 15u);
  for (std::size_t i = 0; i < 15; ++i) {
    const auto layer = static_cast<double>(i / 3);
    EXPECT_EQ(mesh.points[i], points[i % 3] + glm::dvec3(1, 2, 8) * (layer / 4));
  }
  const CellComplex complex(mesh.cells);
  EXPECT_EQ(complex.n_cells(), 4u);
  EXPECT_EQ(complex.n_faces(), 5u + 12);
  EXPECT_EQ(complex.n_edges(), 15u + 12);
  const auto top = complex.vertices(CellId{3});
  EXPECT_EQ(top.front().value, 9);
  EXPECT_EQ(top.back().value, 14);
}

TEST(Extrude, leaves_out_points_that_no_face_uses) {
  const std::vector<glm::dvec3> points = {{9, 9, 9}, {0, 0, 0}, {7, 7, 7}, {1, 0, 0}, {0, 1, 0}};
  const CellMesh mesh = extrude(points, {{4, 1, 3}}, {0, 0, 1}, 1);
  const std::vector<glm::dvec3> expected = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                            {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  EXPECT_EQ(mesh.points, expected);
  EXPECT_EQ(volume_of(mesh), 0.5);
}

TEST(Extrude, makes_positive_cells_in_either_direction_and_from_any_windings) {
  test::Section section = test::pentagon_section();
  double expected = 0;
  for (const double z : {2.0, -2.0}) {
    for (std::size_t face = 0; face < section.faces.n_rows(); ++face) {
      const auto loop = section.faces[face];
      std::reverse(loop.begin(), loop.end());
      const CellMesh mesh = extrude(section.points, section.faces, {0.25, 0.5, z}, 3);
      EXPECT_NO_THROW((void)CellComplex(mesh.cells));
      // A regular pentagon of radius 2, sheared.
      expected = 2.5 * 4 * std::sin(2 * std::numbers::pi / 5) * 2;
      EXPECT_NEAR(volume_of(mesh), expected, 1e-13 * expected);
    }
  }
}

TEST(Extrude, of_a_grid_of_squares_is_the_box_grid) {
  const SubdivisionLattice extruded = test::prism(test::grid_section(3, 2), 4);
  const CellMesh box = make_box({3, 2, 4}, {0, 0, 0}, {3, 2, 4});
  EXPECT_EQ(extruded.rest, box.points);
  const CellComplex complex(box.cells);
  EXPECT_EQ(shape_of(*extruded.complex), shape_of(complex));
  ASSERT_EQ(extruded.complex->n_edges(), complex.n_edges());
  for (const EdgeId edge : complex.edges()) {
    EXPECT_EQ(extruded.complex->vertices(edge), complex.vertices(edge));
    EXPECT_EQ(extruded.complex->n_cells(edge), complex.n_cells(edge));
  }
}

TEST(Extrude, names_what_it_refuses) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Rows triangle = {{0, 1, 2}};
  const auto with = [&](const Rows& faces, const glm::dvec3& direction, int layers) {
    return complaint([&] { return extrude(points, faces, direction, layers); });
  };
  EXPECT_EQ(with(triangle, {0, 0, 1}, 10000), "");
  EXPECT_EQ(with({}, {0, 0, 1}, 1), "extrude: the mesh has no faces");
  EXPECT_EQ(with(triangle, {0, 0, 1}, 0), "extrude: layers is 0, must be 1 to 10000");
  EXPECT_EQ(with(triangle, {0, 0, 1}, 10001), "extrude: layers is 10001, must be 1 to 10000");
  for (const glm::dvec3& bad :
       {glm::dvec3(0), glm::dvec3(kNaN, 0, 1), glm::dvec3(0, kInfinity, 0)}) {
    EXPECT_EQ(with(triangle, bad, 1), "extrude: the direction must be finite and not zero");
  }
  EXPECT_EQ(with({{0, 1, 2}, {0, 1}}, {0, 0, 1}, 1),
            "extrude: face 1 has 2 points, needs three or more");
  EXPECT_EQ(with({{0, 1, 2}, {}}, {0, 0, 1}, 1),
            "extrude: face 1 has 0 points, needs three or more");
  EXPECT_EQ(with({{0, 1, 3}}, {0, 0, 1}, 1),
            "extrude: face 0: point 3 does not exist, there are 3");
  EXPECT_EQ(with({{0, -1, 2}}, {0, 0, 1}, 1),
            "extrude: face 0: point -1 does not exist, there are 3");
  EXPECT_EQ(with({{0, 1, 2}, {2, 1, 0}}, {0, 0, 1}, 1),
            "extrude: the mesh is closed, only an open surface can be extruded: draw the section "
            "of the lattice, or cut the mesh open");
  EXPECT_EQ(with(Rows::uniform(30000, std::vector<std::int32_t>(30000, 0)), {0, 0, 1}, 10000),
            "extrude: more than 200 million faces; use fewer layers");
}

/// The unit cube's boundary, faces counter-clockwise seen from outside.
struct CubeSurface {
  std::vector<glm::dvec3> points = make_box({1, 1, 1}, glm::dvec3(0), glm::dvec3(1)).points;
  Rows faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
};

std::string defect_of(const CellMesh& mesh) {
  const std::vector<Defect> defects = validate(mesh.cells, mesh.points);
  return defects.empty() ? "" : defects.front().message;
}

TEST(Thicken, of_a_cube_is_a_shell_of_even_thickness_to_either_side) {
  const CubeSurface cube;
  for (const double thickness : {0.5, -0.25}) {
    const CellMesh shell = thicken(cube.points, cube.faces, thickness, 2);
    EXPECT_EQ(defect_of(shell), "");
    ASSERT_EQ(shell.cells.cells.n_rows(), 12u);
    EXPECT_NEAR(volume_of(shell), std::abs(std::pow(1 + 2 * thickness, 3) - 1), 1e-14);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(shell.points[i], cube.points[i]);
      const glm::dvec3 out = cube.points[i] * 2.0 - 1.0;
      EXPECT_LT(glm::distance(shell.points[i + 8], cube.points[i] + out * thickness / 2.0), 1e-15);
      EXPECT_LT(glm::distance(shell.points[i + 16], cube.points[i] + out * thickness), 1e-15);
    }
  }
}

TEST(Thicken, of_a_flat_mesh_is_the_extruded_mesh_but_for_points_no_face_uses) {
  test::Section section = test::flower_section(5);
  section.points.insert(section.points.begin(), glm::dvec3(7));
  for (std::size_t face = 0; face < section.faces.n_rows(); ++face) {
    for (std::int32_t& point : section.faces[face]) {
      ++point;
    }
  }
  const CellMesh thick = thicken(section.points, section.faces, 0.75, 3);
  const CellMesh extruded = extrude(section.points, section.faces, {0, 0, 0.75}, 3);
  EXPECT_EQ(thick.cells.cells.values().size(), extruded.cells.cells.values().size());
  ASSERT_EQ(thick.points.size(), extruded.points.size());
  for (std::size_t i = 0; i < thick.points.size(); ++i) {
    EXPECT_LT(glm::distance(thick.points[i], extruded.points[i]), 1e-15);
  }
}

TEST(Thicken, leaves_no_face_behind_at_a_point_with_many_faces_on_one_side) {
  // A fan of 12 slivers that all look up, and one wall under them: the mean of the normals,
  // weighted by angle, points away from the wall.
  std::vector<glm::dvec3> points = {{0, 0, 0}};
  Rows faces;
  for (int i = 0; i <= 12; ++i) {
    const double angle = std::numbers::pi * i / 12;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
    if (i > 0) {
      faces.push_back(std::array{0, i, i + 1});
    }
  }
  points.emplace_back(0.3, 0.8, -1);
  faces.push_back(std::array{0, 14, 1});
  const CellMesh thick = thicken(points, faces, 0.01, 1);
  EXPECT_EQ(defect_of(thick), "");
  const glm::dvec3 offset = thick.points[15] - thick.points[0];
  const glm::dvec3 wall = glm::normalize(glm::cross(points[14], points[1]));
  EXPECT_GT(glm::dot(offset, wall), 0);
  EXPECT_GT(offset.z, 0);
}

TEST(Thicken, names_what_it_refuses) {
  const CubeSurface cube;
  EXPECT_EQ(complaint([&] { return thicken(cube.points, cube.faces, 0, 1); }),
            "thicken: the thickness must be finite and not zero");
  EXPECT_NE(complaint([&] { return thicken(cube.points, cube.faces, kNaN, 1); }), "");
  EXPECT_EQ(complaint([&] { return thicken(cube.points, {}, 1, 1); }),
            "thicken: the mesh has no faces");
  EXPECT_THROW((void)thicken(cube.points, {{0, 1, 3}, {0, 1, 5}}, 1, 1), LatticeError);
  // A sheet folded flat: its normals cancel along the fold.
  EXPECT_THROW((void)thicken(cube.points, {{0, 1, 3}, {1, 0, 2}, {1, 2, 3}, {0, 3, 2}}, 1, 1),
               LatticeError);
}

TEST(Solid, of_a_closed_cage_is_one_cell_whose_boundary_is_its_catmull_clark_surface) {
  CubeSurface cube;
  cube.points[7] = {1.25, 1.5, 1.125};
  cube.points.push_back(glm::dvec3(9));  // used by no face
  const CellMesh mesh = solid(cube.points, cube.faces);
  EXPECT_EQ(defect_of(mesh), "");
  ASSERT_EQ(mesh.cells.cells.n_rows(), 1u);
  ASSERT_EQ(mesh.points.size(), 8u);
  SubdivisionLattice lattice = test::lattice_from(mesh);
  lattice.sharpness = smooth_sharpness(*lattice.complex);
  const SubdivisionLattice fine = refined(lattice, 2);
  std::set<std::array<double, 3>> boundary;
  for (const VertexId vertex : fine.complex->vertices()) {
    if (fine.complex->is_boundary(vertex)) {
      const glm::dvec3 p = fine.rest[vertex.index()];
      boundary.insert({std::round(p.x * 1e12), std::round(p.y * 1e12), std::round(p.z * 1e12)});
    }
  }
  const std::vector<glm::dvec3> points(cube.points.begin(), cube.points.begin() + 8);
  const osd::RefinedSurface surface = osd::refine_surface(points, cube.faces, 2);
  EXPECT_EQ(boundary.size(), surface.points.size());
  for (const glm::dvec3& p : surface.points) {
    EXPECT_TRUE(
        boundary.contains({std::round(p.x * 1e12), std::round(p.y * 1e12), std::round(p.z * 1e12)}))
        << p.x << " " << p.y << " " << p.z;
  }
}

TEST(Solid, refuses_more_faces_than_one_cell_may_have_and_names_what_to_do) {
  const CubeSurface cube;
  Rows faces;
  for (std::size_t i = 0; i <= kMostSolidFaces; ++i) {
    faces.push_back(std::array{0, 1, 3});
  }
  try {
    (void)solid(cube.points, faces);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_EQ(std::string(error.what()),
              "solid: the mesh has 501 faces, one cell may have at most 500: draw a coarser cage, "
              "or make many cells: --wrap N round the whole mesh, --thicken t along its surface");
  }
}

TEST(FromMeshes, name_a_face_that_uses_a_point_twice) {
  const CubeSurface cube;
  const Rows faces = {{0, 1, 3}, {4, 5, 5, 7}};
  const std::string expected =
      "face 1 has point 5 twice; the points of a face must differ: remove the face, or make two of "
      "it";
  const auto says = [&](const auto& make) -> std::string {
    try {
      (void)make();
    } catch (const LatticeError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(says([&] { return solid(cube.points, faces); }), "solid: " + expected);
  EXPECT_EQ(says([&] { return thicken(cube.points, faces, 1, 1); }), "thicken: " + expected);
  EXPECT_EQ(says([&] {
              return extrude(cube.points, faces, {0, 0, 1}, 1);
            }),
            "extrude: " + expected);
}

TEST(Solid, names_an_edge_where_the_cage_is_open_or_has_more_than_two_faces) {
  const CubeSurface cube;
  const auto says = [&](const Rows& faces) -> std::string {
    try {
      (void)solid(cube.points, faces);
    } catch (const LatticeError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(says({{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}}),
            "solid: the mesh is not closed: edge 4-5 has 1 face, needs two");
  EXPECT_EQ(says({{0, 1, 3}, {0, 1, 5}, {0, 1, 4}}),
            "solid: the mesh is not closed: edge 0-1 has 3 faces, needs two");
}

TEST(MakeBox, fills_the_box_with_u_fastest) {
  const CellMesh mesh = make_box({2, 3, 4}, {-1, 0, 10}, {1, 6, 14});
  ASSERT_EQ(mesh.points.size(), 60u);
  for (int k = 0; k <= 4; ++k) {
    for (int j = 0; j <= 3; ++j) {
      for (int i = 0; i <= 2; ++i) {
        EXPECT_EQ(mesh.points[static_cast<std::size_t>(i + 3 * (j + 4 * k))],
                  glm::dvec3(i - 1, 2 * j, 10 + k));
      }
    }
  }
  const CellComplex complex(mesh.cells);
  ASSERT_EQ(complex.n_cells(), 24u);
  EXPECT_EQ(complex.n_faces(), 3u * 12 + 4u * 8 + 5u * 6);
  // Cells too: cell 23 is the last of all axes.
  EXPECT_EQ(complex.vertices(CellId{1}).front().value, 1);
  EXPECT_EQ(complex.vertices(CellId{2}).front().value, 3);
  EXPECT_EQ(complex.vertices(CellId{23}).back().value, 59);
  EXPECT_DOUBLE_EQ(volume_of(mesh), 2.0 * 6 * 4);
}

TEST(MakeBox, reaches_its_corners_exactly) {
  const glm::dvec3 min(-1e17, 1e-9, 0.1);
  const glm::dvec3 max(1e-3, 0.3, 1e18);
  const CellMesh mesh = make_box({7, 3, 11}, min, max);
  EXPECT_EQ(mesh.points.front(), min);
  EXPECT_EQ(mesh.points.back(), max);
}

TEST(MakeBox, names_what_it_refuses) {
  const auto box = [](const std::array<int, 3>& cells, const glm::dvec3& min,
                      const glm::dvec3& max) {
    return complaint([&] { return make_box(cells, min, max); });
  };
  EXPECT_EQ(box({1, 0, 1}, {0, 0, 0}, {1, 1, 1}), "box: 0 cells along y, must be 1 or more");
  EXPECT_EQ(box({1, 1, -3}, {0, 0, 0}, {1, 1, 1}), "box: -3 cells along z, must be 1 or more");
  EXPECT_EQ(box({1, 1, 1}, {0, 0, 0}, {0, 1, 1}),
            "box: min must be below max along x, and both finite");
  EXPECT_EQ(box({1, 1, 1}, {0, 0, 0}, {1, 1, -1}),
            "box: min must be below max along z, and both finite");
  EXPECT_NE(box({1, 1, 1}, {0, 0, 0}, {1, 1, kInfinity}), "");
  EXPECT_NE(box({1, 1, 1}, {0, kNaN, 0}, {1, 1, 1}), "");
  EXPECT_EQ(box({5000, 5000, 1}, {0, 0, 0}, {1, 1, 1}), "box: more than 20 million cells");
  constexpr int kMost = std::numeric_limits<int>::max();
  EXPECT_EQ(box({kMost, kMost, kMost}, {0, 0, 0}, {1, 1, 1}), "box: more than 20 million cells");
}

/// The smallest distance from the axis of the side of the frozen volume, away from its ends.
double radius_of_side(const CellMesh& mesh, const glm::dvec3& from, const glm::dvec3& axis,
                      int levels) {
  const Volume volume = freeze_uniform(test::lattice_from(mesh), levels);
  double smallest = kInfinity;
  for (std::size_t patch = 0; patch < volume.n_patches(); ++patch) {
    for (std::size_t i = 0; i < 8; ++i) {
      const auto point = static_cast<std::size_t>(volume.block(patch)[i]);
      const glm::dvec3 at = volume.rest_points()[point] - from;
      const double along = glm::dot(at, axis) / glm::dot(axis, axis);
      if (along < 1e-9 || along > 1 - 1e-9) {
        continue;
      }
      for (int face = 0; face < 6; ++face) {
        const bool is_on_face = static_cast<int>(i >> (face / 2) & 1) == face % 2;
        if (is_on_face && volume.patch(patch).is_on_boundary(face)) {
          smallest = std::min(smallest, glm::distance(at, axis * along));
        }
      }
    }
  }
  return smallest;
}

TEST(MakeCylinder, has_its_side_at_the_radius) {
  for (const int sectors : {3, 4, 5, 8}) {
    CylinderOptions options;
    options.from = {1, 2, 3};
    options.to = {3, -1, 4};
    options.radius = 0.75;
    options.sectors = sectors;
    options.layers = 1;
    const CellMesh mesh = make_cylinder(options);
    // Refined points approach the limit by a factor of 4 a level.
    const double coarse = radius_of_side(mesh, options.from, options.to - options.from, 3);
    const double fine = radius_of_side(mesh, options.from, options.to - options.from, 4);
    EXPECT_NEAR(fine + (fine - coarse) / 3, 0.75, 2e-4) << sectors;
    EXPECT_GT(std::abs(coarse - 0.75), 2 * std::abs(fine - 0.75)) << sectors;
  }
}

TEST(MakeCylinder, puts_each_step_s_centre_before_its_ring) {
  CylinderOptions options;
  options.from = {0, 0, 1};
  options.to = {0, 0, 5};
  options.radius = 2;
  options.end_radius = 6;
  options.sectors = 6;
  options.layers = 4;
  const CellMesh mesh = make_cylinder(options);
  ASSERT_EQ(mesh.points.size(), 35u);
  // The ring of the closed cubic B-spline through a hexagon of radius 1 comes within (4 + 1) / 6 of
  // the centre at its knots, and (46 √3/2 + 0) / 48 = 0.8299 half-way between.
  const double ring = 48 / (23 * std::sqrt(3.0));
  for (std::size_t step = 0; step < 5; ++step) {
    const glm::dvec3 centre = mesh.points[7 * step];
    EXPECT_EQ(centre, glm::dvec3(0, 0, 1 + static_cast<double>(step)));
    for (std::size_t i = 1; i <= 6; ++i) {
      const glm::dvec3 arm = mesh.points[7 * step + i] - centre;
      const glm::dvec3 next = mesh.points[7 * step + i % 6 + 1] - centre;
      const double radius = (2 + static_cast<double>(step)) * ring;
      EXPECT_EQ(arm.z, 0);
      EXPECT_NEAR(glm::length(arm), radius, 1e-14 * radius);
      // Each is one sixth of a turn after the one before, counter-clockwise about the axis.
      EXPECT_NEAR(glm::dot(arm, next), radius * radius / 2, 1e-13);
      EXPECT_GT(glm::cross(arm, next).z, 0);
    }
  }
  const CellComplex complex(mesh.cells);
  EXPECT_EQ(complex.n_cells(), 24u);
  for (const CellId cell : complex.cells()) {
    EXPECT_EQ(complex.vertices(cell).size(), 6u);
    EXPECT_EQ(complex.vertices(cell).front().value % 7, 0);
  }
}

TEST(MakeCylinder, is_round_about_any_axis) {
  for (const glm::dvec3& to : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -2), glm::dvec3(1, 1, 1),
                               glm::dvec3(0, 1e-9, 0), glm::dvec3(0, 1e12, 1)}) {
    CylinderOptions options;
    options.to = to;
    options.layers = 1;
    const CellMesh mesh = make_cylinder(options);
    const double ring = glm::length(mesh.points[1]);
    EXPECT_GT(ring, 0.5);
    EXPECT_LT(ring, 0.6);
    for (std::size_t i = 1; i <= 8; ++i) {
      EXPECT_NEAR(glm::length(mesh.points[i]), ring, 1e-14);
      EXPECT_NEAR(glm::dot(mesh.points[i], glm::normalize(to)), 0, 1e-14);
    }
    EXPECT_GT(volume_of(mesh), 0);
  }
}

TEST(MakeCylinder, names_what_it_refuses) {
  const auto with = [](const auto& change) {
    CylinderOptions options;
    change(options);
    return complaint([&] { return make_cylinder(options); });
  };
  const std::string ends = "cylinder: 'from' and 'to' must be finite and differ";
  EXPECT_EQ(with([](CylinderOptions& o) { o.to = o.from; }), ends);
  EXPECT_EQ(with([](CylinderOptions& o) { o.to.x = kNaN; }), ends);
  EXPECT_EQ(with([](CylinderOptions& o) { o.from.z = kInfinity; }), ends);
  for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
    EXPECT_EQ(with([&](CylinderOptions& o) { o.radius = bad; }),
              "cylinder: the radius must be positive");
  }
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    EXPECT_EQ(with([&](CylinderOptions& o) { o.end_radius = bad; }),
              "cylinder: the end radius must be positive, or 0 for the same");
  }
  EXPECT_EQ(with([](CylinderOptions& o) { o.sectors = 2; }),
            "cylinder: sectors is 2, must be 3 to 1000");
  EXPECT_EQ(with([](CylinderOptions& o) { o.sectors = 1001; }),
            "cylinder: sectors is 1001, must be 3 to 1000");
  EXPECT_EQ(with([](CylinderOptions& o) { o.layers = 0; }),
            "cylinder: layers is 0, must be 1 to 10000");
  EXPECT_EQ(with([](CylinderOptions& o) { o.layers = 10001; }),
            "cylinder: layers is 10001, must be 1 to 10000");
}

}  // namespace
}  // namespace espalier
