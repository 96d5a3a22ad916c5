#include "lattice/topology/polyhedra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/core/index_order.h"
#include "lattice/core/parallel.h"
#include "lattice/topology/cell_complex.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

using Row = std::vector<std::int32_t>;

template <class Rows>
Row row(const Rows& rows, std::size_t i) {
  const auto values = std::as_const(rows)[i];
  return {values.begin(), values.end()};
}

/// Two tetrahedra; the second brings the shared triangle as `shared`.
CellLoops two_tetrahedra(const Row& shared) {
  return {5,
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, shared, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}},
          {0, 4, 8}};
}

TEST(MatchFaces, shares_a_face_whatever_its_winding_and_start) {
  for (Row shared : {Row{1, 2, 3}, Row{3, 2, 1}}) {
    const int is_reversed = shared == Row{3, 2, 1} ? 1 : 0;
    for (int start = 0; start < 3; ++start) {
      std::rotate(shared.begin(), shared.begin() + 1, shared.end());
      const Polyhedra tables = match_faces(two_tetrahedra(shared));
      EXPECT_EQ(tables.n_vertices, 5);
      ASSERT_EQ(tables.faces.n_rows(), 7u);
      EXPECT_EQ(row(tables.cells, 0), (Row{0, 2, 4, 6}));
      EXPECT_EQ(row(tables.cells, 1), (Row{4 + is_reversed, 8, 10, 12}));
    }
  }
}

TEST(MatchFaces, numbers_faces_by_first_appearance_and_keeps_their_loops) {
  const Polyhedra tables = match_faces(two_tetrahedra({3, 2, 1}));
  const std::vector<Row> expected = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                     {1, 2, 4}, {2, 3, 4}, {3, 1, 4}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(row(tables.faces, i), expected[i]);
  }
}

TEST(MatchFaces, keeps_faces_apart_that_agree_round_their_smallest_vertex) {
  const Polyhedra tables = match_faces(
      {6, {{0, 1, 2, 3, 4}, {0, 1, 3, 2, 4}, {0, 1, 5, 4}, {2, 1, 0, 4, 3}, {1, 4, 0}}, {0, 5}});
  ASSERT_EQ(tables.faces.n_rows(), 4u);
  EXPECT_EQ(row(tables.cells, 0), (Row{0, 2, 4, 1, 6}));
}

TEST(MatchFaces, gives_the_same_tables_for_any_number_of_threads) {
  std::vector<std::array<std::int32_t, 8>> cells;
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    std::array<std::int32_t, 8> cell{};
    for (std::int32_t& corner : cell) {
      corner = static_cast<std::int32_t>(random() % 30);
    }
    cells.push_back(cell);
  }
  set_thread_count(1);
  const Polyhedra one = match_faces(hexahedron_loops(30, cells));
  set_thread_count(4);
  const Polyhedra four = match_faces(hexahedron_loops(30, cells));
  set_thread_count(0);
  EXPECT_TRUE(std::ranges::equal(one.faces.values(), four.faces.values()));
  EXPECT_TRUE(std::ranges::equal(one.cells.values(), four.cells.values()));
}

TEST(HexahedronLoops, run_counter_clockwise_seen_from_outside) {
  const std::array<std::int32_t, 8> cell = {10, 11, 12, 13, 14, 15, 16, 17};
  const CellLoops loops = hexahedron_loops(18, {&cell, 1});
  EXPECT_EQ(loops.n_vertices, 18);
  EXPECT_EQ(loops.cells, (std::vector<std::uint32_t>{0, 6}));
  const std::vector<Row> expected = {{10, 14, 16, 12}, {11, 13, 17, 15}, {10, 11, 15, 14},
                                     {12, 16, 17, 13}, {10, 12, 13, 11}, {14, 15, 17, 16}};
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_EQ(row(loops.loops, face), expected[face]);
  }
  EXPECT_EQ(signed_volume(match_faces(loops), 0, make_box({2, 2, 1}, {0, 0, 0}, {2, 2, 1}).points),
            signed_volume(match_faces(loops), 0, make_box({2, 2, 1}, {5, 5, 5}, {7, 7, 6}).points));
}

TEST(PolyhedraFromFaces, puts_every_cell_on_side_0) {
  const Polyhedra tables = polyhedra_from_faces(4, {{0, 1, 2}, {0, 1, 3}}, {{1, 0}, {0}});
  EXPECT_EQ(row(tables.cells, 0), (Row{2, 0}));
  EXPECT_EQ(row(tables.cells, 1), (Row{0}));
  EXPECT_EQ(row(tables.faces, 1), (Row{0, 1, 3}));
}

/// Random sides, starts and windings.
Polyhedra disordered(Polyhedra tables, unsigned seed) {
  std::mt19937 random(seed);
  for (std::size_t face = 0; face < tables.faces.n_rows(); ++face) {
    const auto loop = tables.faces[face];
    std::rotate(loop.begin(), loop.begin() + static_cast<int>(random() % loop.size()), loop.end());
    if (random() % 2 == 0) {
      std::reverse(loop.begin(), loop.end());
    }
  }
  for (std::size_t cell = 0; cell < tables.cells.n_rows(); ++cell) {
    for (std::int32_t& half_face : tables.cells[cell]) {
      half_face ^= static_cast<std::int32_t>(random() % 2);
    }
  }
  return tables;
}

TEST(Orient, restores_positive_volumes_from_any_sides_and_windings) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Polyhedra original = family.lattice.complex->polyhedra();
    for (unsigned seed = 0; seed < 5; ++seed) {
      Polyhedra tables = disordered(original, seed);
      orient(tables, family.lattice.rest);
      for (std::size_t cell = 0; cell < tables.cells.n_rows(); ++cell) {
        EXPECT_NEAR(signed_volume(tables, cell, family.lattice.rest),
                    signed_volume(original, cell, family.lattice.rest), 1e-14)
            << family.name;
        EXPECT_GT(signed_volume(tables, cell, family.lattice.rest), 0) << family.name;
      }
      EXPECT_NO_THROW((void)CellComplex(tables)) << family.name;
    }
  }
}

TEST(Orient, turns_each_connected_part_by_its_own_volume) {
  // Two cubes that share only a vertex, one of them mirrored in x = 1 beyond the other's place.
  const SubdivisionLattice lattice = test::cubes_sharing_vertex();
  std::vector<glm::dvec3> points = lattice.rest;
  for (glm::dvec3& point : points) {
    point.x = point.x > 1 ? 1 - point.x : point.x;
  }
  Polyhedra tables = lattice.complex->polyhedra();
  EXPECT_EQ(signed_volume(tables, 0, points), 1);
  EXPECT_EQ(signed_volume(tables, 1, points), -2);
  orient(tables, points);
  EXPECT_EQ(signed_volume(tables, 0, points), 1);
  EXPECT_EQ(signed_volume(tables, 1, points), 2);
}

TEST(Orient, follows_the_total_volume_of_a_part_with_an_inverted_cell) {
  CellMesh box = make_box({2, 1, 1}, {0, 0, 0}, {2, 1, 1});
  for (const std::size_t i : {1u, 4u, 7u, 10u}) {
    box.points[i].x = 2.5;
  }
  Polyhedra tables = disordered(box.cells, 1);
  orient(tables, box.points);
  EXPECT_EQ(signed_volume(tables, 0, box.points), 2.5);
  EXPECT_EQ(signed_volume(tables, 1, box.points), -0.5);
}

TEST(Orient, leaves_what_cannot_be_oriented) {
  // One face in three cells: any answer will do, but there must be one.
  Polyhedra tables = match_faces({6,
                                  {{0, 1, 2},
                                   {0, 1, 3},
                                   {1, 2, 3},
                                   {2, 0, 3},
                                   {0, 1, 2},
                                   {0, 1, 4},
                                   {1, 2, 4},
                                   {2, 0, 4},
                                   {0, 1, 2},
                                   {0, 1, 5},
                                   {1, 2, 5},
                                   {2, 0, 5}},
                                  {0, 4, 8, 12}});
  orient(tables, std::vector<glm::dvec3>{
                     {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 2}});
  EXPECT_EQ(tables.faces.n_rows(), 10u);
  EXPECT_THROW((void)CellComplex(tables), LatticeError);
}

TEST(SignedVolume, is_exact_for_known_bodies_at_offsets_and_scales) {
  struct Body {
    const char* name;
    CellMesh mesh;
    double six_volumes;
  };
  const std::vector<Body> bodies = {
      {"cube", make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}), 6},
      {"tetrahedron",
       test::mesh_from_loops({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                             {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}),
       1},
      {"pyramid of height 3",
       test::mesh_from_loops({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 3}},
                             {{{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}),
       6},
      {"wedge",
       test::mesh_from_loops({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 4}, {1, 0, 4}, {0, 1, 4}},
                             {{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}),
       12},
      {"octahedron",
       test::mesh_from_loops({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                             {{{0, 2, 4},
                               {2, 1, 4},
                               {1, 3, 4},
                               {3, 0, 4},
                               {2, 0, 5},
                               {1, 2, 5},
                               {3, 1, 5},
                               {0, 3, 5}}}),
       8},
  };
  for (const Body& body : bodies) {
    for (const double scale : {1.0, 0x1p40, 0x1p-40}) {
      for (const double offset : {0.0, 1024.0, -0x1p20}) {
        std::vector<glm::dvec3> points = body.mesh.points;
        for (glm::dvec3& point : points) {
          point = (point + glm::dvec3(offset, -offset, offset / 2)) * scale;
        }
        const double expected = body.six_volumes / 6 * scale * scale * scale;
        EXPECT_DOUBLE_EQ(signed_volume(body.mesh.cells, 0, points), expected) << body.name;
        Polyhedra inverted = body.mesh.cells;
        for (std::int32_t& half_face : inverted.cells[0]) {
          half_face ^= 1;
        }
        EXPECT_DOUBLE_EQ(signed_volume(inverted, 0, points), -expected) << body.name;
      }
    }
  }
}

TEST(SignedVolume, splits_a_bent_face_round_its_centroid) {
  // The unit cube with corner 7 raised to z = 2: the top's centroid is raised by 1/4, and the four
  // triangles round it lie over 1/4 each, at mean heights 1 + (0 + 0 + 1/4) / 3 twice and
  // 1 + (0 + 1 + 1/4) / 3 twice.
  CellMesh box = make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1});
  box.points[7].z = 2;
  EXPECT_DOUBLE_EQ(signed_volume(box.cells, 0, box.points), 1.25);
}

}  // namespace
}  // namespace espalier
