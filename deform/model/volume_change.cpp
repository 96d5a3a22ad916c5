#include "deform/model/volume_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "deform/model/same_place.h"
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

bool is_closed(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces) {
  const std::vector<std::int32_t> first = first_in_place(points);
  std::vector<std::array<std::int32_t, 3>> edges;  // smaller end, larger, ±1 by direction
  edges.reserve(faces.n_values());
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto loop = faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = first[static_cast<std::size_t>(loop[i])];
      const std::int32_t b = first[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
      if (a != b) {
        edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::int32_t sum = 0;
    std::size_t end = i;
    for (; end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1];
         ++end) {
      sum += edges[end][2];
    }
    if (sum != 0) {
      return false;
    }
    i = end;
  }
  return !edges.empty();
}

std::optional<double> volume_change(std::span<const glm::dvec3> before,
                                    std::span<const glm::dvec3> after,
                                    const CompressedRows<std::int32_t>& faces) {
  if (!is_closed(before, faces)) {
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
