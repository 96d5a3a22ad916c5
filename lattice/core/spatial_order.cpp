#include "lattice/core/spatial_order.h"

#include <algorithm>
#include <numeric>

#include "lattice/core/box.h"

namespace espalier {
namespace {

constexpr unsigned kBits = 5;  // an axis
constexpr unsigned kCells = 1u << kBits;

/// The cell that a fraction of the box lies in; 0 for what is no number.
unsigned cell_of(double fraction) {
  const double place = fraction * kCells;
  return !(place > 0) ? 0 : place >= kCells ? kCells - 1 : static_cast<unsigned>(place);
}

/// Bit i goes to bit 3i.
unsigned spread(unsigned bits) {
  unsigned result = 0;
  for (unsigned i = 0; i < kBits; ++i) {
    result |= (bits >> i & 1u) << (3 * i);
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const glm::dvec3> points) {
  const Box box = box_of(points);
  const glm::dvec3 size = box.max - box.min;
  const double side = std::max({size.x, size.y, size.z});
  std::vector<std::uint16_t> keys(points.size());
  std::vector<std::uint32_t> first((1u << (3 * kBits)) + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 at = (points[i] - box.min) / side;
    keys[i] = static_cast<std::uint16_t>(spread(cell_of(at.x)) | spread(cell_of(at.y)) << 1 |
                                         spread(cell_of(at.z)) << 2);
    ++first[keys[i] + 1u];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    order[first[keys[i]]++] = static_cast<std::uint32_t>(i);
  }
  return order;
}

}  // namespace espalier
