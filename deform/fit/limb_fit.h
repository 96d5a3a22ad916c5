#pragma once

/// Lattices round limbs whose joints are given.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier {

/// The part of a surface that a chain of joints runs through, from the body on. Rays from the
/// bones, across them, meet it first; it goes on from there over the edges of faces, but neither
/// past the plane across the first bone at the first joint nor past that across the last bone at
/// the last joint; nor, where the first bone is nearest, farther from it than two and a half times
/// the way of its middle ray, since there the body begins; nor, on a closed surface, to where that
/// looks back at the bone, as another limb would. Without faces: all points between the two planes.
/// joints: two or more, consecutive ones different. Points in increasing order. O(72 #bones
/// #faces).
[[nodiscard]] std::vector<std::int32_t> limb_points(std::span<const glm::dvec3> points,
                                                    const CompressedRows<std::int32_t>& faces,
                                                    std::span<const glm::dvec3> joints);

/// How many points lie beyond the ends of a chain of joints.
[[nodiscard]] std::size_t count_beyond_ends(std::span<const glm::dvec3> points,
                                            std::span<const glm::dvec3> joints);

/// A radius for each joint, so that a bar round each bone whose radius changes evenly from joint to
/// joint holds the points nearest to that bone, with `margin` to spare: as near to them as even
/// changes allow, and at no joint below a quarter of a neighbour's.
[[nodiscard]] std::vector<double> limb_radii(std::span<const glm::dvec3> points,
                                             std::span<const glm::dvec3> joints, double margin);

/// The points moved away from the bones by `distance`.
[[nodiscard]] std::vector<glm::dvec3> moved_off_bones(std::span<const glm::dvec3> points,
                                                      std::span<const glm::dvec3> joints,
                                                      double distance);

}  // namespace espalier
