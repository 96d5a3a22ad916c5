#include "viewer/render/model_texture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/core/text_scanner.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_MAX_DIMENSIONS 8192
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace espalier::viewer {
namespace {

/// Of pictures together, and of the file of one.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr TextSyntax kSyntax{.comment = '#', .joins_lines = true};

std::string beside(const std::string& path, std::string_view name) {
  std::string file(name);
  std::replace(file.begin(), file.end(), '\\', '/');
  return (std::filesystem::path(path).parent_path() / file).string();
}

/// Pictures by material.
void read_materials(const std::string& path, std::map<std::string, std::string>& pictures) {
  const std::string text = read_file(path);
  TextScanner lines(path, text, kSyntax);
  std::string material;
  while (lines.next_line()) {
    const std::string_view keyword = lines.next_word();
    if (keyword == "newmtl") {
      material = lines.next_name();
    } else if (keyword == "map_Kd") {
      std::string_view name;  // the last word: options stand before it
      for (std::string_view word = lines.next_name(); !word.empty(); word = lines.next_name()) {
        name = word;
      }
      pictures[material] = beside(path, name);
    }
  }
}

/// What the lines of an OBJ file say about pictures.
class TextureScanner {
 public:
  explicit TextureScanner(const Model& model) : model_(model) {}

  std::optional<ModelTexture> scan() {
    TextScanner lines(model_.path(), model_.bytes(), kSyntax);
    while (lines.next_line()) {
      const std::string_view keyword = lines.next_word();
      if (keyword == "vt") {
        const double u = lines.next_number("u");
        const std::string_view v = lines.next_word();
        double number = 0;
        places_.emplace_back(u, parse_number(v, number) ? number : 0.0);
      } else if (keyword == "f") {
        add_face(lines);
      } else if (keyword == "usemtl") {
        material_ = lines.next_name();
      } else if (keyword == "mtllib") {
        read_materials(beside(model_.path(), lines.next_name()), pictures_);
      }
    }
    const bool is_whole = texture_.corner_places.size() == model_.faces().n_values();
    if (!is_whole || !read_pictures()) {
      return std::nullopt;
    }
    return std::move(texture_);
  }

 private:
  void add_face(TextScanner& lines) {
    const auto found = pictures_.find(material_);
    const bool is_covered = found != pictures_.end();
    texture_.face_groups.push_back(is_covered ? group_of(found->second) : 0);
    for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word()) {
      texture_.corner_places.push_back(is_covered ? place_of(word) : kNoPlace);
    }
  }

  std::int32_t group_of(const std::string& picture) {
    const auto next = static_cast<std::int32_t>(groups_.size()) + 1;
    return groups_.emplace(picture, next).first->second;
  }

  /// False if none can be.
  bool read_pictures() {
    texture_.pictures.resize(groups_.size());
    std::size_t n_bytes = 0;
    bool has_some = false;
    for (const auto& [path, group] : groups_) {
      try {
        auto picture = std::make_shared<const Picture>(read_picture(path));
        n_bytes += picture->pixels.size();
        if (n_bytes <= kMostBytes) {
          texture_.pictures[static_cast<std::size_t>(group - 1)] = std::move(picture);
          has_some = true;
        }
      } catch (const Error&) {
        continue;  // its faces have the model's colour
      }
    }
    return has_some;
  }

  /// Of "v/vt/vn": numbers below 0 count from the last.
  [[nodiscard]] glm::vec2 place_of(std::string_view word) const {
    const std::size_t begin = word.find('/');
    if (begin == std::string_view::npos) {
      return kNoPlace;
    }
    word.remove_prefix(begin + 1);
    std::int64_t number = 0;
    const auto n = static_cast<std::int64_t>(places_.size());
    if (!parse_integer(word.substr(0, word.find('/')), number) || number == 0 || number > n ||
        number < -n) {
      return kNoPlace;
    }
    const glm::vec2 place(places_[static_cast<std::size_t>(number > 0 ? number - 1 : n + number)]);
    return std::isfinite(place.x) && std::isfinite(place.y) ? place : kNoPlace;
  }

  const Model& model_;
  std::vector<glm::dvec2> places_;
  std::map<std::string, std::string> pictures_;
  std::string material_;
  std::map<std::string, std::int32_t> groups_;  // by picture, from 1
  ModelTexture texture_;
};

}  // namespace

Picture read_picture(const std::string& path) {
  const std::string bytes = read_file(path);
  int width = 0;
  int height = 0;
  int n_channels = 0;
  if (bytes.size() > kMostBytes) {
    throw FileError(path, "is too large for a picture");
  }
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),  // NOLINT: bytes
                            static_cast<int>(bytes.size()), &width, &height, &n_channels, 4),
      stbi_image_free);
  if (!pixels) {
    throw FileError(path, std::string("is no picture that can be read: ") + stbi_failure_reason());
  }
  Picture picture(width, height);
  std::copy_n(pixels.get(), picture.pixels.size(), picture.pixels.begin());
  return picture;
}

std::vector<TextureRange> texture_ranges(const ModelTexture& texture,
                                         std::span<const std::size_t> group_sizes) {
  std::vector<TextureRange> ranges;
  for (std::size_t group = 0; group < group_sizes.size(); ++group) {
    ranges.push_back({group_sizes[group], group == 0 ? nullptr : texture.pictures[group - 1]});
  }
  return ranges;
}

std::optional<ModelTexture> find_texture(const Model& model) {
  if (model.format() != ModelFormat::Obj) {
    return std::nullopt;
  }
  try {
    return TextureScanner(model).scan();
  } catch (const Error&) {
    return std::nullopt;  // a model without its pictures is a model
  }
}

}  // namespace espalier::viewer
