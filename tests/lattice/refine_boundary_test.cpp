/// The boundary of a refined lattice is OpenSubdiv's refinement of its boundary mesh.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>

#include "lattice/build/primitives.h"
#include "lattice/subdivision/refine.h"
#include "tests/support/families.h"
#include "tests/support/far_oracle.h"
#include "tests/support/refined_points.h"

namespace espalier {
namespace {

/// The boundary of a lattice as OpenSubdiv wants it.
struct BoundaryMesh {
  std::vector<VertexId> vertices;  // of the lattice, by vertex of the mesh
  CompressedRows<std::int32_t> faces;
  test::FarOracle::Creases creases;
};

BoundaryMesh boundary_mesh(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  BoundaryMesh mesh;
  std::map<VertexId, int> number;
  for (const VertexId vertex : complex.vertices()) {
    if (complex.is_boundary(vertex)) {
      number[vertex] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(vertex);
      mesh.creases.vertices.push_back(number[vertex]);
      mesh.creases.vertex_sharpness.push_back(lattice.sharpness.vertices[vertex]);
    }
  }
  for (const FaceId face : complex.faces()) {
    if (complex.is_boundary(face)) {
      std::vector<std::int32_t> loop;
      for (const VertexId vertex : complex.vertices(face)) {
        loop.push_back(number[vertex]);
      }
      if (complex.inner_half_face(face).side() == 1) {
        std::reverse(loop.begin(), loop.end());
      }
      mesh.faces.push_back(loop);
    }
  }
  for (const EdgeId edge : complex.edges()) {
    if (complex.is_boundary(edge) && lattice.sharpness.edges[edge] > 0) {
      const auto& ends = complex.vertices(edge);
      mesh.creases.edges.push_back({number[ends[0]], number[ends[1]]});
      mesh.creases.edge_sharpness.push_back(lattice.sharpness.edges[edge]);
    }
  }
  return mesh;
}

/// The largest distance between the lattice's refined boundary and OpenSubdiv's, over three levels.
double distance_to_opensubdiv(SubdivisionLattice lattice) {
  lattice.rest = test::jittered(std::move(lattice.rest), 0.2, 3);
  const BoundaryMesh mesh = boundary_mesh(lattice);
  const test::FarOracle oracle(static_cast<int>(mesh.vertices.size()), mesh.faces, mesh.creases, 3,
                               false);
  std::vector<VertexId> vertices = mesh.vertices;
  std::vector<glm::dvec3> expected;
  for (const VertexId vertex : vertices) {
    expected.push_back(lattice.rest[vertex.index()]);
  }
  std::vector<glm::dvec3> points = lattice.rest;
  double largest = 0;
  const CellComplex* coarse = lattice.complex.get();
  const std::vector<Refinement> levels = refine(lattice, 3);
  for (int level = 0; level < 3; ++level) {
    expected = oracle.interpolate(level + 1, expected);
    points = levels[static_cast<std::size_t>(level)].stencils.apply(points);
    std::vector<VertexId> refined(expected.size());
    for (const test::FarOracle::Element& element : oracle.elements(level)) {
      std::vector<VertexId> corners;
      for (const int vertex : element.vertices) {
        corners.push_back(vertices[static_cast<std::size_t>(vertex)]);
      }
      const auto found =
          test::refined_point(*coarse, levels[static_cast<std::size_t>(level)].parents, corners);
      EXPECT_TRUE(found.has_value());
      const auto at = static_cast<std::size_t>(element.refined_vertex);
      refined[at] = *found;
      largest = std::max(largest, glm::distance(points[found->index()], expected[at]));
    }
    vertices = std::move(refined);
    coarse = levels[static_cast<std::size_t>(level)].complex.get();
  }
  return largest;
}

TEST(RefineBoundary, equals_opensubdiv_in_every_family) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    EXPECT_LT(distance_to_opensubdiv(family.lattice), 1e-12) << family.name;
  }
}

TEST(RefineBoundary, equals_opensubdiv_with_creases_and_corners_of_any_sharpness) {
  for (const float sharpness : {0.5f, 1.5f, 2.0f, 10.0f}) {
    for (test::NamedLattice& family : test::lattice_families()) {
      SubdivisionLattice& lattice = family.lattice;
      lattice.sharpness = smooth_sharpness(*lattice.complex);
      int i = 0;
      for (const EdgeId edge : lattice.complex->edges()) {
        if (lattice.complex->is_boundary(edge) && ++i % 3 == 0) {
          lattice.sharpness.edges[edge] = sharpness;
        }
      }
      for (const VertexId vertex : lattice.complex->vertices()) {
        if (lattice.complex->is_boundary(vertex) && ++i % 5 == 0) {
          lattice.sharpness.vertices[vertex] = sharpness;
        }
      }
      EXPECT_LT(distance_to_opensubdiv(lattice), 1e-12) << family.name << " " << sharpness;
    }
  }
}

TEST(RefineBoundary, equals_opensubdiv_where_cells_only_touch) {
  EXPECT_LT(distance_to_opensubdiv(test::cubes_sharing_edge()), 1e-12);
  EXPECT_LT(distance_to_opensubdiv(test::cubes_sharing_vertex()), 1e-12);
}

TEST(RefineBoundary, of_a_single_cube_is_the_cube) {
  SubdivisionLattice cube = test::lattice_from(make_box({1, 1, 1}, {-1, -1, -1}, {1, 1, 1}));
  const SubdivisionLattice fine = refined(cube, 3);
  for (const VertexId vertex : fine.complex->vertices()) {
    const glm::dvec3 p = glm::abs(fine.rest[vertex.index()]);
    const double farthest = std::max({p.x, p.y, p.z});
    if (fine.complex->is_boundary(vertex)) {
      EXPECT_EQ(farthest, 1.0);
    } else {
      EXPECT_LT(farthest, 1.0);
    }
  }
}

}  // namespace
}  // namespace espalier
