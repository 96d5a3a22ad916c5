#pragma once

/// Faces as triangles.

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

using Triangle = std::array<glm::dvec3, 3>;

/// Appends the triangles of a face, wound like its loop: a fan round the centroid, or, where that
/// would leave the face because its loop is concave, a triangulation without new points.
/// loop: three points or more.
void append_face_triangles(std::span<const glm::dvec3> loop, std::vector<Triangle>& triangles);

/// Twice the area vector of a loop.
[[nodiscard]] glm::dvec3 area_vector(std::span<const glm::dvec3> loop);

/// Distances from a point.
[[nodiscard]] double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a,
                                         const glm::dvec3& b);
[[nodiscard]] double distance_to_triangle(const glm::dvec3& point, const Triangle& triangle);

/// Half the solid angle under which a point sees a triangle, positive from behind; A. van Oosterom
/// and J. Strackee, "The solid angle of a plane triangle", 1983.
[[nodiscard]] double half_angle(const glm::dvec3& point, const Triangle& triangle);

}  // namespace espalier
