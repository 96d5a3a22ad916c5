#include "lattice/topology/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "tests/lattice/shapes.h"

namespace espalier {
namespace {

using shapes::Shape;

std::vector<Defect> defects_of(const Shape& shape) {
  return validate(shape.polyhedra, shape.points);
}

bool names(const std::vector<Defect>& defects, DefectKind kind, const std::string& fragment) {
  return std::any_of(defects.begin(), defects.end(), [&](const Defect& defect) {
    return defect.kind == kind && defect.message.find(fragment) != std::string::npos;
  });
}

std::string report(const std::vector<Defect>& defects) {
  std::string text;
  for (const Defect& defect : defects) {
    text += std::string(name_of(defect.kind)) + ": " + defect.message + "\n";
  }
  return text;
}

#define EXPECT_DEFECT(shape, kind, fragment)                                \
  do {                                                                      \
    const std::vector<Defect> found = defects_of(shape);                    \
    EXPECT_TRUE(names(found, DefectKind::kind, fragment)) << report(found); \
  } while (false)

Shape scaled(Shape shape, double factor) {
  for (glm::dvec3& point : shape.points) {
    point *= factor;
  }
  return shape;
}

Shape rotated(Shape shape) {
  for (glm::dvec3& p : shape.points) {
    p = {0.36 * p.x + 0.48 * p.y - 0.8 * p.z, -0.8 * p.x + 0.6 * p.y,
         0.48 * p.x + 0.64 * p.y + 0.6 * p.z};
  }
  return shape;
}

Shape shifted_cubes(glm::dvec3 offset) {
  return shapes::together(shapes::cube(), shapes::cube(), offset);
}

TEST(Validate, finds_nothing_in_valid_families_at_every_scale_and_attitude) {
  const std::vector<std::pair<const char*, Shape>> families = {
      {"cube", shapes::cube()},
      {"grid", shapes::box_grid(3, 2, 4)},
      {"warped grid", shapes::warped_grid(4, 4, 4)},
      {"tetrahedron", shapes::tetrahedron()},
      {"pyramid on a cube", shapes::pyramid_on_cube()},
      {"pentagonal prism", shapes::regular_prism(5)},
      {"prism with 30 sides", shapes::regular_prism(30)},
      {"wedge cylinder", shapes::wedge_cylinder(6)},
      {"three wedges", shapes::wedge_cylinder(3)},
      {"cubes sharing an edge", shapes::columns_sharing_a_line(1)},
      {"columns sharing a line", shapes::columns_sharing_a_line(3)},
      {"cubes sharing a vertex", shapes::cubes_sharing_a_vertex()},
      {"cubes with coinciding faces", shifted_cubes({1, 0, 0})},
      {"warped grids with coinciding faces",
       shapes::together(shapes::warped_grid(2, 2, 2), shapes::warped_grid(2, 2, 2), {9, 9, 9})},
      {"cubes with coinciding edges", shifted_cubes({1, 1, 0})},
      {"cubes with coinciding vertices", shifted_cubes({1, 1, 1})},
      {"concave cell with a box in its notch", shapes::concave_cell_with_box_in_notch()}};
  for (const auto& [name, shape] : families) {
    for (const double scale : {1.0, 1e-8, 1e8, 1e16}) {
      for (const Shape& one : {scaled(shape, scale), scaled(rotated(shape), scale)}) {
        const std::vector<Defect> found = defects_of(one);
        EXPECT_TRUE(found.empty()) << name << " × " << scale << "\n" << report(found);
      }
    }
  }
}

TEST(Validate, accepts_cells_ten_thousand_times_flatter_than_wide) {
  Shape shape = shapes::warped_grid(3, 3, 1);
  for (glm::dvec3& point : shape.points) {
    point.z *= 1e-4;
  }
  EXPECT_TRUE(defects_of(shape).empty()) << report(defects_of(shape));
}

TEST(Validate, names_structural_defects) {
  EXPECT_DEFECT((Shape{}), NoCells, "no cells");

  Shape shape = shapes::cube();
  shape.polyhedra.faces[2][1] = 8;
  EXPECT_DEFECT(shape, IndexOutOfRange, "face 2: vertex 8 does not exist, there are 8");

  shape = shapes::cube();
  shape.polyhedra.cells[0][3] = 12;
  EXPECT_DEFECT(shape, IndexOutOfRange, "cell 0: face 6 does not exist, there are 6");

  shape = shapes::cube();
  shape.polyhedra.faces.push_back(std::vector<std::int32_t>{0, 1});
  EXPECT_DEFECT(shape, FaceTooSmall, "face 6: has 2 vertices");

  shape = shapes::cube();
  shape.polyhedra.faces[1][0] = shape.polyhedra.faces[1][2];
  EXPECT_DEFECT(shape, FaceRepeatsVertex, "face 1: contains vertex 7 twice");

  shape = shapes::cube();
  shape.polyhedra.faces.push_back(std::vector<std::int32_t>{1, 3, 2, 0});
  EXPECT_DEFECT(shape, DuplicateFace, "face 6: has the vertices of face 4");

  shape = shapes::cube();
  shape.polyhedra.faces.push_back(std::vector<std::int32_t>{0, 1, 7});
  EXPECT_DEFECT(shape, UnusedFace, "face 6: belongs to no cell");

  shape = shapes::cube();
  shape.points.emplace_back(2, 2, 2);
  ++shape.polyhedra.n_vertices;
  EXPECT_DEFECT(shape, UnusedVertex, "vertex 8: belongs to no face");
}

TEST(Validate, names_all_else_that_is_wrong_beside_an_unused_vertex) {
  Shape overlapping = shifted_cubes({0.5, 0.25, 0.125});
  overlapping.points.emplace_back(5, 5, 5);
  ++overlapping.polyhedra.n_vertices;
  EXPECT_EQ(report(defects_of(overlapping)),
            "unused-vertex: vertex 16: belongs to no face\n"
            "intersecting-cells: cell 1: intersects cell 0\n");

  Shape open = shapes::cube();
  open.polyhedra.cells = {{0, 2, 4, 6, 8}};
  open.points.emplace_back(2, 2, 2);
  ++open.polyhedra.n_vertices;
  EXPECT_DEFECT(open, CellNotClosed, "cell 0: is not closed");
  EXPECT_DEFECT(open, UnusedVertex, "vertex 8: belongs to no face");
}

TEST(Validate, names_defects_of_shells) {
  Shape shape = shapes::cube();
  shape.polyhedra.cells = {{0, 2, 4}};
  EXPECT_DEFECT(shape, CellTooSmall, "cell 0: has 3 faces");

  shape = shapes::cube();
  shape.polyhedra.cells = {{0, 2, 4, 6, 8, 10, 10}};
  EXPECT_DEFECT(shape, CellRepeatsFace, "cell 0: contains face 5 twice");

  shape = shapes::cube();
  shape.polyhedra.cells = {{0, 2, 4, 6, 8}};
  EXPECT_DEFECT(shape, CellNotClosed, "cell 0: is not closed");

  shape = shapes::cube();
  shape.polyhedra.cells = {{0, 2, 4, 6, 8, 11}};
  EXPECT_DEFECT(shape, CellNotSphere, "cell 0: its faces cannot be oriented");

  shape = shifted_cubes({3, 0, 0});
  shape.polyhedra.cells = {{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22}};
  EXPECT_DEFECT(shape, CellNotSphere, "cell 0: its faces do not form one shell");

  shape = shapes::cube();
  shape.polyhedra.cells = {{0, 2, 4, 6, 8, 10}, {0, 2, 4, 6, 8, 10}, {1, 3, 5, 7, 9, 11}};
  EXPECT_DEFECT(shape, FaceUsedTooOften, "face 0: belongs to 3 cells");

  shape = shapes::cube();
  shape.polyhedra.cells = {{0, 2, 4, 6, 8, 10}, {0, 2, 4, 6, 8, 10}};
  EXPECT_DEFECT(shape, CellsOnOneSide, "face 0: has both of its cells on one side");
}

TEST(Validate, names_edges_with_too_few_faces) {
  // Two cells that share two neighbouring faces: the edge 0-1 between those is inside.
  const Shape shape =
      shapes::from_loops({{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 5, 0}, {0, -5, 0}},
                         {{{0, 1, 2}, {0, 1, 3}, {0, 2, 4}, {1, 2, 4}, {0, 3, 4}, {1, 3, 4}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 2, 5}, {1, 2, 5}, {0, 3, 5}, {1, 3, 5}}});
  EXPECT_DEFECT(shape, TooFewFacesAtEdge, "edge 0-1: is an inner edge with 2 faces");
}

TEST(Validate, names_edges_enclosed_twice) {
  // Three tetrahedra round the edge 0-1, and one more at it.
  Shape shape = shapes::from_loops(
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {5, 5, 0}, {5, 6, 0}},
      {shapes::tetrahedron_loops(0, 1, 2, 3), shapes::tetrahedron_loops(0, 1, 3, 4),
       shapes::tetrahedron_loops(0, 1, 4, 2), shapes::tetrahedron_loops(0, 1, 5, 6)});
  EXPECT_DEFECT(shape, EdgeEnclosedTwice, "edge 0-1: is enclosed by a ring");
}

TEST(Validate, names_coordinates_that_are_no_numbers) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), -1.1e18}) {
    Shape shape = shapes::cube();
    shape.points[5].y = bad;
    EXPECT_DEFECT(shape, NotFinite, "vertex 5: its y is ");
  }
}

TEST(Validate, names_edges_without_length) {
  for (const double scale : {1.0, 1e-8, 1e8}) {
    Shape shape = scaled(shapes::box_grid(2, 1, 1), scale);
    shape.points[2] = shape.points[1];
    EXPECT_DEFECT(shape, ZeroLengthEdge, "edge 1-2: its ends coincide");
  }
}

TEST(Validate, names_cells_that_touch_themselves) {
  Shape shape = shapes::cube();
  shape.points[7] = shape.points[0];
  EXPECT_DEFECT(shape, SelfTouchingCell, "cell 0: touches itself: its vertices 0 and 7");
}

TEST(Validate, names_inverted_and_flat_cells) {
  Shape shape = shapes::box_grid(3, 1, 1);
  std::swap(shape.points[1].x, shape.points[2].x);
  std::swap(shape.points[5].x, shape.points[6].x);
  std::swap(shape.points[9].x, shape.points[10].x);
  std::swap(shape.points[13].x, shape.points[14].x);
  for (const double scale : {1.0, 1e-8, 1e8}) {
    EXPECT_DEFECT(scaled(shape, scale), InvertedCell, "cell 1: is inverted");
  }
  shape = shapes::cube();
  for (glm::dvec3& point : shape.points) {
    point = {point.x + 0.3 * point.z, point.y + 0.2 * point.z, 0};
  }
  EXPECT_DEFECT(rotated(shape), InvertedCell, "cell 0: has no volume");
}

TEST(Validate, names_vertices_inside_edges_and_faces) {
  // A small cube on a large one: a corner inside an edge, one inside the face.
  Shape shape = shifted_cubes({0, 0, 0});
  for (std::size_t i = 8; i < 16; ++i) {
    shape.points[i] = glm::dvec3(0.25, 0, 1) + 0.5 * shapes::cube().points[i - 8];
  }
  for (const double scale : {1.0, 1e-8, 1e8}) {
    for (const Shape& one : {scaled(shape, scale), scaled(rotated(shape), scale)}) {
      EXPECT_DEFECT(one, VertexInsideEdge, "edge 4-5: vertex 8 and 1 more inside it");
      EXPECT_DEFECT(one, VertexInsideFace, "face 5: vertex 10 and 1 more inside it");
      EXPECT_FALSE(names(defects_of(one), DefectKind::IntersectingCells, ""));
    }
  }
}

TEST(Validate, names_cells_that_intersect) {
  const std::vector<std::pair<const char*, glm::dvec3>> offsets = {
      {"a general offset", {0.3, 0.4, 0.5}},
      {"half in every direction", {0.5, 0.5, 0.5}},
      {"half along one axis", {0.5, 0, 0}},
      {"half along two axes", {0.5, 0.5, 0}},
      {"the same place", {0, 0, 0}},
      {"a thousandth deep", {0.999, 0.3, 0.2}},
      {"a thousandth deep, flush", {0.999, 0, 0}}};
  for (const auto& [name, offset] : offsets) {
    for (const double scale : {1.0, 1e-8, 1e8}) {
      const Shape shape = scaled(shifted_cubes(offset), scale);
      for (const Shape& one : {shape, rotated(shape)}) {
        const auto found = defects_of(one);
        EXPECT_TRUE(names(found, DefectKind::IntersectingCells, "cell 1: intersects cell 0"))
            << name << " × " << scale << "\n"
            << report(found);
      }
    }
  }
}

TEST(Validate, names_a_cell_inside_another) {
  Shape small = scaled(shapes::cube(), 0.2);
  EXPECT_DEFECT(shapes::together(shapes::cube(), small, {0.4, 0.5, 0.3}), IntersectingCells,
                "cell 1: intersects cell 0");
  EXPECT_DEFECT(shapes::together(small, shapes::cube(), {-0.4, -0.5, -0.3}), IntersectingCells,
                "cell 1: intersects cell 0");
  // Flush in a corner, and with a face in common.
  EXPECT_DEFECT(shapes::together(shapes::cube(), small, {0, 0, 0}), IntersectingCells,
                "cell 1: intersects cell 0");
  EXPECT_DEFECT(shapes::together(shapes::cube(), small, {0.4, 0.4, 0}), IntersectingCells,
                "cell 1: intersects cell 0");
}

TEST(Validate, names_cells_that_share_a_vertex_and_overlap) {
  Shape shape = shapes::cubes_sharing_a_vertex();
  for (std::size_t i = 8; i < 15; ++i) {
    shape.points[i] = -0.7 * shape.points[i] + glm::dvec3(0.1, 0, -0.05);
  }
  orient(shape.polyhedra, shape.points);
  EXPECT_DEFECT(shape, IntersectingCells, "cell 1: intersects cell 0");
}

TEST(Validate, names_neighbours_pushed_through_their_shared_face) {
  // The far end of cell 1 is pulled back through cell 0, wide round it.
  Shape shape = shapes::box_grid(2, 1, 1);
  shape.points[2] = {0.5, 0.3, 0.3};
  const auto found = defects_of(shape);
  EXPECT_TRUE(names(found, DefectKind::IntersectingCells, "cell 1: intersects cell 0") ||
              names(found, DefectKind::InvertedCell, "cell 1"))
      << report(found);
}

TEST(Validate, reports_the_same_for_any_number_of_threads) {
  Shape shape =
      shapes::together(shapes::warped_grid(8, 8, 8), shapes::warped_grid(8, 8, 8), {0.3, 0.2, 0.1});
  const std::string parallel = report(defects_of(shape));
  set_thread_count(1);
  const std::string serial = report(defects_of(shape));
  set_thread_count(0);
  EXPECT_EQ(parallel, serial);
  EXPECT_FALSE(serial.empty());
}

TEST(Validate, stops_when_asked_to) {
  const Shape shape = shapes::cube();
  const Progress stop([](std::string_view, double) { return false; });
  EXPECT_THROW((void)validate(shape.polyhedra, shape.points, stop), Cancelled);
}

TEST(Validate, refuses_another_number_of_points) {
  const Shape shape = shapes::cube();
  EXPECT_THROW((void)validate(shape.polyhedra, std::vector<glm::dvec3>(7)), ParameterError);
}

}  // namespace
}  // namespace espalier
