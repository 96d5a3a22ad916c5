// What the checking constructor of CellComplex refuses.

#include <gtest/gtest.h>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {
namespace {

using Rows = CompressedRows<std::int32_t>;

Polyhedra cube() {
  return make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}).cells;
}

Polyhedra two_cubes() {
  return make_box({2, 1, 1}, {0, 0, 0}, {1, 1, 1}).cells;
}

/// The row without its entry at `place`.
Rows without(const Rows& rows, std::size_t row, std::size_t place) {
  Rows result;
  for (std::size_t i = 0; i < rows.n_rows(); ++i) {
    std::vector<std::int32_t> values(rows[i].begin(), rows[i].end());
    if (i == row) {
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(place));
    }
    result.push_back(values);
  }
  return result;
}

/// What the constructor says; "" if it accepts the tables.
std::string complaint(const Polyhedra& tables) {
  try {
    const CellComplex complex(tables);
    return "";
  } catch (const LatticeError& error) {
    return error.what();
  }
}

TEST(CellComplex, accepts_what_the_following_tests_spoil) {
  EXPECT_EQ(complaint(cube()), "");
  EXPECT_EQ(complaint(two_cubes()), "");
}

TEST(CellComplex, refuses_to_be_built_from_no_cells) {
  EXPECT_EQ(complaint({}), "invalid lattice: has no cells");
}

TEST(CellComplex, refuses_vertices_and_faces_that_do_not_exist) {
  Polyhedra tables = cube();
  tables.faces[2][3] = 8;
  EXPECT_EQ(complaint(tables), "invalid lattice: face 2: vertex 8 does not exist, there are 8");
  tables.faces[2][3] = -1;
  EXPECT_EQ(complaint(tables), "invalid lattice: face 2: vertex -1 does not exist, there are 8");
  tables = two_cubes();
  tables.cells[1][0] = 22;
  EXPECT_EQ(complaint(tables), "invalid lattice: cell 1: face 11 does not exist, there are 11");
  tables.cells[1][0] = -2;
  EXPECT_EQ(complaint(tables), "invalid lattice: cell 1: face -1 does not exist, there are 11");
}

TEST(CellComplex, refuses_faces_with_less_than_three_vertices) {
  Polyhedra tables = cube();
  tables.faces = without(without(tables.faces, 4, 0), 4, 0);
  EXPECT_EQ(complaint(tables), "invalid lattice: face 4: has 2 vertices, needs three or more");
}

TEST(CellComplex, refuses_faces_that_visit_a_vertex_twice) {
  Polyhedra tables = cube();
  tables.faces[5][2] = tables.faces[5][0];
  EXPECT_EQ(complaint(tables), "invalid lattice: face 5: contains vertex 4 twice");
  const std::vector<std::int32_t> long_loop = {0, 1, 2, 3, 4, 5, 6, 7, 0};
  tables.faces.push_back(long_loop);
  tables.faces[5][2] = 7;
  EXPECT_EQ(complaint(tables), "invalid lattice: face 6: contains vertex 0 twice");
}

TEST(CellComplex, refuses_two_faces_with_the_same_vertices) {
  Polyhedra tables = two_cubes();
  const std::vector<std::int32_t> copy = {tables.faces[1][2], tables.faces[1][1],
                                          tables.faces[1][0], tables.faces[1][3]};
  tables.faces.push_back(copy);
  tables.cells[1][0] = 22;
  EXPECT_EQ(complaint(tables),
            "invalid lattice: face 11: has the vertices of face 1; cells must share one face");
}

TEST(CellComplex, refuses_cells_with_less_than_four_faces) {
  Polyhedra tables = cube();
  tables.cells = without(without(without(tables.cells, 0, 5), 0, 4), 0, 3);
  EXPECT_EQ(complaint(tables).find("invalid lattice: cell 0: has 3 faces, needs four or more"), 0u);
}

TEST(CellComplex, refuses_cells_that_use_a_face_twice) {
  Polyhedra tables = cube();
  tables.cells[0][3] = tables.cells[0][2] ^ 1;
  EXPECT_EQ(complaint(tables).find("invalid lattice: cell 0: contains face 2 twice"), 0u);
}

TEST(CellComplex, refuses_cells_that_are_not_closed) {
  Polyhedra tables = cube();
  tables.cells = without(tables.cells, 0, 5);
  EXPECT_EQ(complaint(tables).find("invalid lattice: cell 0: is not closed: its edge 4-5 has 1 of "
                                   "its faces, needs two"),
            0u);
}

/// One pyramid per apex over the quadrilateral 0 1 2 3, the base with the given sides.
Polyhedra pyramids(const std::vector<int>& sides) {
  Polyhedra tables{static_cast<std::int32_t>(4 + sides.size()), {{0, 1, 2, 3}}, {}};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    std::vector<std::int32_t> cell = {sides[i]};
    for (std::int32_t a = 0; a < 4; ++a) {
      cell.push_back(2 * static_cast<std::int32_t>(tables.faces.n_rows()) + 1 - sides[i]);
      const std::array<std::int32_t, 3> triangle = {a, (a + 1) % 4,
                                                    4 + static_cast<std::int32_t>(i)};
      tables.faces.push_back(triangle);
    }
    tables.cells.push_back(cell);
  }
  return tables;
}

TEST(CellComplex, refuses_faces_with_three_cells_or_two_on_one_side) {
  EXPECT_EQ(complaint(pyramids({0, 1})), "");
  EXPECT_EQ(complaint(pyramids({0, 1, 0})),
            "invalid lattice: face 0: belongs to 3 cells, at most two can share it");
  EXPECT_EQ(complaint(pyramids({1, 1})),
            "invalid lattice: face 0: has both of its cells on one side");
}

TEST(CellComplex, refuses_cells_whose_sides_face_different_ways) {
  Polyhedra tables = cube();
  tables.cells[0][2] ^= 1;
  EXPECT_EQ(complaint(tables),
            "invalid lattice: cell 0: its faces cannot be oriented along edge 0-1");
}

TEST(CellComplex, refuses_cells_that_are_no_single_sphere) {
  const std::string expected =
      "invalid lattice: cell 0: its faces do not form one shell like a sphere's";
  // Two shells: both cubes of a row of three but the middle one, as one cell.
  const Polyhedra row = make_box({3, 1, 1}, {0, 0, 0}, {1, 1, 1}).cells;
  std::vector<std::int32_t> both(row.cells[0].begin(), row.cells[0].end());
  both.insert(both.end(), row.cells[2].begin(), row.cells[2].end());
  Polyhedra shells = row;
  shells.cells = Rows{};
  shells.cells.push_back(both);
  shells.cells.push_back(std::as_const(row).cells[1]);
  EXPECT_EQ(complaint(shells), expected);
  // A torus of 3 × 3 quadrilaterals.
  Polyhedra torus{9, {}, {}};
  std::vector<std::int32_t> all;
  for (std::int32_t i = 0; i < 3; ++i) {
    for (std::int32_t j = 0; j < 3; ++j) {
      const auto vertex = [](std::int32_t a, std::int32_t b) { return 3 * (a % 3) + b % 3; };
      const std::array quad = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                               vertex(i, j + 1)};
      all.push_back(2 * static_cast<std::int32_t>(torus.faces.n_rows()));
      torus.faces.push_back(quad);
    }
  }
  torus.cells.push_back(all);
  EXPECT_EQ(complaint(torus), expected);
  // Two tetrahedra that share only vertex 0.
  const Polyhedra pinched{
      7,
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}},
      {{0, 2, 4, 6, 8, 10, 12, 14}}};
  EXPECT_EQ(complaint(pinched), expected);
}

TEST(CellComplex, refuses_unused_faces_and_vertices) {
  Polyhedra tables = cube();
  const std::array<std::int32_t, 3> loose = {0, 1, 2};
  tables.faces.push_back(loose);
  EXPECT_EQ(complaint(tables), "invalid lattice: face 6: belongs to no cell");
  tables = cube();
  tables.n_vertices = 9;
  EXPECT_EQ(complaint(tables), "invalid lattice: vertex 8: belongs to no face");
}

TEST(CellComplex, counts_the_defects_it_does_not_name) {
  Polyhedra tables = cube();
  tables.n_vertices = 11;
  EXPECT_EQ(complaint(tables),
            "invalid lattice: vertex 8: belongs to no face (and 2 more defects)");
  tables.n_vertices = 10;
  EXPECT_EQ(complaint(tables), "invalid lattice: vertex 8: belongs to no face (and 1 more defect)");
}

}  // namespace
}  // namespace espalier
