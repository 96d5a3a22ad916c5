#include "deform/model/volume_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace espalier {
namespace {

using Faces = CompressedRows<std::int32_t>;

std::vector<glm::dvec3> cube_points() {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i) {
    points.emplace_back(i % 2, i / 2 % 2, i / 4);
  }
  return points;
}

Faces cube_faces() {
  Faces faces;
  for (const std::array<std::int32_t, 4>& loop :
       {std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}}) {
    faces.push_back(loop);
  }
  return faces;
}

template <class Map>
std::vector<glm::dvec3> mapped(std::vector<glm::dvec3> points, const Map& map) {
  for (glm::dvec3& point : points) {
    point = map(point);
  }
  return points;
}

TEST(VolumeChange, a_cube_has_the_volume_of_its_edges_wherever_it_is) {
  const auto far =
      mapped(cube_points(), [](auto& p) { return 3.0 * p + glm::dvec3(1e6, 0, -1e6); });
  EXPECT_DOUBLE_EQ(signed_volume(cube_points(), cube_faces()), 1);
  EXPECT_NEAR(signed_volume(far, cube_faces()), 27, 1e-8);
  const auto mirrored = mapped(cube_points(), [](auto& p) { return glm::dvec3(-p.x, p.y, p.z); });
  EXPECT_DOUBLE_EQ(signed_volume(mirrored, cube_faces()), -1);
}

TEST(VolumeChange, an_affine_map_changes_the_volume_by_its_determinant) {
  const glm::dmat3 A(1.5, 0.25, -0.125, 0.5, 0.75, 0.375, -0.25, 0.125, 1.25);
  const auto after = mapped(cube_points(), [&](auto& p) { return A * p + glm::dvec3(5, 6, 7); });
  EXPECT_NEAR(volume_change(cube_points(), after, cube_faces()).value(),
              100 * (glm::determinant(A) - 1), 1e-11);
  EXPECT_EQ(volume_change(cube_points(), cube_points(), cube_faces()).value(), 0);
}

TEST(VolumeChange, faces_are_closed_if_every_edge_runs_both_ways_wherever_its_points_are_listed) {
  std::vector<glm::dvec3> points = cube_points();
  EXPECT_TRUE(is_closed(points, cube_faces()));
  points.push_back(points[0]);
  Faces split = cube_faces();
  split[0][0] = 8;
  EXPECT_TRUE(is_closed(points, split));
  EXPECT_EQ(volume_change(points, mapped(points, [](auto& p) { return 2.0 * p; }), split), 700);
  points[8].x -= 0.1;
  EXPECT_FALSE(is_closed(points, split));
}

TEST(VolumeChange, what_is_open_or_twisted_or_flat_encloses_nothing) {
  Faces open;
  Faces twisted;
  const Faces cube = cube_faces();
  for (std::size_t f = 0; f < 6; ++f) {
    std::vector<std::int32_t> loop(cube[f].begin(), cube[f].end());
    if (f > 0) {
      open.push_back(loop);
    } else {
      std::reverse(loop.begin(), loop.end());
    }
    twisted.push_back(loop);
  }
  EXPECT_FALSE(volume_change(cube_points(), cube_points(), open).has_value());
  EXPECT_FALSE(volume_change(cube_points(), cube_points(), twisted).has_value());
  EXPECT_FALSE(volume_change(cube_points(), cube_points(), Faces()).has_value());
  const auto flat = mapped(cube_points(), [](auto& p) { return glm::dvec3(p.x, p.y, 0); });
  EXPECT_FALSE(volume_change(flat, cube_points(), cube).has_value());
}

}  // namespace
}  // namespace espalier
