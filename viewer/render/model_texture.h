#pragma once

/// The picture that an OBJ model's material puts on it.

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deform/model/model.h"
#include "viewer/render/picture.h"

namespace espalier::viewer {

/// A place of corners that the picture does not cover.
inline constexpr glm::vec2 kNoPlace{-1e4F, -1e4F};

struct ModelTexture {
  std::vector<glm::vec2> corner_places;  ///< #corners of the model's faces; v grows upward
  std::shared_ptr<const Picture> picture;
};

/// Reads PNG, JPEG, TGA or BMP. Throws FileError for a file that cannot be read or is too large.
[[nodiscard]] Picture read_picture(const std::string& path);

/// The first picture that a material in use has as its map_Kd, beside the model's file; other
/// materials' corners have kNoPlace. Nothing for a model without, or whose picture cannot be read.
[[nodiscard]] std::optional<ModelTexture> find_texture(const Model& model);

}  // namespace espalier::viewer
