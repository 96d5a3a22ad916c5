#include "deform/model/surface_point.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "deform/model/model_file.h"

namespace espalier {
namespace {

Model model_of(const std::string& text) {
  return parse_model(ModelFormat::Obj, "m.obj", text);
}

glm::dvec3 closest_place(const Model& model, const glm::dvec3& x) {
  return place_of(closest_surface_point(model, x), model.points());
}

TEST(SurfacePoint, closest_on_a_triangle_is_inside_it_on_an_edge_or_a_corner) {
  const Model triangle = model_of("v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n");
  EXPECT_LT(glm::distance(closest_place(triangle, {1, 1, 5}), {1, 1, 0}), 1e-15);
  EXPECT_LT(glm::distance(closest_place(triangle, {2, -3, 1}), {2, 0, 0}), 1e-15);
  EXPECT_LT(glm::distance(closest_place(triangle, {4, 4, -1}), {2, 2, 0}), 1e-15);
  EXPECT_EQ(closest_place(triangle, {-1, -2, 3}), glm::dvec3(0, 0, 0));
  EXPECT_EQ(closest_place(triangle, {9, -1, 0}), glm::dvec3(4, 0, 0));
}

TEST(SurfacePoint, is_no_farther_than_any_of_many_samples_of_the_surface) {
  const Model model = model_of(
      "v 0 0 0\nv 3 0 1\nv 3 3 0\nv 0 3 1\nv 1 5 2\nv -2 2 0\nf 1 2 3 4\nf 3 5 4\nf 1 4 5 6\n");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 x(6 * unit(random) - 2, 6 * unit(random) - 1, 4 * unit(random) - 1);
    const SurfacePoint found = closest_surface_point(model, x);
    double sum = 0;
    for (const auto& corner : found.corners) {
      EXPECT_GT(corner.weight, 0);
      sum += corner.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    const double distance = glm::distance(x, place_of(found, model.points()));
    for (int sample = 0; sample < 200; ++sample) {
      const double u = unit(random);
      const double v = unit(random) * (1 - u);
      const glm::dvec3 on_triangle =  // 3 5 4
          u * model.points()[2] + v * model.points()[4] + (1 - u - v) * model.points()[3];
      EXPECT_LE(distance, glm::distance(x, on_triangle) + 1e-14);
    }
    for (const glm::dvec3& point : model.points()) {
      EXPECT_LE(distance, glm::distance(x, point) + 1e-14);
    }
  }
}

TEST(SurfacePoint, of_a_square_is_where_it_is_whatever_its_corners_weigh) {
  const Model square = model_of("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n");
  for (const glm::dvec3& x :
       {glm::dvec3(0.3, 1.4, 1), glm::dvec3(1, 1, -2), glm::dvec3(1.9, 0.1, 0)}) {
    EXPECT_LT(glm::distance(closest_place(square, x), {x.x, x.y, 0}), 1e-15);
  }
}

TEST(SurfacePoint, of_a_model_without_faces_is_a_point) {
  const Model cloud = model_of("v 0 0 0\nv 1 0 0\nv 5 5 5\n");
  const SurfacePoint found = closest_surface_point(cloud, {4, 4, 9});
  ASSERT_EQ(found.corners.size(), 1u);
  EXPECT_EQ(found.corners[0].point, 2u);
  EXPECT_EQ(found.corners[0].weight, 1);
}

TEST(SurfacePoint, is_found_on_faces_without_area) {
  const Model line = model_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 0 0\nf 1 2 3\nf 3 4 3\n");
  EXPECT_LT(glm::distance(closest_place(line, {1.5, 1, 0}), {1.5, 0, 0}), 1e-15);
}

}  // namespace
}  // namespace espalier
