#pragma once

/// What certificates ask of poses.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "lattice/volume/volume.h"

namespace espalier {

/// The largest size of a coordinate; 0 without points.
[[nodiscard]] double largest_coordinate(std::span<const glm::dvec3> points);

/// Throws ParameterError, naming `what` and the place, unless values are #controls points with
/// coordinates within kLargestCoordinate.
void require_coordinates(std::string_view what, std::span<const glm::dvec3> values,
                         std::size_t n_controls);

/// Throws ParameterError unless there are no weights, or one for each of the volume's points, each
/// positive and at most kLargestCoordinate.
void require_weights(std::span<const double> weights, const Volume& volume);

}  // namespace espalier
