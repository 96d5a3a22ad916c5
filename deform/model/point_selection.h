#pragma once

/// Which points of a model take part, and how much.

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "deform/model/model.h"

namespace espalier {

/// Weights of the points in [0, 1], or nothing if all are 1.
///
/// only: names of groups or objects, whose faces' corners take part, and "@FILE" for a text file of
/// point indices, one a line, from 0; a point takes part if one of them has it. None: all do. Other
/// points get weight 0.
/// weights_file: a text file of one number in [0, 1] a line, as many as the model has points; ""
/// for none. In both files '#' starts a comment, and empty lines are skipped.
///
/// Throws ParameterError for a name the model has not, telling some that it has; FileError, naming
/// file and line, for an index or weight that is none or out of range, and for a wrong number of
/// weights.
[[nodiscard]] std::vector<double> point_weights(const Model& model,
                                                std::span<const std::string> only,
                                                const std::string& weights_file);

/// The points that take part, in their order. only: as above. Throws as point_weights().
[[nodiscard]] std::vector<glm::dvec3> selected_points(const Model& model,
                                                      std::span<const std::string> only);

}  // namespace espalier
