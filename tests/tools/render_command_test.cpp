#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <cstdlib>

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"
#include "viewer/render/picture.h"

namespace espalier::tools {
namespace {

class RenderCommand : public CommandLineTest {};

viewer::Picture decoded(const std::string& path) {
  const std::string png = read_file(path);
  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* pixels =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                            static_cast<int>(png.size()), &width, &height, &channels, 4);
  if (pixels == nullptr) {
    ADD_FAILURE() << path << " is no PNG file";
    return {1, 1};
  }
  viewer::Picture picture(width, height);
  std::copy_n(pixels, picture.pixels.size(), picture.pixels.begin());
  stbi_image_free(pixels);
  return picture;
}

/// The fraction of pixels that differ from the one at the left end of their row.
double covered(const viewer::Picture& picture) {
  int n = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      int difference = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        difference += std::abs(picture.at(x, y)[c] - picture.at(0, y)[c]);
      }
      n += difference > 20 ? 1 : 0;
    }
  }
  return static_cast<double>(n) / (picture.width * picture.height);
}

TEST_F(RenderCommand, draws_a_model_large_and_in_the_middle_at_the_size_asked_for) {
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(done({"render", "cube.obj", "--size", "160x120", "-o", "cube.png"}),
            "cube.png: 160 x 120 pixels\n");
  const viewer::Picture picture = decoded("cube.png");
  EXPECT_EQ(picture.width, 160);
  EXPECT_EQ(picture.height, 120);
  EXPECT_GT(covered(picture), 0.25);
  EXPECT_LT(covered(picture), 0.8);
  EXPECT_NE(picture.at(80, 60), picture.at(0, 60));
}

TEST_F(RenderCommand, draws_a_posed_lattice_posed_unless_asked_for_rest) {
  done({"new", "box", "-o", "box.json"});
  pose_by("box.json", "posed.json",
          [](const glm::dvec3& x) { return glm::dvec3(4.0 * x.x + x.y, x.y, x.z); });
  const auto picture = [](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", file, "--size", "80x60", "-o", "p.png", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(done(words), "");
    return decoded("p.png");
  };
  EXPECT_EQ(picture("posed.json", {"--rest"}), picture("box.json", {}));
  EXPECT_NE(picture("posed.json", {}), picture("box.json", {}));
  EXPECT_NE(picture("posed.json", {"--view", "top"}), picture("posed.json", {"--view", "front"}));
  EXPECT_EQ(picture("posed.json", {"--view", "-30,-.5"}),
            picture("posed.json", {"--view", "330,-0.5"}));
  EXPECT_NE(picture("box.json", {"--levels", "2"}), picture("box.json", {}));
}

TEST_F(RenderCommand, reports_as_json) {
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(Json::parse(done({"render", "cube.obj", "--size", "8x6", "-o", "p.PNG", "--json"})),
            Json::parse(R"({"output": "p.PNG", "width": 8, "height": 6})"));
}

TEST_F(RenderCommand, takes_files_before_and_after_its_options) {
  write_file("cube.obj", cube_obj());
  done({"new", "box", "--max", "2", "2", "2", "-o", "box.json"});
  done({"render", "cube.obj", "-o", "a.png", "--size", "40x30", "box.json"});
  done({"render", "cube.obj", "box.json", "-o", "b.png", "--size", "40x30"});
  EXPECT_EQ(decoded("a.png"), decoded("b.png"));
}

TEST_F(RenderCommand, refuses_sizes_views_and_names_that_are_none) {
  write_file("cube.obj", cube_obj());
  const auto refused = [](const std::string& option, const std::string& value) {
    return refusal({"render", "cube.obj", option, value, "-o", "p.png"}, 2);
  };
  for (const std::string size :
       {"0x5", "5x0", "-3x4", "5", "x", "5x", "99999x1", "1e2x5", "5x5x5"}) {
    EXPECT_EQ(refused("--size", size),
              "--size is '" + size + "', must be WIDTHxHEIGHT with sides from 1 to 8192");
  }
  EXPECT_EQ(refused("--view", "1,2,3"),
            "--view is '1,2,3', must be a name or AZIMUTH,ELEVATION in degrees, such as 30,20");
  EXPECT_EQ(refused("--view", "up"),
            "the view is 'up', it must be one of front, back, left, right, top, bottom, iso, "
            "three-quarter");
  EXPECT_EQ(refused("--up", "x"), "--up must be one of: y, z");
  EXPECT_EQ(refused("--levels", "7"), "--levels must be 0 to 6");
  EXPECT_EQ(refusal({"render", "cube.obj", "-o", "p.jpg"}, 1),
            "p.jpg: a picture's name must end in .png");
  EXPECT_EQ(files(), std::vector<std::string>{"cube.obj"});
}

}  // namespace
}  // namespace espalier::tools
