#include "lattice/osd/refine_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace espalier::osd {
namespace {

/// Two quadrilaterals side by side with a seam of values between, and a point of no face.
SurfaceValues two_quadrilaterals() {
  SurfaceValues surface;
  surface.points = {{0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  surface.n_extras = 2;
  for (const glm::dvec3& p : surface.points) {
    surface.extras.insert(surface.extras.end(), {p.x, 5 * p.y});
  }
  surface.faces = {{0, 1, 5, 4}, {1, 3, 6, 5}};
  CornerValues values;
  values.values = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                   {5, 5, 0}, {6, 5, 0}, {6, 6, 0}, {5, 6, 0}};
  values.of_corners = {0, 1, 2, 3, 4, 5, 6, 7};
  surface.channels = {values};
  return surface;
}

TEST(RefineValues, keeps_seams_and_interpolates_linearly) {
  const SurfaceValues refined = refine_values(two_quadrilaterals(), SurfaceScheme::CatmullClark);
  ASSERT_EQ(refined.faces.n_rows(), 8u);
  EXPECT_EQ(refined.parents, (std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  std::size_t corner = 0;
  for (std::size_t face = 0; face < 8; ++face) {
    for (const std::int32_t point : refined.faces[face]) {
      const glm::dvec3& p = refined.points[static_cast<std::size_t>(point)];
      const auto number = static_cast<std::size_t>(refined.channels[0].of_corners[corner++]);
      const glm::dvec3 expected = face < 4 ? p : p + glm::dvec3(4, 5, 0);  // p.x from 1
      EXPECT_LT(glm::distance(refined.channels[0].values[number], expected), 1e-15);
      EXPECT_EQ(refined.extras[2 * static_cast<std::size_t>(point)], p.x);
      EXPECT_EQ(refined.extras[2 * static_cast<std::size_t>(point) + 1], 5 * p.y);
    }
  }
}

TEST(RefineValues, keeps_the_numbers_of_what_was_there) {
  const SurfaceValues before = two_quadrilaterals();
  const SurfaceValues refined = refine_values(before, SurfaceScheme::CatmullClark);
  ASSERT_EQ(refined.points.size(), before.points.size() + 9);
  EXPECT_TRUE(std::equal(before.points.begin(), before.points.end(), refined.points.begin()));
  EXPECT_TRUE(std::equal(before.extras.begin(), before.extras.end(), refined.extras.begin()));
  const auto& old_values = before.channels[0].values;
  const auto& values = refined.channels[0].values;
  EXPECT_TRUE(std::equal(old_values.begin(), old_values.end(), values.begin()));
  EXPECT_EQ(values.size(), old_values.size() + 10);  // four edges and a middle, twice
}

TEST(RefineValues, gives_corners_between_ones_without_a_value_none) {
  SurfaceValues surface = two_quadrilaterals();
  surface.channels[0].of_corners = {3, 3, 3, 3, 4, 5, -1, 7};
  const CornerValues refined = refine_values(surface, SurfaceScheme::CatmullClark).channels[0];
  for (std::size_t corner = 0; corner < 16; ++corner) {
    EXPECT_EQ(refined.of_corners[corner], 3);  // all of one value are that value
  }
  // Where it was, on the two edges there and in the middle, which four faces see.
  EXPECT_EQ(std::ranges::count(refined.of_corners, -1), 1 + 2 + 2 + 4);
}

TEST(RefineValues, keeps_edges_sharp_whose_faces_are_wound_against_each_other) {
  SurfaceValues surface;
  surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  surface.faces = {{0, 1, 2}, {1, 2, 3}};
  const SurfaceValues refined = refine_values(surface, SurfaceScheme::Loop);
  EXPECT_TRUE(std::ranges::any_of(refined.points, [](const glm::dvec3& p) {
    return glm::distance(p, glm::dvec3(0.5, 0.5, 0)) < 1e-15;
  }));
  surface.faces = {{0, 1, 2}, {2, 1, 3}};
  const SurfaceValues smooth = refine_values(surface, SurfaceScheme::Loop);
  EXPECT_TRUE(std::ranges::any_of(smooth.points, [](const glm::dvec3& p) {
    return glm::distance(p, glm::dvec3(0.5, 0.5, 0.125)) < 1e-15;
  }));
}

}  // namespace
}  // namespace espalier::osd
