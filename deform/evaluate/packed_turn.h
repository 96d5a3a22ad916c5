#pragma once

/// How a normal turns in a drag, in four numbers: drags are bound by the memory that they read.

#include <glm/vec3.hpp>

namespace espalier {

/// The direction n + D × m as a function of the displacement D, for m ⟂ n. With m = n × q it goes
/// along n (1 + D · q) − q (D · n), whatever multiple of n is added to q and whatever factor n has.
/// So |x| + |y| + |z| = 1 for n, and σ · q = 0 for the signs σ of n: that gives the z of both but
/// for the sign of n's, which is minus where the last bit of qx is 1.
template <class Real>
struct PackedTurn {
  Real x = 0;
  Real y = 0;
  Real qx = 0;
  Real qy = 0;
};

/// m is shortened to 10⁶ |n| / unit, so that a displacement of 10¹² units stays within the range of
/// floats; where n is zero it stands for something perpendicular to m. Where both are zero the
/// square of the direction's length is infinite.
template <class Real>
[[nodiscard]] PackedTurn<Real> packed_turn(const glm::dvec3& n, const glm::dvec3& m, double unit);

}  // namespace espalier
