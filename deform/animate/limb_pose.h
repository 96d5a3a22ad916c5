#pragma once

/// Poses of limbs: maps that turn, twist, bend, taper, scale or move a part of space, for the
/// control points of lattices. [B84]

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace espalier {

/// The part of space beyond the plane through a joint across a limb, with a soft edge.
struct LimbRegion {
  glm::dvec3 joint{0};  ///< model units
  glm::dvec3 along{0};  ///< from the joint to what is beyond, of any length; zero: all of space
  double falloff =
      0;  ///< length over which the edge blends, half of it on either side of the joint

  /// How much x takes part: 0 before the edge, 1 beyond it, 3τ² − 2τ³ across it; 1 from the joint
  /// on where the edge is hard.
  [[nodiscard]] double weight(const glm::dvec3& x) const;
};

/// A straight piece of a limb, from joint to joint.
struct Bone {
  glm::dvec3 from{0};
  glm::dvec3 to{0};
};

// All maps keep what they do not move, and everything if they turn by 0° or scale by 1, bit for
// bit. points: model units. They throw ParameterError naming an argument that is not finite or that
// has no direction.

/// Turns the region about an axis through its joint: by `degrees` times the weight. With h the
/// distance of a point from the joint across limb and axis, to the inner side, the determinant is
/// 1 − θ h dweight/ds: nothing folds where the falloff is above 3/2 θ h.
[[nodiscard]] std::vector<glm::dvec3> turned(std::span<const glm::dvec3> points,
                                             const LimbRegion& region, const glm::dvec3& axis,
                                             double degrees);

/// x' = joint + S (x − joint), S = 1 + weight (factors − 1) along x, y, z. Throws ParameterError
/// for a factor that is not positive.
[[nodiscard]] std::vector<glm::dvec3> scaled(std::span<const glm::dvec3> points,
                                             const LimbRegion& region, const glm::dvec3& factors);

/// x' = x + weight · by.
[[nodiscard]] std::vector<glm::dvec3> moved(std::span<const glm::dvec3> points,
                                            const LimbRegion& region, const glm::dvec3& by);

/// [B84] axial twist: turns about the bone, from 0 at its begin at an even rate to `degrees` at its
/// end and beyond. Keeps volumes.
[[nodiscard]] std::vector<glm::dvec3> twisted(std::span<const glm::dvec3> points, const Bone& bone,
                                              double degrees);

/// [B84] bend: the bone becomes an arc of its own length that turns by `degrees` to the side that
/// `towards` points to; what is before it stays, what is beyond follows rigidly. With curvature κ
/// and h the distance to that side the determinant is 1 − κ h: nothing folds nearer than the arc's
/// centre.
[[nodiscard]] std::vector<glm::dvec3> bent(std::span<const glm::dvec3> points, const Bone& bone,
                                           const glm::dvec3& towards, double degrees);

/// [B84] taper: scales across the bone, by 1 at its begin, changing evenly to `scale` at its end
/// and beyond. Throws ParameterError unless the scale is positive.
[[nodiscard]] std::vector<glm::dvec3> tapered(std::span<const glm::dvec3> points, const Bone& bone,
                                              double scale);

/// How far from the joint the plane across `along` cuts the edges of a net: half a limb's thickness
/// there. 0 if it cuts none. net: #edges × 2 points.
[[nodiscard]] double cut_radius(std::span<const glm::dvec3> points,
                                std::span<const std::array<std::int32_t, 2>> net,
                                const glm::dvec3& joint, const glm::dvec3& along);

}  // namespace espalier
