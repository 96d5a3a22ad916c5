/// What a grid's elements have of a surface.

#include "deform/fit/element_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "deform/fit/surface_triangles.h"
#include "tests/deform/surfaces.h"

namespace espalier {
namespace {

TEST(SurfaceTriangles, cover_faces_and_stray_points) {
  test::Surface box = test::box_surface({0, 0, 0}, {1, 2, 3});
  box.points.emplace_back(7, 7, 7);
  const auto triangles = surface_triangles(box.points, box.faces);
  double area = 0;
  for (const Triangle& t : triangles) {
    area += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
  }
  EXPECT_NEAR(area, 2 * (2 + 3 + 6), 1e-14);
  EXPECT_EQ(triangles.back(), (Triangle{glm::dvec3(7), glm::dvec3(7), glm::dvec3(7)}));
}

TEST(SurfaceTriangles, wind_once_round_what_they_enclose) {
  const test::Surface ball = test::sphere_surface({1, 0, 0}, 2, 8);
  const auto triangles = surface_triangles(ball.points, ball.faces);
  EXPECT_NEAR(winding_number({1.3, 0.2, -0.4}, triangles), 1, 1e-12);
  EXPECT_NEAR(winding_number({4, 0.2, -0.4}, triangles), 0, 1e-12);
  const test::Surface box = test::box_surface({0, 0, 0}, {1, 1, 1});
  // The middle of a cube sees each face under a sixth of the sphere.
  const auto sides = surface_triangles(box.points, box.faces);
  EXPECT_NEAR(winding_number(glm::dvec3(0.5), std::span(sides).first(sides.size() / 6)), 1.0 / 6,
              1e-12);
}

TEST(SurfaceTriangles, overlap_boxes_they_share_a_point_with) {
  const Triangle slanted = {glm::dvec3(3, 0, 0), glm::dvec3(0, 3, 0), glm::dvec3(0, 0, 3)};
  EXPECT_TRUE(overlaps(slanted, {0, 0, 0}, {1, 1, 1}));  // touches in one corner
  EXPECT_FALSE(overlaps(slanted, {0, 0, 0}, {0.99, 0.99, 0.99}));
  EXPECT_TRUE(overlaps(slanted, {0.5, 0.5, 0.5}, {4, 4, 4}));
  EXPECT_FALSE(overlaps(slanted, {1.01, 1.01, 1.01}, {4, 4, 4}));
  // Its box overlaps, its edge passes the box's edge.
  const Triangle thin = {glm::dvec3(0, 2.1, 0), glm::dvec3(2.1, 0, 0), glm::dvec3(2.1, 0.1, 0)};
  EXPECT_FALSE(overlaps(thin, {0, 0, -1}, {1, 1, 1}));
  const Triangle point = {glm::dvec3(1), glm::dvec3(1), glm::dvec3(1)};
  EXPECT_TRUE(overlaps(point, {1, 1, 1}, {2, 2, 2}));
  EXPECT_FALSE(overlaps(point, {1.1, 1, 1}, {2, 2, 2}));
}

TEST(ElementGrid, numbers_elements_by_their_doubled_places) {
  const GridFrame frame{{1, 2, 3}, 0.5, {2, 3, 4}};
  EXPECT_EQ(frame.n_elements(), 5u * 7 * 9);
  for (const std::size_t i : {0u, 17u, 200u, 314u}) {
    EXPECT_EQ(frame.index(frame.place(i)), i);
  }
  EXPECT_EQ(frame.center({0, 0, 0}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(frame.center({1, 2, 3}), glm::dvec3(1.25, 2.5, 3.75));
  EXPECT_EQ(frame.cell_at({1.6, 2.1, 4.9}), (ElementPlace{3, 1, 7}));
  EXPECT_EQ(frame.cell_at({-9, 99, 3}), (ElementPlace{1, 5, 1}));
}

TEST(ElementGrid, tells_touched_from_inside_and_outside) {
  const test::Surface box = test::box_surface({1.5, 1.5, 1.5}, {5.5, 5.5, 5.5});
  const auto triangles = surface_triangles(box.points, box.faces);
  const GridFrame frame{{0, 0, 0}, 1, {7, 7, 7}};
  const ElementGrid grid = classify_elements(frame, triangles, true, 0.1);
  for (int x = 0; x < 7; ++x) {
    const std::size_t cell = frame.index({2 * x + 1, 7, 7});
    EXPECT_EQ(grid.is_touched[cell] != 0, x == 1 || x == 5) << x;
    EXPECT_EQ(grid.is_inside[cell] != 0, x > 1 && x < 5) << x;
  }
  // The node at (2, 3, 3) is half a step inside.
  EXPECT_EQ(grid.is_inside[frame.index({4, 6, 6})], 1);
  EXPECT_EQ(grid.is_touched[frame.index({3, 6, 6})], 1);
  EXPECT_EQ(classify_elements(frame, triangles, true, 0.6).is_touched[frame.index({4, 6, 6})], 1);
}

}  // namespace
}  // namespace espalier
