#include "viewer/render/opengl_renderer.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "lattice/core/error.h"
#include "viewer/render/offscreen_context.h"
#include "viewer/render/render_picture.h"

namespace espalier::viewer {
namespace {

constexpr glm::vec3 kRed{0.9F, 0.1F, 0.1F};
constexpr glm::vec3 kBlue{0.1F, 0.1F, 0.9F};
constexpr glm::vec3 kBlack{0, 0, 0};
constexpr Background kWhite{{1, 1, 1}, {1, 1, 1}};

/// From the front, without perspective: x and y from -1 to 1 fill a square picture.
Camera front_camera() {
  Camera camera;
  camera.angles = named_view("front");
  camera.projection = Projection::Orthographic;
  camera.distance = 4;
  camera.radius = 2;
  camera.field_of_view = 2 * std::atan(0.25) * 180 / M_PI;
  return camera;
}

/// A square of half-width `half` that faces the front, at depth z.
TriangleMesh square(float half, float z, const glm::vec3& color) {
  return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
          {4, {0, 0, 1}},
          {0, 1, 2, 0, 2, 3},
          color,
          1};
}

LineSet line(const glm::vec3& from, const glm::vec3& to, const glm::vec3& color, float width) {
  return {{from, to}, {color}, width, 0.3F};
}

Drawing on_white() {
  Drawing drawing;
  drawing.background = kWhite;
  return drawing;
}

using Pixel = std::array<std::uint8_t, 4>;

bool is_reddish(const Pixel& p) {
  return p[0] > 2 * p[1] && p[0] > 2 * p[2] && p[0] > 100;
}
bool is_bluish(const Pixel& p) {
  return p[2] > 2 * p[0] && p[2] > 2 * p[1] && p[2] > 100;
}
bool is_white(const Pixel& p) {
  return p == Pixel{255, 255, 255, 255};
}

/// How much of a pixel black covers on white, undoing the sRGB curve.
double blackness(const Pixel& pixel) {
  const double value = pixel[1] / 255.0;
  return 1 - (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

double column_blackness(const Picture& picture, int x) {
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) {
    sum += blackness(picture.at(x, y));
  }
  return sum;
}

TEST(OpenglRenderer, shows_a_triangle_where_it_is_and_background_elsewhere) {
  Drawing drawing;
  drawing.meshes.push_back(
      {{{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0, 0.5F, 0}}, {3, {0, 0, 1}}, {0, 1, 2}, kRed, 1});
  const Picture picture = render_picture(drawing, front_camera(), 100, 100);
  EXPECT_TRUE(is_reddish(picture.at(50, 50)));
  EXPECT_TRUE(is_reddish(picture.at(50, 30)));  // near its tip, at the top
  EXPECT_TRUE(is_reddish(picture.at(28, 73)));
  EXPECT_FALSE(is_reddish(picture.at(28, 30)));
  EXPECT_FALSE(is_reddish(picture.at(50, 80)));
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(picture.at(3, 0)[channel], 255 * drawing.background.top[channel], 2);
    EXPECT_NEAR(picture.at(3, 99)[channel], 255 * drawing.background.bottom[channel], 2);
  }
  EXPECT_EQ(picture.at(50, 50)[3], 255);
  EXPECT_EQ(picture.at(3, 0)[3], 255);
}

TEST(OpenglRenderer, the_nearer_mesh_hides_the_farther_one_in_either_order) {
  for (const bool near_first : {true, false}) {
    Drawing drawing;
    drawing.meshes = {square(0.4F, 0.5F, kRed), square(0.8F, -0.5F, kBlue)};
    if (!near_first) {
      std::swap(drawing.meshes[0], drawing.meshes[1]);
    }
    const Picture picture = render_picture(drawing, front_camera(), 60, 60);
    EXPECT_TRUE(is_reddish(picture.at(30, 30)));
    EXPECT_TRUE(is_bluish(picture.at(10, 30)));
  }
}

TEST(OpenglRenderer, lights_both_sides_alike) {
  Drawing drawing = on_white();
  drawing.meshes = {square(0.7F, 0, kRed)};
  const Picture front = render_picture(drawing, front_camera(), 40, 40);
  TriangleMesh& mesh = drawing.meshes[0];
  std::swap(mesh.indices[1], mesh.indices[2]);
  std::swap(mesh.indices[4], mesh.indices[5]);
  EXPECT_EQ(render_picture(drawing, front_camera(), 40, 40), front);
  mesh.normals.assign(4, {0, 0, -1});
  EXPECT_EQ(render_picture(drawing, front_camera(), 40, 40), front);
  mesh.normals.assign(4, {0, 0, 0});  // the facet's own
  EXPECT_EQ(render_picture(drawing, front_camera(), 40, 40), front);
}

TEST(OpenglRenderer, lights_from_above) {
  const float s = std::sqrt(0.5F);
  Drawing up = on_white();
  up.meshes = {square(0.7F, 0, kClay)};
  Drawing down = up;
  up.meshes[0].normals.assign(4, {0, s, s});
  down.meshes[0].normals.assign(4, {0, -s, s});
  const Pixel bright = render_picture(up, front_camera(), 20, 20).at(10, 10);
  const Pixel dark = render_picture(down, front_camera(), 20, 20).at(10, 10);
  EXPECT_GT(bright[0], dark[0] + 40);
}

TEST(OpenglRenderer, hidden_lines_are_fainter_but_not_gone) {
  Drawing drawing;
  drawing.meshes = {square(0.8F, 0, {0.9F, 0.9F, 0.9F})};
  const Picture bare = render_picture(drawing, front_camera(), 61, 61);
  drawing.lines = {line({-0.9F, 0, -0.5F}, {0.9F, 0, -0.5F}, kBlack, 5)};
  const Picture hidden = render_picture(drawing, front_camera(), 61, 61);
  drawing.lines[0].hidden_opacity = 0;
  const Picture gone = render_picture(drawing, front_camera(), 61, 61);
  drawing.lines = {line({-0.9F, 0, 0.5F}, {0.9F, 0, 0.5F}, kBlack, 5)};
  const Picture visible = render_picture(drawing, front_camera(), 61, 61);
  EXPECT_LT(visible.at(30, 30)[1], 130);
  EXPECT_GT(hidden.at(30, 30)[1], visible.at(30, 30)[1] + 40);
  EXPECT_LT(hidden.at(30, 30)[1], bare.at(30, 30)[1] - 15);
  EXPECT_EQ(gone.at(30, 30), bare.at(30, 30));
}

TEST(OpenglRenderer, lines_on_a_surface_are_not_swallowed_by_it) {
  Drawing drawing;
  drawing.meshes = {square(0.8F, 0, {0.9F, 0.9F, 0.9F})};
  drawing.lines = {line({-0.7F, -0.3F, 0}, {0.7F, 0.4F, 0}, kBlack, 4)};
  for (const double azimuth : {-60.0, 0.0, 45.0}) {
    Camera camera;
    camera.angles = {azimuth, 20};
    camera.distance = 6;
    const Picture on_surface = render_picture(drawing, camera, 101, 101);
    Drawing alone = drawing;
    alone.meshes.clear();
    const Picture free = render_picture(alone, camera, 101, 101);
    int n_dark = 0;
    int n_swallowed = 0;
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        if (free.at(x, y)[1] < 150) {
          ++n_dark;
          n_swallowed += on_surface.at(x, y)[1] > free.at(x, y)[1] + 20 ? 1 : 0;
        }
      }
    }
    EXPECT_GT(n_dark, 50) << azimuth;
    EXPECT_EQ(n_swallowed, 0) << azimuth;
  }
}

TEST(OpenglRenderer, lines_are_as_wide_as_asked) {
  for (const float width : {1.F, 2.5F, 6.F}) {
    for (const float slope : {0.F, 0.37F}) {
      Drawing drawing = on_white();
      drawing.lines = {line({-2, -2 * slope, 0}, {2, 2 * slope, 0}, kBlack, width)};
      Camera camera = front_camera();
      camera.radius = 100;  // The line stands in the nearer half, where nothing is pale.
      camera.target.z = -90;
      camera.distance = 94;
      camera.field_of_view = 2 * std::atan(1.0 / 94) * 180 / M_PI;
      const Picture picture = render_picture(drawing, camera, 80, 80);
      const double expected = width * std::sqrt(1 + slope * slope);
      for (int x = 20; x < 60; ++x) {
        EXPECT_NEAR(column_blackness(picture, x), expected, 0.12 * expected + 0.05);
      }
    }
  }
}

TEST(OpenglRenderer, the_nearer_line_runs_over_the_farther_one_in_either_order) {
  const LineSet near_line = line({-0.8F, 0, 0.5F}, {0.8F, 0, 0.5F}, kRed, 9);
  const LineSet far_line = line({0, -0.8F, -0.1F}, {0, 0.8F, -0.1F}, kBlue, 9);
  for (const bool near_first : {true, false}) {
    Drawing drawing = on_white();
    drawing.lines =
        near_first ? std::vector{near_line, far_line} : std::vector{far_line, near_line};
    const Picture picture = render_picture(drawing, front_camera(), 61, 61);
    EXPECT_TRUE(is_reddish(picture.at(30, 30)));
    EXPECT_GT(picture.at(30, 10)[2], picture.at(30, 10)[0] + 60);
  }
}

TEST(OpenglRenderer, draws_the_part_of_a_line_that_is_before_the_eye) {
  Camera camera;
  camera.angles = named_view("front");
  camera.distance = 4;
  Drawing drawing = on_white();
  // From the middle of the picture past the right of the eye to far behind it.
  drawing.lines = {line({0, 0, 0}, {2, 0, 100}, kRed, 5)};
  const Picture picture = render_picture(drawing, camera, 80, 61);
  EXPECT_TRUE(is_white(picture.at(20, 30)));
  for (int x = 41; x < 50; ++x) {
    EXPECT_GT(picture.at(x, 30)[0], picture.at(x, 30)[2] + 40) << x;
  }
  drawing.lines = {line({0, 0, 10}, {2, 0, 100}, kRed, 5)};
  const Picture behind = render_picture(drawing, camera, 80, 61);
  EXPECT_EQ(behind, render_picture(on_white(), camera, 80, 61));
}

/// Area of all that is black in the picture, and its centre in pixels from the top left corner.
struct Blot {
  double area = 0;
  double x = 0;
  double y = 0;

  explicit Blot(const Picture& picture) {
    for (int row = 0; row < picture.height; ++row) {
      for (int column = 0; column < picture.width; ++column) {
        const double black = blackness(picture.at(column, row));
        area += black;
        x += black * (column + 0.5);
        y += black * (row + 0.5);
      }
    }
    x /= area;
    y /= area;
  }
};

TEST(OpenglRenderer, dots_are_round_and_as_large_as_asked) {
  Drawing drawing = on_white();
  drawing.points = {{{{0.2F, -0.1F, 1.5F}}, {kBlack}, 20, 0, 1}};
  const Picture picture = render_picture(drawing, front_camera(), 100, 100);
  const Blot blot(picture);
  EXPECT_NEAR(blot.area, M_PI * 100, 5);
  EXPECT_NEAR(blot.x, 60, 0.1);
  EXPECT_NEAR(blot.y, 55, 0.1);
  EXPECT_TRUE(is_white(picture.at(60 + 8, 55 + 8)));  // outside the disc, inside its square
}

TEST(OpenglRenderer, every_tile_of_a_large_picture_is_in_its_place) {
  for (const int at : {1000, 2047, 2400}) {
    const float along = 50 * (static_cast<float>(at) / 1250 - 1);
    Drawing drawing = on_white();
    drawing.points = {{{{along, 0.2F, 1.5F}}, {kBlack}, 20, 0, 1}};
    const Blot wide(render_picture(drawing, front_camera(), 2500, 50));
    EXPECT_NEAR(wide.area, M_PI * 100, 5);
    EXPECT_NEAR(wide.x, at, 0.1);
    EXPECT_NEAR(wide.y, 20, 0.1);
    // The picture's height stays 2 units: 1250 pixels are 1.
    drawing.points[0].points[0] = {0.0F, along / 50, 1.5F};
    const Blot tall(render_picture(drawing, front_camera(), 50, 2500));
    EXPECT_NEAR(tall.area, M_PI * 100, 5);
    EXPECT_NEAR(tall.x, 25, 0.1);
    EXPECT_NEAR(tall.y, 2500 - at, 0.1);
  }
}

TEST(OpenglRenderer, dots_have_a_dark_outline) {
  Drawing drawing = on_white();
  drawing.points = {{{{0, 0, 0}}, {{1, 0.85F, 0.1F}}, 20, 3, 1}};
  const Picture picture = render_picture(drawing, front_camera(), 41, 41);
  EXPECT_GT(picture.at(20, 20)[0], 200);
  EXPECT_LT(picture.at(20 + 8, 20)[0], 160);
}

TEST(OpenglRenderer, what_is_behind_shines_through_a_transparent_mesh) {
  Drawing drawing = on_white();
  drawing.meshes = {square(0.8F, 0.5F, kBlue), square(0.4F, -0.5F, kRed)};
  drawing.meshes[0].opacity = 0.3F;
  const Picture picture = render_picture(drawing, front_camera(), 60, 60);
  const Pixel over_red = picture.at(30, 30);
  const Pixel over_white = picture.at(10, 30);
  EXPECT_GT(over_red[0], over_red[2]);
  EXPECT_GT(over_white[1], over_red[1] + 50);
  EXPECT_LT(over_white[0], 250);
}

Drawing everything() {
  Drawing drawing;
  drawing.meshes = {square(0.6F, 0.1F, kRed), square(0.3F, 0.6F, kBlue)};
  drawing.meshes[1].opacity = 0.5F;
  drawing.lines = {line({-0.8F, -0.7F, -1}, {0.8F, 0.6F, 1}, kBlack, 3)};
  drawing.points = {{{{-0.8F, -0.7F, -1}, {0.8F, 0.6F, 1}}, {kRed, kBlue}}};
  return drawing;
}

TEST(OpenglRenderer, gives_the_same_bytes_every_time) {
  Camera camera;
  const Picture first = render_picture(everything(), camera, 150, 100);
  EXPECT_EQ(render_picture(everything(), camera, 150, 100), first);
  const OffscreenContext context;
  const std::unique_ptr<Renderer> renderer = make_opengl_renderer();
  renderer->add(everything());
  EXPECT_EQ(renderer->take_picture(camera, 150, 100), first);
  (void)renderer->take_picture(camera, 31, 47);
  EXPECT_EQ(renderer->take_picture(camera, 150, 100), first);
}

TEST(OpenglRenderer, the_shading_changes_meshes_and_nothing_round_them) {
  const OffscreenContext context;
  const std::unique_ptr<Renderer> renderer = make_opengl_renderer();
  renderer->add(square(0.5F, 0, kRed));
  const Picture by_lamps = renderer->take_picture(front_camera(), 60, 60);
  renderer->set_shading(Shading::Matcap);
  const Picture as_ball = renderer->take_picture(front_camera(), 60, 60);
  EXPECT_NE(as_ball.at(30, 30), by_lamps.at(30, 30));
  EXPECT_TRUE(is_reddish(as_ball.at(30, 30)));
  EXPECT_EQ(as_ball.at(5, 30), by_lamps.at(5, 30));
  renderer->set_shading(Shading::Phong);
  EXPECT_EQ(renderer->take_picture(front_camera(), 60, 60), by_lamps);
}

TEST(OpenglRenderer, an_update_gives_the_same_picture_as_adding_anew) {
  const OffscreenContext context;
  const std::unique_ptr<Renderer> updated = make_opengl_renderer();
  const std::unique_ptr<Renderer> fresh = make_opengl_renderer();
  TriangleMesh mesh = square(0.5F, 0, kRed);
  LineSet lines = line({-1, 0, 1}, {1, 0, 1}, kBlue, 4);
  PointSet points{{{0, 0, 1}, {0.5F, 0, 1}}, {kRed, kBlue}};
  const ItemId mesh_id = updated->add(mesh);
  const ItemId lines_id = updated->add(lines);
  const ItemId points_id = updated->add(points);
  const ItemId removed = updated->add(square(0.9F, 1.5F, kBlue));
  const ItemId hidden = updated->add(square(0.9F, 1.5F, kBlue));
  const Picture before = updated->take_picture(front_camera(), 60, 60);

  mesh.positions[2] = {0.9F, 0.8F, 0.3F};
  mesh.normals[1] = {0.6F, 0, 0.8F};
  lines.points[1] = {1, 0.7F, 1};
  lines.colors[0] = kRed;
  points.points[1] = {0.5F, 0.4F, 1};
  points.colors[1] = kBlack;
  updated->update_positions(mesh_id, 2, std::span(mesh.positions).subspan(2, 1));
  updated->update_normals(mesh_id, 1, std::span(mesh.normals).subspan(1, 1));
  updated->update_positions(lines_id, 1, std::span(lines.points).subspan(1, 1));
  updated->update_colors(lines_id, 0, lines.colors);
  updated->update_positions(points_id, 1, std::span(points.points).subspan(1, 1));
  updated->update_colors(points_id, 1, std::span(points.colors).subspan(1, 1));
  updated->remove(removed);
  updated->set_visible(hidden, false);
  fresh->add(mesh);
  fresh->add(lines);
  fresh->add(points);
  const Picture after = updated->take_picture(front_camera(), 60, 60);
  EXPECT_NE(after, before);
  EXPECT_EQ(after, fresh->take_picture(front_camera(), 60, 60));
}

TEST(OpenglRenderer, draws_into_the_bound_frame_buffer_what_it_takes_pictures_of) {
  const OffscreenContext context;
  const std::unique_ptr<Renderer> renderer = make_opengl_renderer();
  renderer->add(everything());
  GLuint color = 0;
  GLuint window = 0;
  glGenRenderbuffers(1, &color);
  glBindRenderbuffer(GL_RENDERBUFFER, color);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 50, 40);
  glGenFramebuffers(1, &window);
  glBindFramebuffer(GL_FRAMEBUFFER, window);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  renderer->draw(Camera(), 50, 40);
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  EXPECT_EQ(static_cast<GLuint>(bound), window);
  Pixel pixel{};
  const Picture expected = renderer->take_picture(Camera(), 50, 40);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, window);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 50; ++x) {
      glReadPixels(x, 39 - y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
      ASSERT_EQ(pixel, expected.at(x, y)) << x << ' ' << y;
    }
  }
  glDeleteFramebuffers(1, &window);
  glDeleteRenderbuffers(1, &color);
}

TEST(OpenglRenderer, lines_run_on_from_tile_to_tile_of_a_large_picture) {
  Drawing drawing = on_white();
  drawing.lines = {line({-90, -0.6F, 1}, {90, 0.6F, 1}, kBlack, 6)};
  drawing.meshes = {square(0.3F, 0, kRed)};
  const Picture picture = render_picture(drawing, front_camera(), 2500, 50);
  const double usual = column_blackness(picture, 1000);
  EXPECT_GT(usual, 4);
  for (int x = 2030; x < 2070; ++x) {
    EXPECT_NEAR(column_blackness(picture, x), usual, 0.5) << x;
  }
  EXPECT_TRUE(is_reddish(picture.at(1250, 20)));
}

TEST(OpenglRenderer, draws_items_without_content) {
  Drawing drawing = on_white();
  drawing.meshes.resize(1);
  drawing.lines.resize(1);
  drawing.points.resize(1);
  EXPECT_EQ(render_picture(drawing, Camera(), 10, 10),
            render_picture(on_white(), Camera(), 10, 10));
}

TEST(OpenglRenderer, refuses_sizes_out_of_range) {
  EXPECT_THROW((void)render_picture({}, Camera(), 0, 10), ParameterError);
  EXPECT_THROW((void)render_picture({}, Camera(), 10, 8193), ParameterError);
}

TEST(OffscreenContext, serves_while_another_one_ends) {
  auto first = std::make_unique<OffscreenContext>();
  const OffscreenContext second;
  first.reset();
  EXPECT_NE(second.description(), ", ");
  const std::unique_ptr<Renderer> renderer = make_opengl_renderer();
  renderer->add(on_white());
  EXPECT_TRUE(is_white(renderer->take_picture(Camera(), 3, 3).at(1, 1)));
}

}  // namespace
}  // namespace espalier::viewer
