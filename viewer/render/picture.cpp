#include "viewer/render/picture.h"

#include "lattice/core/error.h"
#include "lattice/core/file.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace espalier::viewer {
namespace {

void append_bytes(void* target, void* bytes, int size) {
  static_cast<std::string*>(target)->append(static_cast<const char*>(bytes),
                                            static_cast<std::size_t>(size));
}

}  // namespace

void check_picture_size(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestPictureSide || height > kLargestPictureSide) {
    throw ParameterError("a picture of " + std::to_string(width) + " × " + std::to_string(height) +
                         " pixels: each side must be in 1 … " +
                         std::to_string(kLargestPictureSide));
  }
}

Picture::Picture(int the_width, int the_height) : width(the_width), height(the_height) {
  check_picture_size(width, height);
  pixels.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

std::string encode_png(const Picture& picture) {
  std::string bytes;
  if (stbi_write_png_to_func(append_bytes, &bytes, picture.width, picture.height, 4,
                             picture.pixels.data(), 4 * picture.width) == 0) {
    throw Error("encode_png: not enough memory for the picture");
  }
  return bytes;
}

void write_png(const std::string& path, const Picture& picture) {
  write_file(path, encode_png(picture));
}

}  // namespace espalier::viewer
