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

/// The solid angle of a triangle seen from a point, 4π for all directions: positive where the
/// triangle is counter-clockwise seen from the other side, as that of a surface is from inside.
[[nodiscard]] double solid_angle(const glm::dvec3& point, const Triangle& triangle);

/// How often triangles wind round a point: 1 inside a closed surface whose triangles are
/// counter-clockwise seen from outside, 0 outside, between where it is open [JKS13].
/// O(#triangles).
[[nodiscard]] double winding_number(const glm::dvec3& point, std::span<const Triangle> triangles);

/// Distances from a point.
[[nodiscard]] double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a,
                                         const glm::dvec3& b);
[[nodiscard]] double distance_to_triangle(const glm::dvec3& point, const Triangle& triangle);

}  // namespace espalier
