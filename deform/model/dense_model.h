#pragma once

/// Models made denser: in their own file, with all that it says of their faces.

#include <string>

#include "deform/model/dense_mesh.h"
#include "deform/model/model.h"

namespace espalier {

/// The model with edges of at most `longest`, by densified(). In the place of a face that was cut
/// stand its parts, so that groups, objects, materials, smoothing groups, colours of faces and
/// comments stay as they are. New points stand after the old ones, in OBJ files with their texture
/// coordinates and normals before the first face; further numbers of points (colours, properties of
/// PLY files) are interpolated. STL files, of triangles alone, get quadrilaterals in halves. The
/// model itself if nothing is to be done. path: kept as the model's. Throws ParameterError as
/// densified(), for an OBJ file with free-form curves or surfaces, for a PLY file whose numbers of
/// points have a type too small for more, and if the model has no faces.
[[nodiscard]] Model dense_model(const Model& model, DensifyMethod method, double longest,
                                std::string path, const Progress& progress = {});

}  // namespace espalier
