#include "viewer/render/model_texture.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "deform/model/model_file.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "tests/support/temporary_folder.h"
#include "viewer/render/mesh_drawing.h"
#include "viewer/render/null_renderer.h"
#include "viewer/render/offscreen_context.h"
#include "viewer/render/opengl_renderer.h"

namespace espalier::viewer {
namespace {

constexpr const char* kObj =
    "mtllib m.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl painted\nf 1/1 2/2 3/3 4/-1\n"
    "usemtl plain\nf 2/1 5/2 3/3\n";

/// A folder with an OBJ file, its materials, and a picture: left half red, right half green.
class ModelTextureTest : public ::testing::Test {
 protected:
  ModelTextureTest() {
    write_file(path("m.mtl"), "newmtl plain\nKd 1 1 1\nnewmtl painted\nmap_Kd -s 1 1 1 p.png\n");
    Picture picture(64, 64);
    for (std::size_t i = 0; i < 64 * 64; ++i) {
      picture.pixels[4 * i + (i % 64 < 32 ? 0 : 1)] = 255;
      picture.pixels[4 * i + 3] = 255;
    }
    write_png(path("p.png"), picture);
    write_file(path("m.obj"), kObj);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }

  test::TemporaryFolder folder_;
};

TEST_F(ModelTextureTest, reads_places_of_corners_and_the_picture_of_their_material) {
  const auto texture = find_texture(read_model(path("m.obj")));
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->corner_places,
            (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, kNoPlace, kNoPlace, kNoPlace}));
  EXPECT_EQ(texture->pictures.at(0)->at(5, 5), (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
  EXPECT_EQ(texture->pictures.at(0)->at(60, 5), (std::array<std::uint8_t, 4>{0, 255, 0, 255}));
}

TEST_F(ModelTextureTest, a_model_without_its_picture_is_drawn_without) {
  write_file(path("p.png"), "no picture");
  EXPECT_FALSE(find_texture(read_model(path("m.obj"))));
  EXPECT_THROW((void)read_picture(path("p.png")), FileError);
  std::filesystem::remove(path("m.mtl"));
  EXPECT_FALSE(find_texture(read_model(path("m.obj"))));
  write_file(path("m.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  EXPECT_FALSE(find_texture(read_model(path("m.obj"))));
}

TEST_F(ModelTextureTest, references_to_places_that_are_none_are_no_places) {
  write_file(path("m.obj"), "mtllib m.mtl\nusemtl painted\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const auto texture = find_texture(read_model(path("m.obj")));
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->corner_places, std::vector<glm::vec2>(3, kNoPlace));
}

TEST_F(ModelTextureTest, points_are_several_vertices_where_their_places_differ) {
  const Model model = read_model(path("m.obj"));
  const auto texture = find_texture(model);
  const MeshDrawing drawing(model.points(), model.faces(),
                            {.corner_places = texture->corner_places});
  EXPECT_EQ(drawing.n_vertices(), 7u);
  EXPECT_EQ(drawing.vertex_places().size(), 7u);
  EXPECT_EQ(MeshDrawing(model.points(), model.faces()).n_vertices(), 5u);
  EXPECT_THROW(MeshDrawing(model.points(), model.faces(),
                           {.corner_places = std::span(texture->corner_places).first(2)}),
               ParameterError);
}

/// A model `width` long and 1 high from the front, in its textures: 100 pixels a unit.
Picture front_picture(const Model& model, int width) {
  const auto texture = find_texture(model);
  const MeshDrawing drawing(
      model.points(), model.faces(),
      {.corner_places = texture->corner_places, .face_groups = texture->face_groups});
  TriangleMesh mesh = drawing.triangle_mesh(model.points());
  mesh.textures = texture_ranges(*texture, drawing.group_sizes());
  const OffscreenContext context;
  const auto renderer = make_opengl_renderer();
  renderer->add(mesh);
  Camera camera;
  camera.angles = named_view("front");
  camera.projection = Projection::Orthographic;
  Box box;
  box.add(glm::dvec3(0, 0, 0));
  box.add(glm::dvec3(width, 1, 0));
  return renderer->take_picture(camera.fitted_to(box, width, 0), 100 * width, 100);
}

TEST_F(ModelTextureTest, the_picture_is_seen_the_right_way_round_and_only_where_it_is) {
  const Picture picture = front_picture(read_model(path("m.obj")), 2);
  const auto left = picture.at(25, 50);
  const auto right = picture.at(75, 50);
  const auto clay = picture.at(120, 80);
  EXPECT_GT(left[0], 3 * left[1]);
  EXPECT_GT(right[1], 3 * right[0]);
  EXPECT_GT(clay[1], 80);
  EXPECT_GT(clay[0], clay[2]);
}

/// Three squares in a row along x, with a picture all red, one all green, and one that is missing.
TEST_F(ModelTextureTest, every_material_is_seen_with_its_own_picture) {
  const auto write_color = [&](const char* name, std::size_t channel) {
    Picture picture(8, 8);
    for (std::size_t i = 0; i < 64; ++i) {
      picture.pixels[4 * i + channel] = picture.pixels[4 * i + 3] = 255;
    }
    write_png(path(name), picture);
  };
  write_color("red.png", 0);
  write_color("green.png", 1);
  write_file(path("m.mtl"),
             "newmtl a\nmap_Kd red.png\nnewmtl b\nmap_Kd green.png\nnewmtl c\nmap_Kd none.png\n");
  std::string obj = "mtllib m.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  for (int x = 0; x < 4; ++x) {
    obj += "v " + std::to_string(x) + " 0 0\nv " + std::to_string(x) + " 1 0\n";
  }
  obj += "usemtl b\nf 3/1 5/2 6/3 4/4\nusemtl a\nf 1/1 3/2 4/3 2/4\n";
  obj += "usemtl c\nf 5/1 7/2 8/3 6/4\n";
  write_file(path("m.obj"), obj);
  const Model model = read_model(path("m.obj"));
  const auto texture = find_texture(model);
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->pictures.size(), 3u);
  const MeshDrawing drawing(
      model.points(), model.faces(),
      {.corner_places = texture->corner_places, .face_groups = texture->face_groups});
  EXPECT_EQ(drawing.group_sizes(), (std::vector<std::size_t>{0, 6, 6, 6}));
  const Picture picture = front_picture(model, 3);
  const auto red = picture.at(50, 50);
  const auto green = picture.at(150, 50);
  const auto clay = picture.at(250, 50);
  EXPECT_GT(red[0], 3 * red[1]);
  EXPECT_GT(green[1], 3 * green[0]);
  EXPECT_GT(clay[1], 80);
  EXPECT_GT(clay[0], clay[2]);
}

TEST_F(ModelTextureTest, ranges_that_do_not_hold_all_triangles_are_refused) {
  NullRenderer renderer;
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::vec3>(3), {0, 1, 2}};
  mesh.places.resize(3);
  mesh.textures = {{2, nullptr}};
  EXPECT_THROW((void)renderer.add(mesh), ParameterError);
  mesh.textures = {{3, nullptr}};
  EXPECT_NO_THROW((void)renderer.add(mesh));
  const Model model = read_model(path("m.obj"));
  const std::array<std::int32_t, 1> groups{};
  EXPECT_THROW(MeshDrawing(model.points(), model.faces(), {.face_groups = groups}), ParameterError);
}

}  // namespace
}  // namespace espalier::viewer
