#pragma once

/// Pictures in memory and as PNG files.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::viewer {

/// The longest side of a picture, in pixels.
inline constexpr int kLargestPictureSide = 8192;

/// Throws ParameterError unless both sides are in 1 … kLargestPictureSide.
void check_picture_size(int width, int height);

/// Red, green, blue (sRGB) and opacity, 8 bits each; top row first.
struct Picture {
  /// All pixels zero. Throws ParameterError as check_picture_size.
  Picture(int width, int height);

  int width;
  int height;
  std::vector<std::uint8_t> pixels;  ///< height × width × 4

  /// Column x and row y count from the top left corner.
  [[nodiscard]] std::array<std::uint8_t, 4> at(int x, int y) const {
    const std::size_t i = 4 * (static_cast<std::size_t>(y) * width + x);
    return {pixels[i], pixels[i + 1], pixels[i + 2], pixels[i + 3]};
  }
  bool operator==(const Picture&) const = default;
};

/// The bytes of a PNG file.
[[nodiscard]] std::string encode_png(const Picture& picture);

/// Replaces the file at `path`, or leaves it as it was. Throws FileError.
void write_png(const std::string& path, const Picture& picture);

}  // namespace espalier::viewer
