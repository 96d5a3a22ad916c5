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

const std::vector<glm::dvec3> kCube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const CompressedRows<std::int32_t> kCubeFaces = {
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

TEST(CornerNormals, do_not_depend_on_how_a_smooth_cube_is_cut_into_polygons) {
  const CornerNormals found = corner_normals(kCube, kCubeFaces, {.angle = 90});
  ASSERT_EQ(found.points, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  for (std::size_t i = 0; i < kCube.size(); ++i) {
    expect_near(found.normals[i], unit_or_zero(kCube[i] - 0.5));
  }
  for (std::size_t corner = 0; corner < kCubeFaces.n_values(); ++corner) {
    EXPECT_EQ(found.of_corners[corner], kCubeFaces.values()[corner]);
  }
}

TEST(CornerNormals, are_those_of_the_faces_at_sharp_edges) {
  for (const double scale : {1.0, 1e8, 1e-8}) {
    std::vector<glm::dvec3> points = kCube;
    for (glm::dvec3& point : points) {
      point *= scale;
    }
    const CornerNormals found = corner_normals(points, kCubeFaces, {.angle = 89.9});
    EXPECT_EQ(found.normals.size(), 24u);  // two triangles of one side share theirs
    for (std::size_t face = 0; face < kCubeFaces.n_rows(); ++face) {
      glm::dvec3 middle(0);
      for (std::size_t i = 0; i < 3; ++i) {
        middle += kCube[static_cast<std::size_t>(kCubeFaces[face][i])] / 3.0;
      }
      for (std::size_t i = 0; i < kCubeFaces[face].size(); ++i) {
        const auto normal = static_cast<std::size_t>(found.of_corners[kCubeFaces.offset(face) + i]);
        const glm::dvec3& n = found.normals[normal];
        EXPECT_NEAR(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1, 1e-15);
        EXPECT_GT(glm::dot(n, middle - 0.5), 0.49);
        EXPECT_EQ(found.points[normal], kCubeFaces[face][i]);
      }
    }
  }
}

TEST(CornerNormals, follow_smoothing_groups_and_not_angles_where_a_file_has_them) {
  const std::string cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";
  const Model model = parse_obj("m.obj", cube +
                                             "s 1\nf 1 4 3 2\nf 1 2 5\n"  // a right angle
                                             "s 2\nf 1 5 4\ns off\nf 2 3 5\ns 0\nf 3 4 5\n");
  const std::vector<std::int64_t> groups = smoothing_groups(model);
  EXPECT_EQ(groups, (std::vector<std::int64_t>{1, 1, 2, 0, 0}));
  const CornerNormals found =
      corner_normals(model.points(), model.faces(), {.angle = 1, .smoothing_groups = groups});
  EXPECT_EQ(found.of_corners[0], found.of_corners[4]);  // at point 1
  EXPECT_NE(found.of_corners[0], found.of_corners[7]);
  expect_near(found.normals[static_cast<std::size_t>(found.of_corners[0])],
              unit_or_zero({0, -1, -1}));
  EXPECT_NE(found.of_corners[12], found.of_corners[15]);  // at point 5, both off
  EXPECT_TRUE(smoothing_groups(parse_obj("m.obj", cube + "f 1 2 3\n")).empty());
}

TEST(CornerNormals, have_a_value_at_degenerate_faces_and_none_at_loose_points) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  const CornerNormals found = corner_normals(points, {{0, 1, 2}});
  EXPECT_EQ(found.points, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(found.normals[0], glm::dvec3(0, 0, 1));
}

TEST(CornerNormals, take_no_long_time_at_a_point_of_very_many_faces) {
  constexpr int kCount = 200000;
  std::vector<glm::dvec3> points = {{0, 0, 1}};
  CompressedRows<std::int32_t> faces;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 6.283185307179586 * i / kCount;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
    faces.push_back(std::vector<std::int32_t>{0, i + 1, (i + 1) % kCount + 1});
  }
  const CornerNormals found = corner_normals(points, faces);
  EXPECT_EQ(found.normals.size(), points.size());
  EXPECT_LT(glm::length(found.normals[0] - glm::dvec3(0, 0, 1)), 1e-9);
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
