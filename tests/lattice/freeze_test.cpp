#include "lattice/subdivision/freeze.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/refine.h"
#include "lattice/topology/hexahedron.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

TEST(FreezeUniform, makes_one_patch_a_hexahedron_and_2n_pyramids_a_type_n_cell) {
  const Volume cube =
      freeze_uniform(test::lattice_from(make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1})), 2);
  EXPECT_EQ(cube.n_patches(), 64u);
  // 12 hexahedra and one type-4 cell after one step; it becomes two of type 4 and six hexahedra.
  const Volume pyramid = freeze_uniform(test::pyramid_on_cube(), 2);
  EXPECT_EQ(pyramid.n_patches(), 12u * 8 + 6 + 2 * 8 + 2);
  std::size_t n_pyramids = 0;
  for (std::size_t i = 0; i < pyramid.n_patches(); ++i) {
    n_pyramids += pyramid.patch(i).is_pyramid ? 1 : 0;
  }
  EXPECT_EQ(n_pyramids % 8, 0u);
  EXPECT_GT(n_pyramids, 0u);
}

TEST(FreezeUniform, fills_exactly_the_volume_of_the_refined_cells) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const SubdivisionLattice fine = refined(family.lattice, 2);
    double volume_of_cells = 0;
    const Polyhedra tables = fine.complex->polyhedra();
    for (std::size_t cell = 0; cell < tables.cells.n_rows(); ++cell) {
      volume_of_cells += signed_volume(tables, cell, fine.rest);
    }
    // The determinant of a trilinear map is a polynomial of degree 2 per axis (4 for a pyramid's,
    // with its factor (1 − w)²): three Gauss points integrate it exactly.
    const Volume volume = freeze_uniform(family.lattice, 2);
    const double offset = std::sqrt(0.15);
    const std::array<double, 3> nodes = {0.5 - offset, 0.5, 0.5 + offset};
    const std::array<double, 3> weights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double volume_of_patches = 0;
    for (std::size_t i = 0; i < volume.n_patches(); ++i) {
      const BezierPatch map = volume.bezier(i, volume.rest_points());
      for (std::size_t c = 0; c < 27; ++c) {
        const glm::dvec3 uvw(nodes[c % 3], nodes[c / 3 % 3], nodes[c / 9]);
        const double factor = map.is_pyramid ? (1 - uvw.z) * (1 - uvw.z) : 1;
        const double det = glm::determinant(map.derivative(uvw)) * factor;
        EXPECT_GT(det, 0) << family.name;
        volume_of_patches += weights[c % 3] * weights[c / 3 % 3] * weights[c / 9] * det;
      }
    }
    // Bilinear faces and fans round centroids enclose the same volume.
    EXPECT_NEAR(volume_of_patches, volume_of_cells, 1e-12 * volume_of_cells) << family.name;
  }
}

TEST(FreezeUniform, marks_the_faces_on_the_boundary) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const SubdivisionLattice fine = refined(family.lattice, 2);
    std::size_t n_boundary = 0;
    for (const FaceId face : fine.complex->faces()) {
      n_boundary += fine.complex->is_boundary(face) ? 1 : 0;
    }
    const Volume volume = freeze_uniform(family.lattice, 2);
    std::size_t n_marked = 0;
    for (std::size_t i = 0; i < volume.n_patches(); ++i) {
      n_marked += static_cast<std::size_t>(__builtin_popcount(volume.patch(i).boundary_faces));
    }
    EXPECT_EQ(n_marked, n_boundary) << family.name;
  }
}

TEST(FreezeUniform, points_are_those_of_explicit_refinement) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    SubdivisionLattice posed = family.lattice;
    posed.rest = test::jittered(posed.rest, 0.1, 3);
    const Volume volume = freeze_uniform(family.lattice, 3);
    const std::vector<glm::dvec3> points = volume.points(posed.rest);
    const std::vector<glm::dvec3> expected = refined(posed, 3).rest;
    ASSERT_GE(points.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_LT(glm::distance(points[i], expected[i]), 1e-14) << family.name;
    }
  }
}

TEST(FreezeUniform, refuses_levels_out_of_range) {
  const SubdivisionLattice cube = test::lattice_from(make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW((void)freeze_uniform(cube, 0), ParameterError);
  EXPECT_THROW((void)freeze_uniform(cube, 9), ParameterError);
}

TEST(Hexahedron, corners_span_a_positive_cube_in_index_order) {
  const SubdivisionLattice box = test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {2, 2, 2}));
  for (const CellId cell : box.complex->cells()) {
    const auto found = hexahedron(*box.complex, cell);
    ASSERT_TRUE(found.has_value());
    const auto at = [&](std::size_t c) { return box.rest[found->corners[c].index()]; };
    const glm::dmat3 axes(at(1) - at(0), at(2) - at(0), at(4) - at(0));
    EXPECT_EQ(glm::determinant(axes), 1.0);
    for (std::size_t c = 0; c < 8; ++c) {
      EXPECT_EQ(at(c), at(0) + axes * glm::dvec3(c % 2, c / 2 % 2, c / 4));
    }
  }
}

TEST(Hexahedron, is_not_a_cell_with_other_faces) {
  const SubdivisionLattice lattice = test::pyramid_on_cube();
  EXPECT_TRUE(hexahedron(*lattice.complex, CellId{0}).has_value());
  EXPECT_FALSE(hexahedron(*lattice.complex, CellId{1}).has_value());
  const SubdivisionLattice wedge = test::prism(test::wheel_section(3), 1);
  EXPECT_FALSE(hexahedron(*wedge.complex, CellId{0}).has_value());
}

}  // namespace
}  // namespace espalier
