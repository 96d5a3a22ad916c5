#pragma once

/// Where on a model the mouse is.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/interact/bent_models.h"
#include "viewer/interact/view.h"

namespace espalier::viewer {

/// The point of the models, as they are bent, that is seen at a pixel: model units. None if there
/// is no surface there. O(#triangles).
[[nodiscard]] std::optional<glm::dvec3> surface_point(const View& view, const BentModels& models,
                                                      const glm::dvec2& pixel);

}  // namespace espalier::viewer
