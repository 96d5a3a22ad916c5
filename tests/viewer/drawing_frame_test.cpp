#include "viewer/render/drawing_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace espalier::viewer {
namespace {

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance) {
  EXPECT_LE(glm::length(actual - expected), tolerance);
}

TEST(DrawingFrame, brings_boxes_of_any_size_and_place_to_the_unit_ball) {
  for (const double size : {1e-8, 1.0, 1e8}) {
    const glm::dvec3 place = size * 1e6 * glm::dvec3(1, -1, 0.5);
    const Box box{place - size * glm::dvec3(2, 1, 2), place + size * glm::dvec3(2, 1, 2)};
    const DrawingFrame frame = DrawingFrame::of(box);
    expect_near(frame.to_drawing(box.max), glm::dvec3(2, 1, 2) / 3.0, 1e-9);
    expect_near(frame.to_model(frame.to_drawing(box.min)) / size, box.min / size, 1e-9);
    EXPECT_NEAR(frame.to_drawing(box).radius(), 1, 1e-9);
  }
}

TEST(DrawingFrame, keeps_the_units_of_a_box_without_extent) {
  EXPECT_EQ(DrawingFrame::of(Box{}).scale, 1);
  const DrawingFrame frame = DrawingFrame::of(Box{{3, 4, 5}, {3, 4, 5}});
  EXPECT_EQ(frame.to_drawing(glm::dvec3(3, 4, 6)), glm::dvec3(0, 0, 1));
}

TEST(Box, holds_the_finite_points_added_to_it) {
  Box box;
  EXPECT_TRUE(box.is_empty());
  EXPECT_EQ(box.center(), glm::dvec3(0.0));
  EXPECT_EQ(box.radius(), 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  box.add(std::vector<glm::dvec3>{{1, nan, 0}, {-1, 2, 3}, {5, 0, -3}});
  EXPECT_EQ(box.min, glm::dvec3(-1, 0, -3));
  EXPECT_EQ(box.max, glm::dvec3(5, 2, 3));
  EXPECT_EQ(box.center(), glm::dvec3(2, 1, 0));
  EXPECT_DOUBLE_EQ(box.radius(), std::sqrt(19.0));
}

}  // namespace
}  // namespace espalier::viewer
