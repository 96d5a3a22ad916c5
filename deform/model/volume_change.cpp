#include "deform/model/volume_change.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "lattice/core/box.h"

namespace espalier {

double signed_volume(std::span<const glm::dvec3> points,
                     const CompressedRows<std::int32_t>& faces) {
  // About the middle, so that a model far from the origin loses no digits.
  const glm::dvec3 middle = box_of(points).center();
  const auto corner = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)] - middle; };
  double sum = 0;
  for (std::size_t f = 0; f < faces.n_rows(); ++f) {
    const auto loop = faces[f];
    for (std::size_t i = 2; i < loop.size(); ++i) {
      sum += glm::dot(corner(loop[0]), glm::cross(corner(loop[i - 1]), corner(loop[i])));
    }
  }
  return sum / 6;
}

bool is_closed(const CompressedRows<std::int32_t>& faces) {
  std::vector<std::pair<std::int32_t, std::int32_t>> forward;
  std::vector<std::pair<std::int32_t, std::int32_t>> backward;
  for (std::size_t f = 0; f < faces.n_rows(); ++f) {
    const auto loop = faces[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t next = loop[(i + 1) % loop.size()];
      forward.emplace_back(loop[i], next);
      backward.emplace_back(next, loop[i]);
    }
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return !forward.empty() && forward == backward;
}

std::optional<double> volume_change(std::span<const glm::dvec3> before,
                                    std::span<const glm::dvec3> after,
                                    const CompressedRows<std::int32_t>& faces) {
  if (!is_closed(faces)) {
    return std::nullopt;
  }
  constexpr double kNothing = 1e-12;  // of the cube of the extent
  const double at_rest = signed_volume(before, faces);
  if (!(std::abs(at_rest) > kNothing * std::pow(box_of(before).radius(), 3))) {
    return std::nullopt;
  }
  return 100 * (signed_volume(after, faces) - at_rest) / at_rest;
}

}  // namespace espalier
