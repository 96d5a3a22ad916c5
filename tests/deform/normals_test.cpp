#include "deform/model/normals.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "deform/model/obj.h"

namespace espalier {
namespace {

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-15);
}

TEST(UnitOrZero, has_length_one_at_every_scale) {
  expect_near(unit_or_zero({3, 0, 4}), {0.6, 0, 0.8});
  expect_near(unit_or_zero({3e300, 0, 4e300}), {0.6, 0, 0.8});
  expect_near(unit_or_zero({3e-300, 0, 4e-300}), {0.6, 0, 0.8});
  EXPECT_EQ(unit_or_zero(glm::dvec3(0)), glm::dvec3(0));
  EXPECT_EQ(unit_or_zero({NAN, 1, 0}), glm::dvec3(0));
  EXPECT_EQ(unit_or_zero({INFINITY, 1, 0}), glm::dvec3(0));
}

TEST(SmoothNormals, do_not_depend_on_how_a_cube_is_cut_into_polygons) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const CompressedRows<std::int32_t> faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6},
                                              {1, 6, 5},    {2, 3, 7, 6}, {3, 0, 4, 7}};
  const std::vector<glm::dvec3> normals = smooth_normals(points, faces);
  for (std::size_t i = 0; i < points.size(); ++i) {
    expect_near(normals[i], unit_or_zero(points[i] - 0.5));
  }
}

TEST(SmoothNormals, have_a_value_at_degenerate_faces_and_none_at_loose_points) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  const std::vector<glm::dvec3> normals = smooth_normals(points, {{0, 1, 2}});
  EXPECT_EQ(normals[0], glm::dvec3(0, 0, 1));
  EXPECT_EQ(normals[3], glm::dvec3(0));
}

/// A model in which n points share one normal.
Model fan(int n) {
  std::string bytes;
  for (int i = 0; i < n; ++i) {
    bytes += "v 0 0 0\n";
  }
  bytes += "vn 0 0 1\nf";
  for (int i = 1; i <= n; ++i) {
    bytes.append(" ").append(std::to_string(i)).append("//1");
  }
  return parse_obj("fan.obj", bytes);
}

TEST(SplitNormals, share_across_every_cell_border) {
  constexpr int kCount = 3000;
  const Model model = fan(2 * kCount);
  std::vector<glm::dvec3> normals;
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = 0; i < kCount; ++i) {
      const double angle = 0.1 + 1e-5 * i + 4e-7 * copy;
      normals.emplace_back(std::sin(angle), std::cos(angle), 0);
    }
  }
  const NormalPlan plan = split_normals(model, normals);
  EXPECT_EQ(plan.values[0].size(), static_cast<std::size_t>(kCount));
  for (int i = 0; i < kCount; ++i) {
    EXPECT_EQ(plan.value_of_pair[i], i);
    EXPECT_EQ(plan.value_of_pair[kCount + i], i);
  }
}

TEST(SplitNormals, take_linear_time_where_a_normal_falls_apart_everywhere) {
  constexpr int kCount = 200000;
  const Model model = fan(kCount);
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 3.0 * i / kCount;
    normals.emplace_back(std::sin(angle), std::cos(angle), 0);
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(split_normals(model, normals).values[0].size(), static_cast<std::size_t>(kCount));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace espalier
