#pragma once

/// What certificates ask of rational patches beyond what polynomials are asked.

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "deform/injectivity/determinant_nets.h"
#include "lattice/volume/bezier_patch.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// The factors of a patch's derivatives that are exactly there: where all points that a face
/// depends on are equal to the bit, or all those along one of its axes, and the weights are
/// products of those along this axis and those along the other. points, weights: #points of the
/// volume; no weights: all are equal.
[[nodiscard]] Collapse rational_collapse(const Volume& volume, std::size_t patch,
                                         std::span<const glm::dvec3> points,
                                         std::span<const double> weights);

/// The points (w (x − centre), w) of a patch, which may be a polynomial. `out` keeps its memory.
void homogeneous_points(const BezierView& patch, const glm::dvec3& centre,
                        std::vector<glm::dvec4>& out);

/// The sum of the weights at a place: 1 for a polynomial.
[[nodiscard]] double weight_at(const BezierView& patch, const glm::dvec3& uvw);

}  // namespace espalier
