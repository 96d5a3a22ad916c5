#include "lattice/subdivision/subdivision_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "lattice/core/error.h"
#include "lattice/subdivision/refine.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

using Indices = std::vector<std::int32_t>;

Indices boundary_faces(const CellComplex& complex) {
  Indices faces;
  for (const FaceId face : complex.faces()) {
    if (complex.is_boundary(face)) {
      faces.push_back(face.value);
    }
  }
  return faces;
}

TEST(SubdivisionBoundary, is_the_boundary_of_the_lattice_refined_twice) {
  for (const auto& [name, lattice] : test::lattice_families()) {
    if (lattice.complex->n_cells() > 20) {
      continue;  // quickness
    }
    const BoundarySurface surface = boundary_surface(lattice);
    const std::vector<glm::dvec3> points = surface.points.apply(lattice.rest);
    const SubdivisionLattice fine = refined(lattice, 2);
    const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
      return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
    };
    // As sets of face centroids, rounded: the two number their elements in different orders.
    const auto rounded = [](const glm::dvec3& x) { return glm::round(x * 1e6); };
    std::vector<glm::dvec3> ours;
    for (std::size_t quad = 0; quad < surface.quads.n_rows(); ++quad) {
      glm::dvec3 sum(1e-7);
      for (const std::int32_t point : surface.quads[quad]) {
        sum += points[static_cast<std::size_t>(point)];
      }
      ours.push_back(rounded(sum));
    }
    std::vector<glm::dvec3> expected;
    for (const std::int32_t face : boundary_faces(*fine.complex)) {
      glm::dvec3 sum(1e-7);
      for (const VertexId vertex : fine.complex->vertices(FaceId{face})) {
        sum += fine.rest[vertex.index()];
      }
      expected.push_back(rounded(sum));
    }
    std::ranges::sort(ours, before);
    std::ranges::sort(expected, before);
    EXPECT_EQ(ours, expected) << name;
  }
}

TEST(SubdivisionBoundary, belongs_to_each_boundary_face_and_to_no_other) {
  for (const auto& [name, lattice] : test::lattice_families()) {
    const BoundarySurface surface = boundary_surface(lattice);
    ASSERT_EQ(surface.faces.size(), surface.quads.n_rows());
    Indices faces = surface.faces;
    std::ranges::sort(faces);
    const auto duplicates = std::ranges::unique(faces);
    faces.erase(duplicates.begin(), duplicates.end());
    EXPECT_EQ(faces, boundary_faces(*lattice.complex)) << name;
    for (const std::int32_t face : faces) {
      const std::size_t n_corners = lattice.complex->vertices(FaceId{face}).size();
      EXPECT_EQ(std::ranges::count(surface.faces, face), 4 * n_corners) << name;
    }
  }
}

/// The control points that the boundary depends on where it lies on each face, after `levels`
/// refinements of the lattice and those of boundary_surface().
std::vector<std::set<std::int32_t>> controls_seen_on_faces(const SubdivisionLattice& lattice,
                                                           int levels) {
  SubdivisionLattice fine = lattice;
  std::vector<std::int32_t> root(lattice.complex->n_faces());
  std::iota(root.begin(), root.end(), 0);
  std::vector<Refinement> refinements = refine(lattice, levels);
  StencilTable stencils = refinements[0].stencils;
  for (std::size_t i = 0; i < refinements.size(); ++i) {
    fine.complex = refinements[i].complex;
    fine.sharpness = refinements[i].sharpness;
    stencils = i == 0 ? stencils : compose(stencils, refinements[i].stencils);
    std::vector<std::int32_t> next(fine.complex->n_faces(), -1);
    for (const FaceId face : fine.complex->faces()) {
      const Parent parent = refinements[i].parents.parent(face);
      if (parent.kind == Parent::Kind::Face) {
        next[face.index()] = root[static_cast<std::size_t>(parent.index)];
      }
    }
    root = std::move(next);
  }
  const BoundarySurface surface = boundary_surface(fine);
  const StencilTable points = compose(stencils, surface.points);
  std::vector<std::set<std::int32_t>> seen(lattice.complex->n_faces());
  for (std::size_t quad = 0; quad < surface.faces.size(); ++quad) {
    auto& controls =
        seen[static_cast<std::size_t>(root[static_cast<std::size_t>(surface.faces[quad])])];
    for (const std::int32_t point : surface.quads[quad]) {
      const auto indices = points[static_cast<std::size_t>(point)].indices;
      controls.insert(indices.begin(), indices.end());
    }
  }
  return seen;
}

TEST(UnmovedControls, for_C0_are_those_that_the_boundary_depends_on_at_the_face) {
  for (const auto& [name, lattice] : test::lattice_families()) {
    if (lattice.complex->n_cells() > 20) {
      continue;  // quickness
    }
    const auto seen = controls_seen_on_faces(lattice, 2);
    for (const std::int32_t face : boundary_faces(*lattice.complex)) {
      const auto& expected = seen[static_cast<std::size_t>(face)];
      EXPECT_EQ(unmoved_controls(lattice, {&face, 1}, Continuity::C0),
                Indices(expected.begin(), expected.end()))
          << name << " face " << face;
    }
  }
}

TEST(UnmovedControls, of_a_creased_side_are_its_layers) {
  // 3 × 3 × 4 vertices; face 0 to 3 of the bottom are found by their vertices.
  const SubdivisionLattice lattice = test::prism(test::grid_section(2, 2), 3);
  Indices bottom;
  for (const std::int32_t face : boundary_faces(*lattice.complex)) {
    const auto corners = lattice.complex->vertices(FaceId{face});
    if (std::ranges::all_of(corners, [](VertexId vertex) { return vertex.value < 9; })) {
      bottom.push_back(face);
    }
  }
  ASSERT_EQ(bottom.size(), 4u);
  Indices layers(9);
  std::iota(layers.begin(), layers.end(), 0);
  EXPECT_EQ(unmoved_controls(lattice, bottom, Continuity::C0), layers);
  layers.resize(18);
  std::iota(layers.begin(), layers.end(), 0);
  EXPECT_EQ(unmoved_controls(lattice, bottom, Continuity::C1), layers);
  EXPECT_EQ(unmoved_controls(lattice, bottom, Continuity::C2), layers);
}

/// Whether a refined face lies in one of some coarse ones.
std::set<std::int32_t> refined_faces(const Refinement& level, const std::set<std::int32_t>& faces) {
  std::set<std::int32_t> result;
  for (const FaceId face : level.complex->faces()) {
    const Parent parent = level.parents.parent(face);
    if (parent.kind == Parent::Kind::Face && faces.contains(parent.index)) {
      result.insert(face.value);
    }
  }
  return result;
}

std::set<std::int32_t> vertices_of_cells_at(const CellComplex& complex,
                                            const std::set<std::int32_t>& vertices) {
  std::set<std::int32_t> result;
  for (const std::int32_t vertex : vertices) {
    for (const CellId cell : complex.cells(VertexId{vertex})) {
      for (const VertexId corner : complex.vertices(cell)) {
        result.insert(corner.value);
      }
    }
  }
  return result;
}

double largest_move(const std::vector<glm::dvec3>& moves, const std::set<std::int32_t>& vertices) {
  double largest = 0;
  for (const std::int32_t vertex : vertices) {
    largest = std::max(largest, glm::length(moves[static_cast<std::size_t>(vertex)]));
  }
  return largest;
}

TEST(UnmovedControls, keep_the_first_cells_still_and_let_the_next_move_ever_less_on_all_levels) {
  // A motion that grows as t³/6 falls by 8 a level; by more than 6 it is of less than second order
  // in the distance even where that falls by 2.4, beside lines of valence 3.
  for (const auto& [name, coarse] : test::lattice_families()) {
    const SubdivisionLattice lattice = refined(coarse, 1);  // so that something is left to move
    const Indices faces = boundary_faces(*lattice.complex);
    if (lattice.complex->n_cells() > 100) {
      continue;  // quickness: smaller families have the same irregular spots
    }
    for (std::size_t i = 0; i < faces.size(); i += faces.size() / 3 + 1) {
      const Indices still = unmoved_controls(lattice, {&faces[i], 1}, Continuity::C2);
      std::vector<glm::dvec3> moves =
          test::jittered(std::vector<glm::dvec3>(lattice.rest.size(), glm::dvec3(0)), 1, 7);
      for (const std::int32_t control : still) {
        moves[static_cast<std::size_t>(control)] = glm::dvec3(0);
      }
      std::set<std::int32_t> locked = {faces[i]};
      double before = 0;
      for (const Refinement& level : refine(lattice, 2)) {
        moves = level.stencils.apply(moves);
        locked = refined_faces(level, locked);
        std::set<std::int32_t> border;
        for (const std::int32_t face : locked) {
          for (const VertexId vertex : level.complex->vertices(FaceId{face})) {
            border.insert(vertex.value);
          }
        }
        const auto first = vertices_of_cells_at(*level.complex, border);
        EXPECT_EQ(largest_move(moves, first), 0) << name << " face " << faces[i];
        const double now = largest_move(moves, vertices_of_cells_at(*level.complex, first));
        EXPECT_GT(now, 0) << name << " face " << faces[i];
        if (before > 0) {
          EXPECT_LT(now, before / 6) << name << " face " << faces[i];
        }
        before = now;
      }
    }
  }
}

TEST(UnmovedControls, refuses_faces_that_are_not_on_the_boundary) {
  const SubdivisionLattice lattice = test::prism(test::grid_section(2, 1), 1);
  const auto error = [&](std::int32_t face) -> std::string {
    try {
      (void)unmoved_controls(lattice, {&face, 1}, Continuity::C1);
    } catch (const ParameterError& caught) {
      return caught.what();
    }
    return "no error";
  };
  EXPECT_EQ(error(11), "face 11 does not exist: the lattice has 11");
  EXPECT_EQ(error(-1), "face -1 does not exist: the lattice has 11");
  std::int32_t inner = 0;
  while (lattice.complex->is_boundary(FaceId{inner})) {
    ++inner;
  }
  EXPECT_EQ(error(inner), "face " + std::to_string(inner) +
                              " lies between two cells: only boundary faces can be locked");
}

}  // namespace
}  // namespace espalier
