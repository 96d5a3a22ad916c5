#include "deform/injectivity/pose_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {

double largest_coordinate(std::span<const glm::dvec3> points) {
  double largest = 0;
  for (const glm::dvec3& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
}

void require_coordinates(std::string_view what, std::span<const glm::dvec3> values,
                         std::size_t n_controls) {
  if (values.size() != n_controls) {
    throw ParameterError(fmt::format("the {} has {} control points, the lattice {}", what,
                                     values.size(), n_controls));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::dvec3& p = values[i];
    if (!(largest_coordinate({&p, 1}) <= kLargestCoordinate) || p != p) {
      throw ParameterError(fmt::format(
          "the {} has control point {} at ({}, {}, {}), must be finite, at most 1e18 in size", what,
          i, p.x, p.y, p.z));
    }
  }
}

void require_weights(std::span<const double> weights, const Volume& volume) {
  const std::size_t n_weights = volume.weights().size();
  if (!weights.empty() && weights.size() != n_weights) {
    throw ParameterError(
        fmt::format("the pose has {} weights, the volume {}", weights.size(), n_weights));
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0 && weights[i] <= kLargestCoordinate)) {
      throw ParameterError(
          fmt::format("weight {} of the pose is {}, must be positive and finite", i, weights[i]));
    }
  }
}

}  // namespace espalier
