#include "viewer/render/picture.h"

#include <gtest/gtest.h>
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

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "lattice/core/error.h"
#include "lattice/core/file.h"

namespace espalier::viewer {
namespace {

/// Every channel of every pixel is different from its neighbours.
Picture pattern(int width, int height) {
  Picture picture(width, height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    picture.pixels[i] = static_cast<std::uint8_t>(i * i * 31 + i * 7);
  }
  return picture;
}

Picture decoded(const std::string& png) {
  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* pixels =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                            static_cast<int>(png.size()), &width, &height, &channels, 4);
  if (pixels == nullptr) {
    throw Error("not a PNG file");
  }
  Picture picture(width, height);
  std::copy_n(pixels, picture.pixels.size(), picture.pixels.begin());
  stbi_image_free(pixels);
  return picture;
}

TEST(Picture, png_gives_back_every_pixel) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 50}, {1, 300}}) {
    EXPECT_EQ(decoded(encode_png(pattern(width, height))), pattern(width, height));
  }
}

TEST(Picture, is_written_to_a_file_and_replaces_it) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("espalier_picture_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "picture.png").string();
  write_png(path, pattern(9, 4));
  write_png(path, pattern(5, 6));
  EXPECT_EQ(decoded(read_file(path)), pattern(5, 6));
  EXPECT_THROW(write_png((folder / "missing" / "picture.png").string(), pattern(2, 2)), FileError);
  std::filesystem::remove_all(folder);
}

TEST(Picture, counts_rows_from_the_top) {
  Picture picture(3, 2);
  picture.pixels[4 * (1 * 3 + 2) + 1] = 77;
  EXPECT_EQ(picture.at(2, 1), (std::array<std::uint8_t, 4>{0, 77, 0, 0}));
}

TEST(Picture, refuses_sizes_out_of_range) {
  EXPECT_THROW(Picture(0, 5), ParameterError);
  EXPECT_THROW(Picture(5, -1), ParameterError);
  EXPECT_THROW(Picture(8193, 5), ParameterError);
  EXPECT_NO_THROW(Picture(8192, 1));
}

}  // namespace
}  // namespace espalier::viewer
