#pragma once

/// Models made denser: in their own file, with all that it says of their faces.

#include <string>

#include "deform/model/dense_mesh.h"
#include "deform/model/model.h"

namespace espalier {

/// The model with edges of at most `longest`, by densified(). New points, texture coordinates and
/// normals stand before the first face, and in the place of a face that was cut stand its parts, so
/// that groups, objects, materials, smoothing groups and comments stay as they are; further numbers
/// of points (colours) are interpolated. The model itself if nothing is to be done. path: kept as
/// the model's. Throws ParameterError as densified(), for a file that is no OBJ or has free-form
/// curves or surfaces, and if the model has no faces.
[[nodiscard]] Model dense_model(const Model& model, DensifyMethod method, double longest,
                                std::string path, const Progress& progress = {});

}  // namespace espalier
