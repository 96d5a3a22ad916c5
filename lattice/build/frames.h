#pragma once

/// Frames that are carried along bones and paths without turning about them: on a polyline, what
/// the double reflection of W. Wang, B. Jüttler, D. Zheng and Y. Liu, "Computation of rotation
/// minimizing frames", 2008, is for curves.

#include <glm/vec3.hpp>

namespace espalier {

/// `vector` turned the shortest way from one unit vector to another that is not its opposite.
[[nodiscard]] glm::dvec3 carried(const glm::dvec3& vector, const glm::dvec3& from,
                                 const glm::dvec3& to);

/// Moves `offset`, across a bone, along it onto a plane through the origin: how a section meets the
/// plane that halves the angle between two bones. bone: not in the plane.
[[nodiscard]] glm::dvec3 slid_onto_plane(const glm::dvec3& offset, const glm::dvec3& bone,
                                         const glm::dvec3& normal);

}  // namespace espalier
