#include "deform/evaluate/packed_turn.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

namespace espalier {
namespace {

constexpr double kLongestTurn = 1e6;

double length1(const glm::dvec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Across m, and across the longest of its numbers.
glm::dvec3 perpendicular(const glm::dvec3& m) {
  const glm::dvec3 size = glm::abs(m);
  return size.x > size.y && size.x > size.z ? glm::dvec3(-m.y, m.x, 0) : glm::dvec3(0, -m.z, m.y);
}

template <class Real>
Real with_last_bit(Real number, bool bit) {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  return std::bit_cast<Real>((std::bit_cast<Bits>(number) & ~Bits{1}) | Bits{bit});
}

}  // namespace

template <class Real>
PackedTurn<Real> packed_turn(const glm::dvec3& n, const glm::dvec3& m, double unit) {
  const double longest = length1(m);
  if (length1(n) == 0 && longest == 0) {
    const Real beyond = 4 * std::sqrt(std::numeric_limits<Real>::max());
    return {beyond, beyond};
  }
  const glm::dvec3 start = length1(n) > 0 ? n : perpendicular(m / longest);
  PackedTurn<Real> turn;
  turn.x = static_cast<Real>(start.x / length1(start));
  turn.y = static_cast<Real>(start.y / length1(start));
  const glm::dvec3 sign(std::copysign(1, turn.x), std::copysign(1, turn.y),
                        std::copysign(1, start.z));
  // As the kernels have it.
  const glm::dvec3 direction(turn.x, turn.y,
                             sign.z * (Real{1} - std::abs(turn.x) - std::abs(turn.y)));
  const double length = std::max(length1(n), longest * unit / kLongestTurn);
  glm::dvec3 q = glm::cross(m / length, direction) / glm::dot(direction, direction);
  q -= glm::dot(sign, q) / glm::dot(sign, direction) * direction;
  turn.qx = with_last_bit(static_cast<Real>(q.x), sign.z < 0);
  turn.qy = static_cast<Real>(q.y);
  return turn;
}

template PackedTurn<float> packed_turn(const glm::dvec3&, const glm::dvec3&, double);
template PackedTurn<double> packed_turn(const glm::dvec3&, const glm::dvec3&, double);

}  // namespace espalier
