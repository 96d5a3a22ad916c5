#pragma once

/// Models as their lattices bend them, while these are moved.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "viewer/interact/session.h"

namespace espalier::viewer {

/// Where a model's points are on the screen: bent in Pose mode, with a transform in progress; at
/// rest in other modes. #points. O(#points · degree³) where lattices move.
[[nodiscard]] std::vector<glm::dvec3> shown_points(const Session& session,
                                                   const std::string& model);

}  // namespace espalier::viewer
