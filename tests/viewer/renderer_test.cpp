#include "viewer/render/renderer.h"

#include <gtest/gtest.h>

#include <limits>

#include "lattice/core/error.h"
#include "viewer/render/null_renderer.h"

namespace espalier::viewer {
namespace {

TriangleMesh triangle() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {3, {0, 0, 1}}, {0, 1, 2}, kClay, 1};
}
LineSet two_lines() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{1, 0, 0}, {0, 1, 0}}};
}
PointSet two_points() {
  return {{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {0, 1, 0}}};
}

TEST(Renderer, updates_only_the_range_it_is_given) {
  NullRenderer renderer;
  const ItemId mesh = renderer.add(triangle());
  const ItemId lines = renderer.add(two_lines());
  const ItemId points = renderer.add(two_points());
  const std::size_t n_before = renderer.n_uploaded();

  renderer.update_positions(mesh, 1, std::vector<glm::vec3>{{5, 6, 7}});
  renderer.update_normals(mesh, 2, std::vector<glm::vec3>{{1, 0, 0}});
  renderer.update_positions(lines, 2, std::vector<glm::vec3>{{2, 2, 2}, {3, 3, 3}});
  renderer.update_colors(points, 1, std::vector<glm::vec3>{{0, 0, 1}});
  EXPECT_EQ(renderer.n_uploaded() - n_before, 5u);

  const auto& kept_mesh = std::get<TriangleMesh>(renderer.items().at(mesh));
  EXPECT_EQ(kept_mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}}));
  EXPECT_EQ(kept_mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(std::get<LineSet>(renderer.items().at(lines)).points,
            (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {2, 2, 2}, {3, 3, 3}}));
  EXPECT_EQ(std::get<PointSet>(renderer.items().at(points)).colors,
            (std::vector<glm::vec3>{{1, 0, 0}, {0, 0, 1}}));
}

TEST(Renderer, draws_what_is_visible_in_the_order_it_was_added) {
  NullRenderer renderer;
  const ItemId first = renderer.add(triangle());
  const ItemId second = renderer.add(two_lines());
  const ItemId third = renderer.add(two_points());
  renderer.draw(Camera(), 40, 30);
  renderer.set_visible(second, false);
  renderer.draw(Camera(), 40, 30);
  renderer.set_visible(second, true);
  renderer.remove(first);
  renderer.draw(Camera(), 40, 30);
  ASSERT_EQ(renderer.shots().size(), 3u);
  EXPECT_EQ(renderer.shots()[0].items, (std::vector<ItemId>{first, second, third}));
  EXPECT_EQ(renderer.shots()[1].items, (std::vector<ItemId>{first, third}));
  EXPECT_EQ(renderer.shots()[2].items, (std::vector<ItemId>{second, third}));
}

TEST(Renderer, never_gives_an_id_twice) {
  NullRenderer renderer;
  const ItemId first = renderer.add(triangle());
  renderer.remove(first);
  EXPECT_NE(renderer.add(triangle()), first);
  EXPECT_EQ(renderer.items().size(), 1u);
}

TEST(Renderer, takes_all_of_a_drawing) {
  NullRenderer renderer;
  Drawing drawing{{triangle(), triangle()}, {two_lines()}, {two_points()}, {}};
  drawing.background.top = {0.1F, 0.2F, 0.3F};
  renderer.add(drawing);
  const Picture picture = renderer.take_picture(Camera(), 40, 30);
  EXPECT_EQ(picture.width, 40);
  EXPECT_EQ(picture.height, 30);
  EXPECT_EQ(renderer.shots().at(0).items.size(), 4u);
  EXPECT_EQ(renderer.shots().at(0).background.top, drawing.background.top);
}

TEST(Renderer, draws_nothing_into_a_window_without_pixels) {
  NullRenderer renderer;
  renderer.draw(Camera(), 0, 30);
  EXPECT_TRUE(renderer.shots().empty());
}

TEST(Renderer, refuses_items_that_are_not_whole) {
  NullRenderer renderer;
  TriangleMesh mesh = triangle();
  mesh.indices[1] = 3;
  EXPECT_THROW(renderer.add(mesh), ParameterError);
  mesh = triangle();
  mesh.indices.pop_back();
  EXPECT_THROW(renderer.add(mesh), ParameterError);
  mesh = triangle();
  mesh.normals.pop_back();
  EXPECT_THROW(renderer.add(mesh), ParameterError);
  mesh = triangle();
  mesh.positions[2].y = std::numeric_limits<float>::infinity();
  EXPECT_THROW(renderer.add(mesh), ParameterError);
  mesh = triangle();
  mesh.opacity = 1.5F;
  EXPECT_THROW(renderer.add(mesh), ParameterError);
  LineSet lines = two_lines();
  lines.points.pop_back();
  EXPECT_THROW(renderer.add(lines), ParameterError);
  lines = two_lines();
  lines.width = -1;
  EXPECT_THROW(renderer.add(lines), ParameterError);
  PointSet points = two_points();
  points.colors.pop_back();
  EXPECT_THROW(renderer.add(points), ParameterError);
  EXPECT_TRUE(renderer.items().empty());
}

TEST(Renderer, refuses_updates_out_of_range_and_items_that_are_gone) {
  NullRenderer renderer;
  const ItemId mesh = renderer.add(triangle());
  const ItemId lines = renderer.add(two_lines());
  const std::vector<glm::vec3> two(2);
  EXPECT_THROW(renderer.update_positions(mesh, 2, two), ParameterError);
  EXPECT_THROW(renderer.update_positions(mesh, static_cast<std::size_t>(-1), two), ParameterError);
  EXPECT_THROW(renderer.update_colors(mesh, 0, two), ParameterError);
  EXPECT_THROW(renderer.update_normals(lines, 0, two), ParameterError);
  EXPECT_NO_THROW(renderer.update_positions(mesh, 1, two));
  renderer.remove(mesh);
  EXPECT_THROW(renderer.update_positions(mesh, 1, two), ParameterError);
  EXPECT_THROW(renderer.set_visible(mesh, true), ParameterError);
  EXPECT_THROW(renderer.remove(mesh), ParameterError);
  EXPECT_THROW(renderer.remove(ItemId{}), ParameterError);
  EXPECT_THROW(renderer.remove(ItemId{7}), ParameterError);
}

TEST(Renderer, refuses_cameras_that_see_nothing) {
  NullRenderer renderer;
  Camera camera;
  camera.distance = 0;
  EXPECT_THROW(renderer.draw(camera, 4, 3), ParameterError);
  camera = {};
  camera.radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(renderer.draw(camera, 4, 3), ParameterError);
}

}  // namespace
}  // namespace espalier::viewer
