#pragma once

/// Models that are made, not read.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "deform/model/model.h"

namespace espalier {

/// An OBJ model of polygons; its file has one point and one face a line.
/// points: model units; faces: loops of points; path: kept as the model's.
[[nodiscard]] Model make_obj_model(std::span<const glm::dvec3> points,
                                   const CompressedRows<std::int32_t>& faces, std::string path);

/// The model's faces as a Catmull-Clark surface refined `levels` times, a model of points and faces
/// alone. Throws ParameterError as osd::refine_surface does.
[[nodiscard]] Model refined_model(const Model& model, int levels, std::string path);

}  // namespace espalier
