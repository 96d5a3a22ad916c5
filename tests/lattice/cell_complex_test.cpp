#include "lattice/topology/cell_complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

using test::NamedLattice;

using Loops = std::vector<std::vector<std::int32_t>>;

/// A heptagonal prism, a cube, a wedge, a pyramid and two tetrahedra, one on the other.
SubdivisionLattice tower() {
  std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1},
                                    {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0, 0, 2}, {0, 1, 2}};
  const Loops cube = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const Loops wedge = {{4, 5, 7, 6}, {4, 8, 9, 6}, {5, 8, 9, 7}, {4, 5, 8}, {6, 7, 9}};
  points.emplace_back(-1, 0.5, 1.5);
  const Loops pyramid = {{4, 8, 9, 6}, {4, 8, 10}, {8, 9, 10}, {9, 6, 10}, {6, 4, 10}};
  points.emplace_back(-1, 0.5, 3);
  const Loops tetrahedron = {{8, 9, 10}, {8, 9, 11}, {9, 10, 11}, {10, 8, 11}};
  points.emplace_back(1, 0.5, 3);
  const Loops second = {{8, 9, 11}, {8, 9, 12}, {9, 11, 12}, {11, 8, 12}};
  // Below the cube's side x = 1, and a side of the heptagon's: corners 1, 3, 7, 5.
  const std::vector<glm::dvec3> outline = {
      {1.5, 0, -1}, {2, 0, -1}, {2.5, 0, 0.5}, {2, 0, 2}, {1.5, 0, 2}};
  for (const glm::dvec3& point : outline) {
    points.push_back(point);
  }
  for (const glm::dvec3& point : outline) {
    points.push_back(point + glm::dvec3(0, 1, 0));
  }
  Loops heptagon = {{1, 13, 14, 15, 16, 17, 5}, {3, 18, 19, 20, 21, 22, 7}};
  for (std::size_t i = 0; i < 7; ++i) {
    const std::size_t next = (i + 1) % 7;
    heptagon.push_back({heptagon[0][i], heptagon[0][next], heptagon[1][next], heptagon[1][i]});
  }
  return test::lattice_from(
      test::mesh_from_loops(points, {cube, wedge, pyramid, tetrahedron, second, heptagon}));
}

/// Eight cubes round a hole.
SubdivisionLattice ring_of_cubes() {
  test::Section section = test::grid_section(3, 3);
  CompressedRows<std::int32_t> faces;
  for (std::size_t i = 0; i < 9; ++i) {
    if (i != 4) {
      faces.push_back(std::as_const(section.faces)[i]);
    }
  }
  section.faces = faces;
  return test::prism(section, 1);
}

/// A grid whose vertices, cells and loops are in random order.
SubdivisionLattice shuffled_grid() {
  const CellMesh box = make_box({3, 3, 3}, {0, 0, 0}, {3, 3, 3});
  std::mt19937 random(3);
  std::vector<std::int32_t> place(box.points.size());
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  std::vector<glm::dvec3> points(box.points.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    points[static_cast<std::size_t>(place[i])] = box.points[i];
  }
  std::vector<Loops> cells;
  for (std::size_t cell = 0; cell < box.cells.cells.n_rows(); ++cell) {
    Loops& loops = cells.emplace_back();
    for (const std::int32_t half_face : box.cells.cells[cell]) {
      std::vector<std::int32_t>& loop = loops.emplace_back();
      for (const std::int32_t vertex : box.cells.faces[static_cast<std::size_t>(half_face >> 1)]) {
        loop.push_back(place[static_cast<std::size_t>(vertex)]);
      }
      std::rotate(loop.begin(), loop.begin() + static_cast<int>(random() % 4), loop.end());
      if (random() % 2 == 0) {
        std::reverse(loop.begin(), loop.end());
      }
    }
    std::shuffle(loops.begin(), loops.end(), random);
  }
  std::shuffle(cells.begin(), cells.end(), random);
  return test::lattice_from(test::mesh_from_loops(points, cells));
}

const std::vector<NamedLattice>& all_lattices() {
  static const std::vector<NamedLattice> kLattices = [] {
    std::vector<NamedLattice> lattices = test::lattice_families();
    lattices.push_back({"tower", tower()});
    lattices.push_back({"ring of cubes", ring_of_cubes()});
    lattices.push_back({"shuffled grid", shuffled_grid()});
    return lattices;
  }();
  return kLattices;
}

template <class Id>
std::vector<Id> to_vector(std::span<const Id> ids) {
  return {ids.begin(), ids.end()};
}

/// The vertices of every face, in order.
std::vector<std::vector<VertexId>> loops_of(const Polyhedra& tables) {
  std::vector<std::vector<VertexId>> loops(tables.faces.n_rows());
  for (std::size_t face = 0; face < loops.size(); ++face) {
    for (const std::int32_t vertex : tables.faces[face]) {
      loops[face].push_back({vertex});
    }
  }
  return loops;
}

using Ends = std::array<VertexId, 2>;

std::set<Ends> edges_of_loop(const std::vector<VertexId>& loop) {
  std::set<Ends> edges;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const VertexId next = loop[(i + 1) % loop.size()];
    edges.insert({std::min(loop[i], next), std::max(loop[i], next)});
  }
  return edges;
}

/// The faces of every cell, by the tables.
std::vector<std::vector<HalfFaceId>> shells_of(const Polyhedra& tables) {
  std::vector<std::vector<HalfFaceId>> shells(tables.cells.n_rows());
  for (std::size_t cell = 0; cell < shells.size(); ++cell) {
    for (const std::int32_t half_face : tables.cells[cell]) {
      shells[cell].push_back(HalfFaceId(half_face));
    }
  }
  return shells;
}

TEST(CellComplex, sorts_edges_by_their_vertices) {
  for (const NamedLattice& family : all_lattices()) {
    std::set<Ends> expected;
    for (const auto& loop : loops_of(family.lattice.complex->polyhedra())) {
      expected.merge(edges_of_loop(loop));
    }
    const CellComplex& complex = *family.lattice.complex;
    std::vector<Ends> found;
    for (const EdgeId edge : complex.edges()) {
      found.push_back(complex.vertices(edge));
    }
    EXPECT_EQ(found, std::vector<Ends>(expected.begin(), expected.end())) << family.name;
  }
}

TEST(CellComplex, joins_consecutive_loop_vertices_by_face_edges) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    for (const FaceId face : complex.faces()) {
      const auto loop = complex.vertices(face);
      const auto edges = complex.edges(face);
      ASSERT_EQ(edges.size(), loop.size()) << family.name;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const VertexId next = loop[(i + 1) % loop.size()];
        EXPECT_EQ(complex.vertices(edges[i]),
                  (Ends{std::min(loop[i], next), std::max(loop[i], next)}));
      }
    }
  }
}

TEST(CellComplex, lists_all_elements_at_a_vertex_ascending) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    const Polyhedra tables = complex.polyhedra();
    const auto loops = loops_of(tables);
    const auto shells = shells_of(tables);
    std::map<VertexId, std::set<EdgeId>> edges;
    for (const EdgeId edge : complex.edges()) {
      edges[complex.vertices(edge)[0]].insert(edge);
      edges[complex.vertices(edge)[1]].insert(edge);
    }
    std::map<VertexId, std::set<FaceId>> faces;
    std::map<VertexId, std::set<CellId>> cells;
    for (std::size_t face = 0; face < loops.size(); ++face) {
      for (const VertexId vertex : loops[face]) {
        faces[vertex].insert({static_cast<std::int32_t>(face)});
      }
    }
    for (std::size_t cell = 0; cell < shells.size(); ++cell) {
      for (const HalfFaceId side : shells[cell]) {
        for (const VertexId vertex : loops[side.face().index()]) {
          cells[vertex].insert({static_cast<std::int32_t>(cell)});
        }
      }
    }
    EXPECT_EQ(complex.n_vertices(), static_cast<std::size_t>(tables.n_vertices));
    for (const VertexId v : complex.vertices()) {
      EXPECT_EQ(to_vector(complex.edges(v)), std::vector(edges[v].begin(), edges[v].end()));
      EXPECT_EQ(to_vector(complex.faces(v)), std::vector(faces[v].begin(), faces[v].end()));
      EXPECT_EQ(to_vector(complex.cells(v)), std::vector(cells[v].begin(), cells[v].end()));
    }
  }
}

TEST(CellComplex, lists_the_vertices_of_a_cell_once_and_ascending) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    for (const CellId cell : complex.cells()) {
      std::set<VertexId> expected;
      for (const HalfFaceId side : complex.half_faces(cell)) {
        const auto loop = complex.vertices(side.face());
        expected.insert(loop.begin(), loop.end());
      }
      EXPECT_EQ(to_vector(complex.vertices(cell)), std::vector(expected.begin(), expected.end()));
    }
  }
}

TEST(CellComplex, knows_the_cell_behind_each_side_of_a_face) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    std::map<HalfFaceId, CellId> owner;
    const auto shells = shells_of(complex.polyhedra());
    for (std::size_t cell = 0; cell < shells.size(); ++cell) {
      EXPECT_EQ(to_vector(complex.half_faces(CellId{static_cast<std::int32_t>(cell)})),
                shells[cell]);
      for (const HalfFaceId side : shells[cell]) {
        EXPECT_TRUE(owner.emplace(side, CellId{static_cast<std::int32_t>(cell)}).second);
      }
    }
    for (const FaceId face : complex.faces()) {
      const HalfFaceId front(face, 0);
      const HalfFaceId back(face, 1);
      EXPECT_EQ(complex.cell(front), owner[front]);
      EXPECT_EQ(complex.cell(back), owner[back]);
      const int n = (owner[front].is_valid() ? 1 : 0) + (owner[back].is_valid() ? 1 : 0);
      EXPECT_EQ(complex.n_cells(face), n);
      EXPECT_EQ(complex.is_boundary(face), n == 1);
      if (n == 1) {
        EXPECT_TRUE(complex.cell(complex.inner_half_face(face)).is_valid());
        EXPECT_FALSE(complex.cell(complex.inner_half_face(face).opposite()).is_valid());
      }
    }
  }
}

TEST(CellComplex, marks_the_edges_and_vertices_of_boundary_faces) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    std::set<EdgeId> edges;
    std::set<VertexId> vertices;
    for (const FaceId face : complex.faces()) {
      if (complex.is_boundary(face)) {
        edges.insert(complex.edges(face).begin(), complex.edges(face).end());
        vertices.insert(complex.vertices(face).begin(), complex.vertices(face).end());
      }
    }
    for (const EdgeId edge : complex.edges()) {
      EXPECT_EQ(complex.is_boundary(edge), edges.contains(edge)) << family.name;
    }
    for (const VertexId vertex : complex.vertices()) {
      EXPECT_EQ(complex.is_boundary(vertex), vertices.contains(vertex)) << family.name;
    }
  }
}

TEST(CellComplex, puts_the_cell_they_share_between_consecutive_faces_round_an_edge) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    for (const EdgeId edge : complex.edges()) {
      const auto fan = complex.half_faces(edge);
      std::set<FaceId> faces;
      for (std::size_t i = 0; i < fan.size(); ++i) {
        faces.insert(fan[i].face());
        // Where a fan ends in nothing the next one comes out of nothing.
        const HalfFaceId next = fan[(i + 1) % fan.size()];
        EXPECT_EQ(complex.cell(fan[i]), complex.cell(next.opposite())) << family.name;
      }
      std::set<FaceId> expected;
      std::set<CellId> cells;
      int n_boundary = 0;
      for (const FaceId face : complex.faces(complex.vertices(edge)[0])) {
        if (std::ranges::count(complex.edges(face), edge) == 1) {
          expected.insert(face);
          n_boundary += complex.is_boundary(face) ? 1 : 0;
          cells.insert(complex.cell(HalfFaceId(face, 0)));
          cells.insert(complex.cell(HalfFaceId(face, 1)));
        }
      }
      cells.erase(CellId{});
      EXPECT_EQ(faces, expected) << family.name;
      EXPECT_EQ(fan.size(), faces.size()) << family.name;
      EXPECT_EQ(complex.n_open_fans(edge), n_boundary / 2) << family.name;
      EXPECT_EQ(complex.n_cells(edge), static_cast<int>(cells.size())) << family.name;
    }
  }
}

glm::dvec3 mean(const std::vector<glm::dvec3>& points, std::span<const VertexId> vertices) {
  glm::dvec3 sum(0);
  for (const VertexId vertex : vertices) {
    sum += points[vertex.index()];
  }
  return sum / static_cast<double>(vertices.size());
}

/// The area vector of a side's loop, by the right hand.
glm::dvec3 normal(const CellComplex& complex, HalfFaceId side,
                  const std::vector<glm::dvec3>& points) {
  const auto loop = complex.vertices(side.face());
  const glm::dvec3 origin = points[loop[0].index()];
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += glm::cross(points[loop[i].index()] - origin, points[loop[i + 1].index()] - origin);
  }
  return side.side() == 0 ? sum : -sum;
}

TEST(CellComplex, turns_the_sides_of_a_cell_outward) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    const std::vector<glm::dvec3>& points = family.lattice.rest;
    for (const CellId cell : complex.cells()) {
      const glm::dvec3 centre = mean(points, complex.vertices(cell));
      for (const HalfFaceId side : complex.half_faces(cell)) {
        const glm::dvec3 outward = mean(points, complex.vertices(side.face())) - centre;
        EXPECT_GT(glm::dot(normal(complex, side, points), outward), 0) << family.name;
      }
    }
  }
}

TEST(CellComplex, goes_round_an_edge_clockwise_seen_against_it) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    const std::vector<glm::dvec3>& points = family.lattice.rest;
    for (const EdgeId edge : complex.edges()) {
      const auto [first, second] = complex.vertices(edge);
      const glm::dvec3 along = points[second.index()] - points[first.index()];
      const auto into = [&](HalfFaceId side) {
        return mean(points, complex.vertices(side.face())) - points[first.index()];
      };
      const auto fan = complex.half_faces(edge);
      for (std::size_t i = 0; i < fan.size(); ++i) {
        EXPECT_TRUE(complex.runs_along(fan[i], edge));
        EXPECT_FALSE(complex.runs_along(fan[i].opposite(), edge));
        // The loop, stored for side 0, has the edge's vertices next to each other in that order.
        auto loop = to_vector(complex.vertices(fan[i].face()));
        if (fan[i].side() == 1) {
          std::reverse(loop.begin(), loop.end());
        }
        const auto at = std::find(loop.begin(), loop.end(), first) - loop.begin();
        EXPECT_EQ(loop[(static_cast<std::size_t>(at) + 1) % loop.size()], second) << family.name;
        if (complex.cell(fan[i]).is_valid()) {
          const glm::dvec3 turn = glm::cross(into(fan[i]), into(fan[(i + 1) % fan.size()]));
          EXPECT_LT(glm::dot(turn, along), 0) << family.name;
        }
      }
    }
  }
}

TEST(CellComplex, orders_six_tetrahedra_round_the_diagonal_of_their_cube) {
  const SubdivisionLattice lattice = test::six_tetrahedra();
  const CellComplex& complex = *lattice.complex;
  std::vector<std::int32_t> tips;
  for (const HalfFaceId side : complex.half_faces(complex.find_edge({0}, {7}))) {
    for (const VertexId vertex : complex.vertices(side.face())) {
      if (vertex.value != 0 && vertex.value != 7) {
        tips.push_back(vertex.value);
      }
    }
  }
  std::rotate(tips.begin(), std::find(tips.begin(), tips.end(), 1), tips.end());
  EXPECT_EQ(tips, (std::vector<std::int32_t>{1, 5, 4, 6, 2, 3}));
}

TEST(CellComplex, breaks_the_fans_where_cells_only_touch) {
  const SubdivisionLattice lattice = test::cubes_sharing_edge();
  const CellComplex& complex = *lattice.complex;
  int n_touching = 0;
  for (const EdgeId edge : complex.edges()) {
    if (complex.n_open_fans(edge) == 1) {
      EXPECT_EQ(complex.n_cells(edge), 1);
      continue;
    }
    ++n_touching;
    EXPECT_EQ(complex.n_open_fans(edge), 2);
    EXPECT_EQ(complex.n_cells(edge), 2);
    const auto fan = complex.half_faces(edge);
    ASSERT_EQ(fan.size(), 4u);
    EXPECT_EQ(complex.cell(fan[0]).is_valid(), true);
    EXPECT_EQ(complex.cell(fan[1]).is_valid(), false);
    EXPECT_EQ(complex.cell(fan[2]).is_valid(), true);
    EXPECT_EQ(complex.cell(fan[3]).is_valid(), false);
    EXPECT_NE(complex.cell(fan[0]), complex.cell(fan[2]));
    for (const VertexId end : complex.vertices(edge)) {
      EXPECT_EQ(lattice.rest[end.index()].x, 1);
      EXPECT_EQ(lattice.rest[end.index()].y, 1);
    }
  }
  EXPECT_EQ(n_touching, 1);
}

TEST(CellComplex, has_the_euler_characteristic_of_its_shape) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& complex = *family.lattice.complex;
    const auto n = [](std::size_t count) { return static_cast<std::ptrdiff_t>(count); };
    EXPECT_EQ(n(complex.n_vertices()) - n(complex.n_edges()) + n(complex.n_faces()) -
                  n(complex.n_cells()),
              family.name == "ring of cubes" ? 0 : 1)
        << family.name;
  }
}

TEST(CellComplex, finds_the_edge_between_two_vertices_or_none) {
  const SubdivisionLattice lattice = tower();
  const CellComplex& complex = *lattice.complex;
  std::map<Ends, EdgeId> edges;
  for (const EdgeId edge : complex.edges()) {
    const auto [a, b] = complex.vertices(edge);
    EXPECT_EQ(complex.other_end(edge, a), b);
    EXPECT_EQ(complex.other_end(edge, b), a);
    edges[{a, b}] = edges[{b, a}] = edge;
  }
  for (const VertexId a : complex.vertices()) {
    for (const VertexId b : complex.vertices()) {
      EXPECT_EQ(complex.find_edge(a, b), (edges[{a, b}]));
    }
  }
}

bool same_rows(const CompressedRows<std::int32_t>& a, const CompressedRows<std::int32_t>& b) {
  bool is_same = a.n_rows() == b.n_rows();
  for (std::size_t i = 0; is_same && i < a.n_rows(); ++i) {
    is_same = std::ranges::equal(a[i], b[i]);
  }
  return is_same;
}

TEST(CellComplex, gives_back_the_tables_it_was_built_from) {
  for (const auto& cells : {std::array{3, 2, 4}, std::array{1, 1, 1}}) {
    const CellMesh box = make_box(cells, {0, 0, 0}, {1, 1, 1});
    const Polyhedra tables = CellComplex(box.cells).polyhedra();
    EXPECT_EQ(tables.n_vertices, box.cells.n_vertices);
    EXPECT_TRUE(same_rows(tables.faces, box.cells.faces));
    EXPECT_TRUE(same_rows(tables.cells, box.cells.cells));
  }
  const Polyhedra tables = tower().complex->polyhedra();
  EXPECT_TRUE(same_rows(CellComplex(tables).polyhedra().faces, tables.faces));
  EXPECT_TRUE(same_rows(CellComplex(tables).polyhedra().cells, tables.cells));
}

TEST(CellComplex, is_the_same_when_it_is_built_unchecked) {
  for (const NamedLattice& family : all_lattices()) {
    const CellComplex& checked = *family.lattice.complex;
    const CellComplex unchecked = CellComplex::from_valid(checked.polyhedra());
    ASSERT_EQ(unchecked.n_vertices(), checked.n_vertices());
    ASSERT_EQ(unchecked.n_edges(), checked.n_edges());
    EXPECT_TRUE(same_rows(unchecked.polyhedra().faces, checked.polyhedra().faces));
    EXPECT_TRUE(same_rows(unchecked.polyhedra().cells, checked.polyhedra().cells));
    for (const EdgeId edge : checked.edges()) {
      EXPECT_EQ(unchecked.vertices(edge), checked.vertices(edge));
      EXPECT_TRUE(std::ranges::equal(unchecked.half_faces(edge), checked.half_faces(edge)));
    }
    for (const VertexId vertex : checked.vertices()) {
      EXPECT_TRUE(std::ranges::equal(unchecked.cells(vertex), checked.cells(vertex)));
    }
  }
}

TEST(CellComplex, is_empty_by_default) {
  const CellComplex complex;
  EXPECT_EQ(complex.n_vertices() + complex.n_edges() + complex.n_faces() + complex.n_cells(), 0u);
  EXPECT_EQ(complex.polyhedra().faces.n_rows(), 0u);
}

}  // namespace
}  // namespace espalier
