#pragma once

/// Moving control points on both sides of a lattice's middle.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier::viewer {

/// For each control point the one that stands, at rest, where a mirror across a plane through the
/// middle of the lattice's box would show it; itself on the plane, -1 where none is, within 1e-6 of
/// the box's radius. rest: #controls; axis: across the plane. O(n log n).
[[nodiscard]] std::vector<std::int32_t> mirror_images(std::span<const glm::dvec3> rest, int axis);

/// Gives control points that move to their mirror images as well: from `start`, at mouse-down, to
/// `to`. An image that moves itself keeps its own motion; a point on the plane stays on it. images:
/// as mirror_images(). All #controls.
void mirror_motion(std::span<const glm::dvec3> start, std::span<const std::int32_t> images,
                   int axis, std::vector<glm::dvec3>& to);

}  // namespace espalier::viewer
