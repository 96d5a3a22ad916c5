#include "lattice/subdivision/refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <numeric>

#include "lattice/build/primitives.h"
#include "tests/support/families.h"
#include "tests/support/refined_points.h"

namespace espalier {
namespace {

using test::lattice_families;
using test::NamedLattice;

double weight_of(const StencilTable& table, VertexId row, VertexId column) {
  const StencilTable::Row weights = table[row.index()];
  double sum = 0;
  for (std::size_t i = 0; i < weights.indices.size(); ++i) {
    sum += weights.indices[i] == column.value ? weights.weights[i] : 0;
  }
  return sum;
}

TEST(Refine, has_the_known_weights_of_the_tricubic_b_spline) {
  const SubdivisionLattice grid = test::lattice_from(make_box({4, 4, 4}, {0, 0, 0}, {4, 4, 4}));
  const Refinement level = refine(*grid.complex, grid.sharpness, grid.scheme);
  const VertexId centre{2 + 5 * (2 + 5 * 2)};
  const VertexId right{centre.value + 1};
  const VertexId back{centre.value + 5};
  const auto weight = [&](const std::vector<VertexId>& element, VertexId of) {
    return weight_of(level.stencils, *test::refined_point(*grid.complex, level.parents, element),
                     of);
  };
  EXPECT_DOUBLE_EQ(weight({centre}, centre), 27.0 / 64);
  EXPECT_DOUBLE_EQ(weight({centre, right}, centre), 9.0 / 32);
  const VertexId diagonal{back.value + 1};
  EXPECT_DOUBLE_EQ(weight({centre, right, back, diagonal}, centre), 3.0 / 16);
  std::vector<VertexId> cell;
  for (int c = 0; c < 8; ++c) {
    cell.push_back({centre.value + c % 2 + 5 * (c / 2 % 2) + 25 * (c / 4)});
  }
  EXPECT_DOUBLE_EQ(weight(cell, centre), 1.0 / 8);
}

TEST(Refine, stencil_rows_sum_to_one_in_every_family) {
  for (const NamedLattice& family : lattice_families()) {
    for (const Refinement& level : refine(family.lattice, 3)) {
      for (std::size_t row = 0; row < level.stencils.n_rows(); ++row) {
        const auto weights = level.stencils[row].weights;
        EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-14)
            << family.name;
      }
    }
  }
}

TEST(Refine, reproduces_affine_maps_at_every_scale) {
  const glm::dmat3 linear(1.1, 0.3, -0.2, 0.4, 0.8, 0.1, -0.3, 0.2, 1.3);
  for (const NamedLattice& family : lattice_families()) {
    for (const double scale : {1.0, 1e8, 1e-8}) {
      std::vector<glm::dvec3> rest = test::jittered(family.lattice.rest, 0.1, 7);
      std::vector<glm::dvec3> mapped;
      for (glm::dvec3& point : rest) {
        point *= scale;
        mapped.push_back(linear * point + glm::dvec3(1, 2, 3) * scale);
      }
      for (const Refinement& level : refine(family.lattice, 2)) {
        rest = level.stencils.apply(rest);
        mapped = level.stencils.apply(mapped);
        for (std::size_t i = 0; i < rest.size(); ++i) {
          const glm::dvec3 expected = linear * rest[i] + glm::dvec3(1, 2, 3) * scale;
          ASSERT_LT(glm::distance(mapped[i], expected), 2e-14 * scale * 10) << family.name;
        }
      }
    }
  }
}

TEST(Refine, counts_elements_by_the_formulas) {
  for (const NamedLattice& family : lattice_families()) {
    const CellComplex* coarse = family.lattice.complex.get();
    for (const Refinement& level : refine(family.lattice, 2)) {
      std::size_t cell_corners = 0;
      std::size_t cell_edges = 0;
      std::size_t cell_faces = 0;
      for (const CellId cell : coarse->cells()) {
        std::size_t face_corners = 0;
        for (const HalfFaceId half_face : coarse->half_faces(cell)) {
          face_corners += coarse->vertices(half_face.face()).size();
        }
        cell_corners += coarse->vertices(cell).size();
        cell_edges += face_corners / 2;
        cell_faces += coarse->half_faces(cell).size();
      }
      std::size_t face_corners = 0;
      for (const FaceId face : coarse->faces()) {
        face_corners += coarse->vertices(face).size();
      }
      const CellComplex& fine = *level.complex;
      EXPECT_EQ(fine.n_cells(), cell_corners) << family.name;
      EXPECT_EQ(fine.n_faces(), face_corners + cell_edges) << family.name;
      EXPECT_EQ(fine.n_edges(), 2 * coarse->n_edges() + face_corners + cell_faces) << family.name;
      EXPECT_EQ(fine.n_vertices(),
                coarse->n_vertices() + coarse->n_edges() + coarse->n_faces() + coarse->n_cells())
          << family.name;
      coarse = &fine;
    }
  }
}

TEST(Refine, turns_a_corner_of_valence_n_into_a_cell_with_2n_faces) {
  const SubdivisionLattice lattice = test::pyramid_on_cube();
  const Refinement first = refine(*lattice.complex, lattice.sharpness, lattice.scheme);
  std::map<std::size_t, int> sizes;
  CellId at_apex;
  for (const CellId cell : first.complex->cells()) {
    const std::size_t n = first.complex->half_faces(cell).size() / 2;
    EXPECT_EQ(first.complex->half_faces(cell).size(), 2 * n);
    EXPECT_EQ(first.complex->vertices(cell).size(), 2 * n + 2);
    ++sizes[n];
    if (n == 4) {
      at_apex = cell;
    }
  }
  // Eight corners of the cube, four at the pyramid's base, and its apex.
  EXPECT_EQ(sizes, (std::map<std::size_t, int>{{3, 12}, {4, 1}}));
  // A cell of type n refines into two of type n and 2n − 2 of type 3. [MJ96] section 2.2
  const Refinement second = refine(*first.complex, first.sharpness, lattice.scheme);
  std::map<std::size_t, int> children;
  for (const CellId cell : second.complex->cells()) {
    if (second.parents.parent(cell) == at_apex) {
      ++children[second.complex->half_faces(cell).size() / 2];
    }
  }
  EXPECT_EQ(children, (std::map<std::size_t, int>{{3, 8}, {4, 2}}));
}

TEST(Refine, multiplies_the_cells_of_a_hexahedral_lattice_by_eight) {
  const SubdivisionLattice box = test::lattice_from(make_box({2, 1, 3}, {0, 0, 0}, {1, 1, 1}));
  std::size_t n_cells = 6;
  for (const Refinement& level : refine(box, 3)) {
    n_cells *= 8;
    EXPECT_EQ(level.complex->n_cells(), n_cells);
  }
  // A prism over a triangle has six corners, its children are hexahedra.
  const SubdivisionLattice wedges = test::prism(test::wheel_section(5), 2);
  const auto levels = refine(wedges, 3);
  EXPECT_EQ(levels[0].complex->n_cells(), 60u);
  EXPECT_EQ(levels[1].complex->n_cells(), 480u);
  EXPECT_EQ(levels[2].complex->n_cells(), 3840u);
}

TEST(Refine, keeps_every_refined_complex_valid) {
  for (const NamedLattice& family : lattice_families()) {
    for (const Refinement& level : refine(family.lattice, 2)) {
      // The checking constructor accepts the tables, and finds the same radial order.
      const CellComplex checked(level.complex->polyhedra());
      for (const EdgeId edge : checked.edges()) {
        ASSERT_TRUE(std::ranges::equal(checked.half_faces(edge), level.complex->half_faces(edge)));
      }
    }
  }
}

TEST(Refine, knows_the_parents_of_all_elements) {
  const SubdivisionLattice lattice = test::pyramid_on_cube();
  const CellComplex& coarse = *lattice.complex;
  const Refinement level = refine(coarse, lattice.sharpness, lattice.scheme);
  using Kind = Parent::Kind;
  for (const EdgeId edge : coarse.edges()) {
    EXPECT_EQ(level.parents.parent(level.parents.edge_point(edge)),
              (Parent{Kind::Edge, edge.value}));
  }
  std::map<Kind, int> edges;
  for (const EdgeId edge : level.complex->edges()) {
    ++edges[level.parents.parent(edge, *level.complex).kind];
  }
  // 16 edges halved; 4 per quadrilateral of 6 and 3 per triangle of 4; one for each side of a face.
  EXPECT_EQ(edges, (std::map<Kind, int>{{Kind::Edge, 32}, {Kind::Face, 36}, {Kind::Cell, 11}}));
  for (const FaceId face : level.complex->faces()) {
    const Parent parent = level.parents.parent(face);
    const bool on_boundary = parent.kind == Kind::Face && coarse.is_boundary(FaceId{parent.index});
    EXPECT_EQ(level.complex->is_boundary(face), on_boundary);
  }
}

TEST(Refine, finds_lines_but_not_nodes) {
  const SubdivisionLattice line = test::prism(test::flower_section(5), 2);
  int n_line = 0;
  for (const VertexId vertex : line.complex->vertices()) {
    n_line += line_edges(*line.complex, vertex).has_value() ? 1 : 0;
  }
  EXPECT_EQ(n_line, 6);  // in the middle step: the centre, and five of valence 3 round it
  // Valences 3, 3, 4, 4, 5, 5 also make 8 hexahedra and 6 edges; a regular vertex is no line.
  const SubdivisionLattice grid = test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(line_edges(*grid.complex, VertexId{13}).has_value());
  const SubdivisionLattice plus = test::plus_of_cubes();
  for (const Refinement& level : refine(plus, 2)) {
    for (const VertexId vertex : level.complex->vertices()) {
      EXPECT_FALSE(line_edges(*level.complex, vertex).has_value());
    }
  }
}

TEST(Refined, carries_pose_and_sharpness_along) {
  SubdivisionLattice lattice = test::lattice_from(make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}));
  lattice.pose = lattice.rest;
  for (glm::dvec3& point : lattice.pose) {
    point = point * 2.0 + glm::dvec3(1, 0, 0);
  }
  const EdgeId edge = lattice.complex->find_edge(VertexId{0}, VertexId{1});
  lattice.sharpness.edges[edge] = 2.5f;
  const SubdivisionLattice fine = refined(lattice, 2);
  ASSERT_EQ(fine.complex->n_cells(), 64u);
  for (std::size_t i = 0; i < fine.rest.size(); ++i) {
    EXPECT_LT(glm::distance(fine.pose[i], fine.rest[i] * 2.0 + glm::dvec3(1, 0, 0)), 1e-14);
  }
  std::map<float, int> sharpness;
  for (const float s : fine.sharpness.edges) {
    ++sharpness[s];
  }
  EXPECT_EQ(sharpness, (std::map<float, int>{{0.0f, 300 - 48}, {0.5f, 4}, {10.0f, 44}}));
}

}  // namespace
}  // namespace espalier
