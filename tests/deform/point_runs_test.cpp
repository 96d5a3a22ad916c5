#include "deform/evaluate/point_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "deform/evaluate/kernels.h"
#include "lattice/core/error.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

/// Four cells in a row along x.
Volume row_of_cells() {
  return test::spline_volume({4, 1, 1}, test::grid_points({4, 1, 1}));
}

template <class Real>
Real number(const AlignedVector<Real>& blocks, std::size_t n_rows, std::size_t row,
            std::size_t point) {
  return blocks[(point / kBlock * n_rows + row) * kBlock + point % kBlock];
}

TEST(PointRuns, hold_the_points_of_one_patch_each_in_their_order) {
  const std::vector<std::int32_t> patches = {0, 0, 2, 2, 2, 3};
  const std::vector<glm::dvec3> uvw(6, glm::dvec3(0.5));
  const auto made = make_point_runs<double>(row_of_cells(), {patches, uvw});
  EXPECT_EQ(made.n_points, 6u);
  ASSERT_EQ(made.runs.size(), 3u);
  const std::uint32_t firsts[] = {0, 2, 5};
  const std::uint32_t lengths[] = {2, 3, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(made.runs[i].first_point, firsts[i]);
    EXPECT_EQ(made.runs[i].n_points, lengths[i]);
    EXPECT_EQ(made.runs[i].patch, patches[firsts[i]]);
    EXPECT_EQ(made.runs[i].first_block, i);
    EXPECT_FALSE(made.runs[i].is_scattered);
  }
  EXPECT_EQ(made.chunks, (std::vector<std::uint32_t>{0, 3}));
}

TEST(PointRuns, lay_places_out_in_rows_and_fill_the_last_block_with_the_last_point) {
  std::vector<glm::dvec3> uvw;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 11; ++i) {
    uvw.emplace_back(i / 16.0, i / 32.0, i / 64.0);
    points.emplace_back(i, 2 * i, 3 * i);
  }
  const std::vector<std::int32_t> patches(11, 1);
  const auto made = make_point_runs<float>(row_of_cells(), {patches, uvw, points});
  ASSERT_EQ(made.places.size(), 2 * kPlaceRows * kBlock);
  for (std::size_t at = 0; at < 2 * kBlock; ++at) {
    const std::size_t i = std::min<std::size_t>(at, 10);
    for (int axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<std::size_t>(axis);
      EXPECT_EQ(number(made.places, kPlaceRows, row, at), static_cast<float>(uvw[i][axis]));
      EXPECT_EQ(number(made.places, kPlaceRows, row + 3, at), static_cast<float>(points[i][axis]));
    }
  }
  EXPECT_TRUE(made.slopes.empty());
}

TEST(PointRuns, see_points_at_far_ends_from_there) {
  const std::vector<std::int32_t> patches(4, 1);
  const std::vector<glm::dvec3> uvw = {
      {0.25, 0.5, 0.5}, {1, 0.5, 0.5}, {1, 0.25, 1}, {1 - 1e-7, 0.125, 0.5}};
  const auto made = make_point_runs<double>(row_of_cells(), {patches, uvw});
  ASSERT_EQ(made.runs.size(), 3u);
  EXPECT_EQ(made.runs[0].n_points, 4u);
  const PointRun& at_u = made.runs[1];
  EXPECT_TRUE(at_u.is_scattered);
  EXPECT_EQ(at_u.n_points, 2u);
  EXPECT_EQ(at_u.axes[0], made.runs[0].axes[0] + 1);
  EXPECT_EQ(at_u.axes[1], made.runs[0].axes[1]);
  EXPECT_EQ(made.targets, (std::vector<std::uint32_t>{1, 3, 2}));
  EXPECT_EQ(number(made.places, kPlaceRows, 0, at_u.first_block * kBlock), 0);
  EXPECT_NEAR(number(made.places, kPlaceRows, 0, at_u.first_block * kBlock + 1), 1e-7, 1e-16);
  const PointRun& at_u_and_w = made.runs[2];
  EXPECT_EQ(at_u_and_w.axes[2], made.runs[0].axes[2] + 1);
  EXPECT_EQ(number(made.places, kPlaceRows, 2, at_u_and_w.first_block * kBlock), 0);
}

TEST(PointRuns, hold_the_slopes_of_the_rest_map_and_what_it_makes_of_normals_and_tangents) {
  // A straight B-spline of unit cells is the identity: R = I, whose inverse determinant is 1.
  const std::vector<std::int32_t> patches = {1};
  const std::vector<glm::dvec3> uvw = {{0.25, 0.5, 0.75}};
  const std::vector<glm::dvec3> normals = {{0, 0.6, 0.8}};
  const std::vector<glm::dvec3> tangents = {{1, 2, 3}};
  const auto made = make_point_runs<double>(row_of_cells(), {patches, uvw, {}, normals, tangents});
  const double expected[kSlopeRows] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1};
  for (std::size_t row = 0; row < kSlopeRows; ++row) {
    EXPECT_NEAR(number(made.slopes, kSlopeRows, row, 0), expected[row], 1e-15) << row;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<std::size_t>(axis);
    EXPECT_NEAR(number(made.normals, kVectorRows, row, 0), normals[0][axis], 1e-15);
    EXPECT_NEAR(number(made.tangents, kVectorRows, row, 0), tangents[0][axis], 2e-15);
  }
}

TEST(PointRuns, are_cut_into_chunks_of_whole_runs) {
  const std::vector<std::int32_t> patches(30000, 1);
  const std::vector<glm::dvec3> uvw(30000, glm::dvec3(0.5));
  const auto made = make_point_runs<float>(row_of_cells(), {patches, uvw});
  EXPECT_GT(made.chunks.size(), 3u);
  EXPECT_EQ(made.chunks.front(), 0u);
  EXPECT_EQ(made.chunks.back(), made.runs.size());
  std::size_t n_points = 0;
  for (const PointRun& run : made.runs) {
    EXPECT_EQ(run.first_point, n_points);
    n_points += run.n_points;
  }
  EXPECT_EQ(n_points, 30000u);
}

TEST(PointRuns, refuse_patches_that_do_not_ascend_or_do_not_exist_by_name) {
  const Volume volume = row_of_cells();
  const std::vector<glm::dvec3> uvw(2, glm::dvec3(0.5));
  const auto message = [&](const std::vector<std::int32_t>& patches) {
    try {
      static_cast<void>(make_point_runs<double>(volume, {patches, uvw}));
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  EXPECT_EQ(message({2, 1}), "point 1 is in patch 1, after one in patch 2: patches must ascend");
  EXPECT_EQ(message({0, 4}), "point 1 is in patch 4, the volume has 4");
  EXPECT_EQ(message({-1, 0}), "point 0 is in patch -1, the volume has 4");
  EXPECT_EQ(message({0}), "2 places (uvw) given for 1 points");
}

}  // namespace
}  // namespace espalier
