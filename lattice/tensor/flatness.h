#pragma once

/// Whether control points have a volume at all.

#include <glm/vec3.hpp>
#include <span>

namespace espalier {

/// Throws LatticeError if all points lie in a plane, to round-off: a lattice at rest of such points
/// holds nothing. O(#points).
void require_thickness(std::span<const glm::dvec3> points);

}  // namespace espalier
