#include "viewer/interact/gizmo.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "viewer/interact/symmetry.h"

namespace espalier::viewer {
namespace {

View looking_at_origin() {
  View view;
  view.camera.angles = {30, 20};
  return view;
}

glm::dvec2 pixel_of(const View& view, const glm::dvec3& point) {
  return glm::dvec2(view.project(point));
}

TEST(Gizmo, is_as_large_on_the_screen_from_near_and_far) {
  View view = looking_at_origin();
  view.camera.angles = named_view("front");
  for (const double distance : {2.0, 30.0}) {
    view.camera.distance = distance;
    const auto handles = gizmo_handles({TransformKind::Move, glm::dvec3(0)}, view);
    const glm::dvec2 tip = pixel_of(view, handles[0].segments[1]);
    EXPECT_NEAR(glm::length(tip - pixel_of(view, glm::dvec3(0))), 96, 1e-6);
  }
}

TEST(Gizmo, every_handle_is_hit_where_it_is_drawn) {
  const View view = looking_at_origin();
  for (const TransformKind kind :
       {TransformKind::Move, TransformKind::Turn, TransformKind::Scale}) {
    const Gizmo gizmo{kind, {0.1, 0.2, -0.1}};
    const auto handles = gizmo_handles(gizmo, view);
    EXPECT_EQ(handles.size(), kind == TransformKind::Move ? 7u : 4u);
    for (const GizmoHandle& handle : handles) {
      // Two thirds along its first line: no other handle is there.
      const glm::dvec3 at = handle.segments[0] + 0.66 * (handle.segments[1] - handle.segments[0]);
      const auto hit = gizmo_hit(gizmo, view, pixel_of(view, at));
      ASSERT_TRUE(hit);
      EXPECT_TRUE(handle.is(*hit)) << hit->axis;
    }
    EXPECT_FALSE(gizmo_hit(gizmo, view, pixel_of(view, gizmo.pivot) + glm::dvec2(150, 150)));
  }
}

TEST(Gizmo, planes_are_hit_inside_and_the_middle_moves_freely) {
  View view = looking_at_origin();
  view.camera.angles = named_view("front");
  const Gizmo gizmo{TransformKind::Move, glm::dvec3(0)};
  const auto plane = gizmo_hit(gizmo, view, pixel_of(view, glm::dvec3(0)) + glm::dvec2(40, -40));
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->axis == 2 && plane->is_plane);
  const auto middle = gizmo_hit(gizmo, view, pixel_of(view, glm::dvec3(0)));
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->axis, -1);
}

TEST(Gizmo, has_as_many_lines_in_every_view) {
  View view = looking_at_origin();
  const auto count = [&](TransformKind kind) {
    std::size_t n = 0;
    for (const GizmoHandle& handle : gizmo_handles({kind, glm::dvec3(0)}, view)) {
      n += handle.segments.size();
    }
    return n;
  };
  const std::size_t before = count(TransformKind::Turn);
  view.camera.angles = named_view("top");
  EXPECT_EQ(count(TransformKind::Turn), before);
}

TEST(Symmetry, images_stand_on_the_other_side_of_the_middle) {
  const std::vector<glm::dvec3> rest = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 5}};
  EXPECT_EQ(mirror_images(rest, 0), (std::vector<std::int32_t>{2, 1, 0, -1, -1}));
}

TEST(Symmetry, a_motion_is_mirrored_and_the_middle_stays_in_its_plane) {
  const std::vector<glm::dvec3> start = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  std::vector<glm::dvec3> to = {{0.5, 1, 2}, {1.5, 1, 0}, {2, 0, 0}};
  mirror_motion(start, mirror_images(start, 0), 0, to);
  EXPECT_EQ(to, (std::vector<glm::dvec3>{{0.5, 1, 2}, {1, 1, 0}, {1.5, 1, 2}}));
}

TEST(Symmetry, what_moves_itself_keeps_its_motion) {
  const std::vector<glm::dvec3> start = {{0, 0, 0}, {2, 0, 0}};
  std::vector<glm::dvec3> to = {{0.5, 0, 0}, {2.5, 0, 0}};
  const std::vector<glm::dvec3> asked = to;
  mirror_motion(start, mirror_images(start, 0), 0, to);
  EXPECT_EQ(to, asked);
}

}  // namespace
}  // namespace espalier::viewer
