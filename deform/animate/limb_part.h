#pragma once

/// Which part of a lattice is a limb.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

/// What a cut at a joint parts from the rest.
struct LimbPart {
  std::vector<double> shares;  ///< #points, 0 to 1: of each, in how the limb moves
  std::size_t n_parted = 0;    ///< points that the cut parts from the rest; 0 without a cut
  double radius = 0;           ///< of the cut: half the limb's thickness there
};

/// Cuts the edges of a net in the plane through the joint across `along`, those nearest to the
/// joint first, until what is beyond the joint hangs together with what is before it no more: that
/// is the limb, and other parts beyond the plane are not. Of what is before, where a limb's motion
/// fades, points up to the cut's radius from the limb's axis take part in all of it, from twice the
/// radius on in none. Nothing on one side of the plane: all points take part. net: #edges × 2
/// points, model units. O(#edges log #edges).
[[nodiscard]] LimbPart limb_part(std::span<const glm::dvec3> points,
                                 std::span<const std::array<std::int32_t, 2>> net,
                                 const glm::dvec3& joint, const glm::dvec3& along);

}  // namespace espalier
