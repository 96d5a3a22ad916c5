#include "deform/embed/crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/subdivision/subdivision_boundary.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// The crossings of a model's edges with a lattice, bound as embed() does it.
Crossings crossings_of(const SubdivisionLattice& lattice, const std::vector<glm::dvec3>& points,
                       const CompressedRows<std::int32_t>& faces) {
  const Binding binding = embed(freeze_adaptive(lattice), points);
  return find_crossings(boundary_surface(lattice), lattice.rest, points, faces, binding.status);
}

/// The mean of the vertices of a lattice's face.
glm::dvec3 centroid(const SubdivisionLattice& lattice, std::int32_t face) {
  const auto vertices = lattice.complex->vertices(FaceId{face});
  glm::dvec3 sum(0);
  for (const VertexId vertex : vertices) {
    sum += lattice.rest[vertex.index()];
  }
  return sum / static_cast<double>(vertices.size());
}

TEST(Crossings, are_where_edges_leave_a_box_and_name_its_face) {
  const SubdivisionLattice box = test::prism(test::grid_section(2, 2), 2);
  // One point inside, one below, one beyond the side x = 2, one on the border.
  const std::vector<glm::dvec3> points = {
      {0.5, 1.25, 0.5}, {0.5, 1.75, -0.5}, {3.5, 1.25, 0.5}, {2, 0.5, 0.25}};
  const Crossings crossings = crossings_of(box, points, {{0, 1, 2}, {1, 2, 3}});
  // Edges 0-1 and 2-0 of face 0, edges 2-3 and 3-1 of face 1; both ends of 1-2 are outside.
  const std::vector<glm::dvec3> places = crossings.points.apply(box.rest);
  const std::vector<glm::dvec3> expected = {
      {0.5, 1.5, 0}, {2, 1.25, 0.5}, {2, 0.5, 0.25}, {2, 0.5, 0.25}};
  const std::vector<glm::dvec3> centroids = {
      {0.5, 1.5, 0}, {2, 1.5, 0.5}, {2, 0.5, 0.5}, {2, 0.5, 0.5}};
  const std::vector<std::int32_t> held = {0, 0, 3, 3};
  ASSERT_EQ(crossings.edges.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(crossings.edges[i].face, i < 2 ? 0 : 1);
    EXPECT_EQ(crossings.edges[i].held, held[i]);
    EXPECT_LT(glm::distance(places[i], expected[i]), 1e-14) << i;
    EXPECT_LT(glm::distance(centroid(box, crossings.edges[i].boundary_face), centroids[i]), 1e-14)
        << i;
  }
}

TEST(Crossings, are_the_first_where_an_edge_leaves_and_enters_again) {
  // An L, [0,4]² without [2,4]²: the edge leaves its upper arm near (2, 2.5), where the concave
  // corner rounds it, and goes on through the lower arm, which it leaves at (4, 0.5).
  const SubdivisionLattice lattice = test::prism(test::l_section(), 1);
  const std::vector<glm::dvec3> points = {{1, 3.5, 0.5}, {5, -0.5, 0.5}, {5, 9, 0.5}};
  const Crossings crossings = crossings_of(lattice, points, {{0, 1, 2}});
  ASSERT_EQ(crossings.edges.size(), 2u);
  const std::vector<glm::dvec3> places = crossings.points.apply(lattice.rest);
  EXPECT_LT(glm::distance(places[0], {2, 2.5, 0.5}), 0.2);
  EXPECT_NEAR(places[0].x + places[0].y, 4.5, 1e-14);
  EXPECT_LT(glm::distance(places[1], {15.0 / 11, 4, 0.5}), 1e-14);
}

TEST(Crossings, lie_on_the_face_that_the_point_was_pushed_out_of_in_every_lattice) {
  for (const auto& [name, lattice] : test::lattice_families()) {
    if (lattice.complex->n_cells() > 20) {
      continue;  // quickness
    }
    const BoundarySurface surface = boundary_surface(lattice);
    const std::vector<glm::dvec3> at = surface.points.apply(lattice.rest);
    const double step = 0.02 * box_of(lattice.rest).radius();
    std::vector<glm::dvec3> points;
    CompressedRows<std::int32_t> faces;
    std::vector<std::int32_t> expected;
    for (std::size_t quad = 0; quad < surface.quads.n_rows(); quad += 3) {
      std::array<glm::dvec3, 4> corners;
      for (std::size_t i = 0; i < 4; ++i) {
        corners[i] = at[static_cast<std::size_t>(surface.quads[quad][i])];
      }
      const glm::dvec3 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
      const glm::dvec3 out =
          step * glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
      const auto first = static_cast<std::int32_t>(points.size());
      points.insert(points.end(), {middle - out, middle + out, middle + 1.01 * out});
      faces.push_back(std::vector{first, first + 1, first + 2});
      expected.push_back(surface.faces[quad]);
    }
    std::vector<PointStatus> status(points.size(), PointStatus::Outside);
    for (std::size_t i = 0; i < status.size(); i += 3) {
      status[i] = PointStatus::Inside;
    }
    const Crossings crossings = find_crossings(surface, lattice.rest, points, faces, status);
    EXPECT_EQ(crossings.edges.size(), 2 * expected.size()) << name;
    for (const Crossing& crossing : crossings.edges) {
      EXPECT_EQ(crossing.boundary_face, expected[static_cast<std::size_t>(crossing.face)]) << name;
    }
  }
}

TEST(Crossings, are_none_for_a_model_inside_or_outside) {
  const SubdivisionLattice box = test::prism(test::grid_section(1, 1), 1);
  const std::vector<glm::dvec3> points = {{0.2, 0.2, 0.2}, {0.8, 0.2, 0.2}, {0.2, 0.8, 0.2},
                                          {5, 5, 5},       {6, 5, 5},       {5, 6, 5}};
  const Crossings crossings = crossings_of(box, points, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_TRUE(crossings.edges.empty());
  EXPECT_EQ(crossings.points.n_rows(), 0u);
}

TEST(Crossings, are_the_same_for_any_number_of_threads) {
  const SubdivisionLattice lattice = test::prism(test::wheel_section(5), 2);
  std::vector<glm::dvec3> points;
  CompressedRows<std::int32_t> faces;
  for (int i = 0; i < 3000; ++i) {
    const auto first = static_cast<std::int32_t>(points.size());
    const glm::dvec3 inside = {0.0001 * i, 0.05, 0.5};
    points.insert(points.end(),
                  {inside, inside + glm::dvec3(0, 0, 3), inside + glm::dvec3(9, 0, 3)});
    faces.push_back(std::vector{first, first + 1, first + 2});
  }
  set_thread_count(1);
  const Crossings one = crossings_of(lattice, points, faces);
  set_thread_count(4);
  const Crossings four = crossings_of(lattice, points, faces);
  set_thread_count(0);
  EXPECT_EQ(one.points.apply(lattice.rest), four.points.apply(lattice.rest));
  ASSERT_EQ(one.edges.size(), four.edges.size());
  for (std::size_t i = 0; i < one.edges.size(); ++i) {
    EXPECT_EQ(one.edges[i].boundary_face, four.edges[i].boundary_face);
  }
}

}  // namespace
}  // namespace espalier
