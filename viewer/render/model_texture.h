#pragma once

/// The pictures that an OBJ model's materials put on it.

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/model/model.h"
#include "viewer/render/drawing.h"
#include "viewer/render/picture.h"

namespace espalier::viewer {

/// A place of corners that the picture does not cover.
inline constexpr glm::vec2 kNoPlace{-1e4F, -1e4F};

struct ModelTexture {
  std::vector<glm::vec2> corner_places;   ///< #corners of the model's faces; v grows upward
  std::vector<std::int32_t> face_groups;  ///< #faces: 0 without a picture, i with pictures[i − 1]
  std::vector<std::shared_ptr<const Picture>> pictures;
};

/// What triangles in the order of their groups wear. group_sizes: indices of each group.
[[nodiscard]] std::vector<TextureRange> texture_ranges(const ModelTexture& texture,
                                                       std::span<const std::size_t> group_sizes);

/// Reads PNG, JPEG, TGA or BMP. Throws FileError for a file that cannot be read or is too large.
[[nodiscard]] Picture read_picture(const std::string& path);

/// The pictures that materials in use have as their map_Kd, beside the model's file; corners of
/// other materials have kNoPlace. What cannot be read, or is more than a gigabyte in all, is left
/// out; nothing for a model without any.
[[nodiscard]] std::optional<ModelTexture> find_texture(const Model& model);

}  // namespace espalier::viewer
