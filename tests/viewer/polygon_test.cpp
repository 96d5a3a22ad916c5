#include "viewer/render/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace espalier::viewer {
namespace {

using Loop = std::vector<glm::dvec3>;

/// A loop in the plane, put into space so that no axis is special.
Loop tilted(const std::vector<glm::dvec2>& flat) {
  const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, -1));
  const glm::dvec3 v = glm::normalize(glm::cross(glm::dvec3(0.3, -1, 0.5), u));
  Loop loop;
  for (const glm::dvec2& p : flat) {
    loop.push_back(glm::dvec3(5, -7, 2) + p.x * u + p.y * v);
  }
  return loop;
}

/// The triangles turn as the loop does and cover its area exactly once.
void expect_covers(const Loop& loop) {
  std::vector<std::uint32_t> triangles;
  triangulate(loop, triangles);
  ASSERT_EQ(triangles.size(), 3 * (loop.size() - 2));
  const glm::dvec3 normal = glm::normalize(area_vector(loop));
  double area = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const glm::dvec3& a = loop[triangles[i]];
    const double part =
        glm::dot(glm::cross(loop[triangles[i + 1]] - a, loop[triangles[i + 2]] - a), normal);
    EXPECT_GE(part, -1e-12);
    area += part;
  }
  EXPECT_NEAR(area, glm::length(area_vector(loop)), 1e-9);
}

TEST(AreaVector, is_the_normal_times_twice_the_area) {
  const Loop square{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}};
  EXPECT_EQ(area_vector(square), glm::dvec3(0, 0, 12));
  EXPECT_EQ(area_vector(Loop{{1, 1, 1}, {2, 2, 2}}), glm::dvec3(0, 0, 0));
}

TEST(Triangulate, covers_convex_polygons_once) {
  for (int n = 3; n < 40; ++n) {
    std::vector<glm::dvec2> flat;
    for (int i = 0; i < n; ++i) {
      flat.emplace_back(std::cos(2 * M_PI * i / n), 2 * std::sin(2 * M_PI * i / n));
    }
    expect_covers(tilted(flat));
  }
}

TEST(Triangulate, covers_concave_polygons_once_wherever_the_loop_starts) {
  const std::vector<std::vector<glm::dvec2>> shapes{
      {{0, 0}, {2, 1}, {0, 2}, {0.5, 1}},                                // dart
      {{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}},  // U
      {{0, 0}, {1, 3}, {2, 0}, {3, 3}, {4, 0}, {4, 5}, {0, 5}},          // comb
      {{0, 0},
       {5, 0},
       {5, 5},
       {1, 5},
       {1, 2},
       {3, 2},
       {3, 3},
       {2, 3},
       {2, 4},  // spiral
       {4, 4},
       {4, 1},
       {0, 1}},
      {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}},  // corners in a line
  };
  for (const std::vector<glm::dvec2>& shape : shapes) {
    for (std::size_t start = 0; start < shape.size(); ++start) {
      std::vector<glm::dvec2> turned(shape.begin() + static_cast<std::ptrdiff_t>(start),
                                     shape.end());
      turned.insert(turned.end(), shape.begin(),
                    shape.begin() + static_cast<std::ptrdiff_t>(start));
      expect_covers(tilted(turned));
      std::reverse(turned.begin(), turned.end());
      expect_covers(tilted(turned));
    }
  }
}

TEST(Triangulate, covers_a_star_of_a_thousand_corners_once) {
  std::vector<glm::dvec2> flat;
  for (int i = 0; i < 1000; ++i) {
    const double radius = i % 2 == 0 ? 1 : 0.4;
    flat.emplace_back(radius * std::cos(2 * M_PI * i / 1000),
                      radius * std::sin(2 * M_PI * i / 1000));
  }
  expect_covers(tilted(flat));
}

TEST(Triangulate, gives_a_full_set_of_triangles_for_loops_without_area) {
  for (const Loop& loop :
       {Loop(6, {1, 1, 1}), Loop{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
        Loop{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 2, 0}}}) {
    std::vector<std::uint32_t> triangles;
    triangulate(loop, triangles);
    EXPECT_EQ(triangles.size(), 3 * (loop.size() - 2));
    for (const std::uint32_t corner : triangles) {
      EXPECT_LT(corner, loop.size());
    }
  }
}

TEST(Triangulate, adds_nothing_for_less_than_a_triangle) {
  std::vector<std::uint32_t> triangles;
  triangulate(Loop{{0, 0, 0}, {1, 0, 0}}, triangles);
  EXPECT_TRUE(triangles.empty());
}

}  // namespace
}  // namespace espalier::viewer
