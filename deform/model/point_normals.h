#pragma once

/// Normals for models whose files write one for each point.

#include <string>

#include "deform/model/model.h"
#include "deform/model/normals.h"

namespace espalier {

/// The file of a model, OFF or PLY, with normals after the coordinates or properties of its points;
/// (0, 0, 0) at one that no face has. A point with several keeps its number for the first of them;
/// for the others it stands once more, with all that the file says of it, after all points, and
/// corners name these. added: of the model's points. Throws ParameterError for a PLY file that has
/// some of nx, ny and nz, or no room for more points in the type of its corners.
[[nodiscard]] std::string bytes_with_point_normals(const Model& model, const CornerNormals& added);

}  // namespace espalier
