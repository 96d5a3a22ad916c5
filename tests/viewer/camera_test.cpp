#include "viewer/render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

/// Normalised device coordinates, computed as a renderer does but in double.
glm::dvec3 projected(const Camera& camera, double aspect, const glm::dvec3& point) {
  const glm::dvec4 clip =
      camera.projection_matrix(aspect) * camera.view_matrix() * glm::dvec4(point, 1);
  return glm::dvec3(clip) / clip.w;
}

std::vector<glm::dvec3> corners_of(const Box& box) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                       (i & 4) != 0 ? box.max.z : box.min.z});
  }
  return corners;
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_LE(glm::length(actual - expected), tolerance)
      << actual.x << ' ' << actual.y << ' ' << actual.z << " is not " << expected.x << ' '
      << expected.y << ' ' << expected.z;
}

TEST(Camera, named_views_look_along_exact_axes_with_y_up) {
  const std::array<std::pair<const char*, glm::dvec3>, 6> sides{{{"front", {0, 0, 1}},
                                                                 {"back", {0, 0, -1}},
                                                                 {"left", {-1, 0, 0}},
                                                                 {"right", {1, 0, 0}},
                                                                 {"top", {0, 1, 0}},
                                                                 {"bottom", {0, -1, 0}}}};
  for (const auto& [name, side] : sides) {
    Camera camera;
    camera.angles = named_view(name);
    EXPECT_EQ(camera.backward(), side) << name;
    EXPECT_EQ(camera.eye(), 4.0 * side) << name;
  }
}

TEST(Camera, named_views_look_along_exact_axes_with_z_up) {
  const std::array<std::pair<const char*, glm::dvec3>, 6> sides{{{"front", {0, -1, 0}},
                                                                 {"back", {0, 1, 0}},
                                                                 {"left", {-1, 0, 0}},
                                                                 {"right", {1, 0, 0}},
                                                                 {"top", {0, 0, 1}},
                                                                 {"bottom", {0, 0, -1}}}};
  for (const auto& [name, side] : sides) {
    Camera camera;
    camera.up = UpAxis::Z;
    camera.angles = named_view(name);
    EXPECT_EQ(camera.backward(), side) << name;
  }
}

TEST(Camera, shows_up_as_up_and_right_as_right) {
  Camera camera;
  camera.angles = named_view("front");
  EXPECT_EQ(camera.right(), glm::dvec3(1, 0, 0));
  EXPECT_EQ(camera.upward(), glm::dvec3(0, 1, 0));
  camera.angles = named_view("top");
  EXPECT_EQ(camera.upward(), glm::dvec3(0, 0, -1));
  camera.up = UpAxis::Z;
  EXPECT_EQ(camera.upward(), glm::dvec3(0, 1, 0));
  camera.angles = named_view("right");
  EXPECT_EQ(camera.right(), glm::dvec3(0, 1, 0));
  EXPECT_EQ(camera.upward(), glm::dvec3(0, 0, 1));
}

TEST(Camera, sees_all_axes_alike_in_the_iso_view) {
  Camera camera;
  camera.angles = named_view("iso");
  expect_near(camera.backward(), glm::dvec3(1 / std::sqrt(3.0)));
}

TEST(Camera, axes_are_orthonormal_and_right_handed_from_everywhere) {
  for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    for (double azimuth = -720; azimuth <= 720; azimuth += 37.5) {
      for (double elevation = -90; elevation <= 90; elevation += 22.5) {
        Camera camera;
        camera.up = up;
        camera.angles = {azimuth, elevation};
        expect_near(glm::cross(camera.right(), camera.upward()), camera.backward());
        EXPECT_NEAR(glm::length(camera.right()), 1, 1e-12);
        EXPECT_NEAR(glm::dot(camera.right(), camera.upward()), 0, 1e-12);
      }
    }
  }
}

TEST(Camera, refuses_unknown_views_and_names_the_known_ones) {
  try {
    (void)named_view("sideways");
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("'sideways'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("three-quarter"), std::string::npos);
  }
}

TEST(Camera, projects_known_points_exactly) {
  Camera camera;
  camera.angles = named_view("front");
  camera.target = {10, 20, 30};
  camera.distance = 5;
  camera.radius = 2;
  camera.field_of_view = 90;
  expect_near(projected(camera, 2, {10, 20, 30}) * glm::dvec3(1, 1, 0), {0, 0, 0});
  // At the target's distance of 5 the picture is 10 high and, with aspect 2, 20 wide.
  expect_near(projected(camera, 2, {20, 20, 30}) * glm::dvec3(1, 1, 0), {1, 0, 0});
  expect_near(projected(camera, 2, {10, 15, 30}) * glm::dvec3(1, 1, 0), {0, -1, 0});
  // Nearer by half: twice the size.
  expect_near(projected(camera, 2, {12.5, 20, 32.5}) * glm::dvec3(1, 1, 0), {0.5, 0, 0});
  camera.projection = Projection::Orthographic;
  expect_near(projected(camera, 2, {12.5, 25, 32.5}) * glm::dvec3(1, 1, 0), {0.25, 1, 0});
}

TEST(Camera, nearer_points_have_less_depth_and_the_ball_is_between_the_planes) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    Camera camera;
    camera.projection = projection;
    const double front = projected(camera, 1, camera.backward()).z;
    const double back = projected(camera, 1, -camera.backward()).z;
    EXPECT_GT(front, -1);
    EXPECT_LT(front, back);
    EXPECT_LT(back, 1);
  }
}

TEST(Camera, frames_a_box_of_any_size) {
  for (const double size : {1e-8, 1e-3, 1.0, 1e3, 1e8}) {
    const glm::dvec3 far_off = size * glm::dvec3(5, -3, 2);
    const Box box{far_off - size * glm::dvec3(1, 2, 0.5), far_off + size * glm::dvec3(1, 2, 0.5)};
    for (const double aspect : {0.5, 4.0 / 3, 3.0}) {
      for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        for (const char* view : {"front", "left", "top", "iso", "three-quarter"}) {
          Camera camera;
          camera.projection = projection;
          camera.angles = named_view(view);
          camera = camera.fitted_to(box, aspect, 0.1);
          glm::dvec3 least(1e30);
          glm::dvec3 most(-1e30);
          for (const glm::dvec3& corner : corners_of(box)) {
            least = glm::min(least, projected(camera, aspect, corner));
            most = glm::max(most, projected(camera, aspect, corner));
          }
          // A margin of a tenth of the picture on each side leaves ±0.8 …
          EXPECT_GE(std::min(least.x, least.y), -0.8 - 1e-9) << view << ' ' << size;
          EXPECT_LE(std::max(most.x, most.y), 0.8 + 1e-9) << view << ' ' << size;
          EXPECT_GE(least.z, -1);
          EXPECT_LE(most.z, 1);
          // … and the box reaches it on two opposite sides.
          const bool is_tight =
              (least.x < -0.79 && most.x > 0.79) || (least.y < -0.79 && most.y > 0.79);
          EXPECT_TRUE(is_tight || camera.distance < 1.5001 * camera.radius) << view << ' ' << size;
        }
      }
    }
  }
}

TEST(Camera, frames_flat_thin_empty_and_single_point_boxes) {
  const std::vector<Box> boxes{
      {{-1, 0, -1}, {1, 0, 1}}, {{0, 0, -5}, {0, 0, 5}}, {{7, 8, 9}, {7, 8, 9}}, Box{}};
  for (const Box& box : boxes) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
      for (const char* view : {"front", "top", "iso"}) {
        Camera camera;
        camera.projection = projection;
        camera.angles = named_view(view);
        camera = camera.fitted_to(box, 1.5);
        EXPECT_GT(camera.distance, 0);
        EXPECT_GT(camera.radius, 0);
        for (const glm::dvec3& corner :
             corners_of(box.is_empty() ? Box{{0, 0, 0}, {0, 0, 0}} : box)) {
          const glm::dvec3 place = projected(camera, 1.5, corner);
          EXPECT_LE(std::abs(place.x), 0.88 + 1e-9);
          EXPECT_LE(std::abs(place.y), 0.88 + 1e-9);
          EXPECT_LE(std::abs(place.z), 1);
        }
      }
    }
  }
}

TEST(Camera, leaves_out_points_that_are_not_finite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<glm::dvec3> clean{{0, 0, 0}, {1, 2, 3}};
  const std::vector<glm::dvec3> dirty{{0, 0, 0}, {nan, 0, 0}, {1, 2, 3}, {0, -inf, 0}};
  const Camera expected = Camera().fitted_to(clean, 1);
  const Camera actual = Camera().fitted_to(dirty, 1);
  EXPECT_EQ(actual.target, expected.target);
  EXPECT_EQ(actual.distance, expected.distance);
  EXPECT_EQ(actual.radius, expected.radius);
}

TEST(Camera, refuses_margins_and_aspects_that_leave_no_room) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_THROW((void)Camera().fitted_to(box, 1, 0.5), ParameterError);
  EXPECT_THROW((void)Camera().fitted_to(box, 1, -0.1), ParameterError);
  EXPECT_THROW((void)Camera().fitted_to(box, 0), ParameterError);
  EXPECT_THROW((void)Camera().fitted_to(box, std::nan("")), ParameterError);
}

}  // namespace
}  // namespace espalier::viewer
