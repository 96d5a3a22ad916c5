#pragma once

/// How a place of a rational patch moves when its weights change too.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/volume/bezier_patch.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// a − b as one rational patch of the sum of their degrees, exactly; zero, bit for bit, where both
/// have the same points and weights. Both of one degree, rational or not. O(#points²).
[[nodiscard]] BezierPatch difference(const BezierView& a, const BezierView& b);

/// X_pose − X_rest on patch i, for points displaced and with weights of their own: x' = x + its
/// value. With weights as at rest it is what Volume::bezier() makes of displacements, which is
/// linear and much cheaper. displacements, weights: #points of the volume.
[[nodiscard]] BezierPatch rational_motion(const Volume& volume, std::size_t i,
                                          std::span<const glm::dvec3> displacements,
                                          std::span<const double> weights);

}  // namespace espalier
