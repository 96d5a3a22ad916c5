#pragma once

/// Refining a hierarchical lattice where it is needed.

#include <glm/vec3.hpp>
#include <span>

#include "lattice/tensor/thb_lattice.h"

namespace espalier {

/// The same volume, at rest and posed, with functions of one level more round places: the leaf that
/// holds each is refined, and its neighbours, so that some of them reach the place. places: in
/// [0,1]³, clamped. Throws ParameterError for more levels or cells than a hierarchy may have.
[[nodiscard]] ThbLattice refined_round(const ThbLattice& lattice,
                                       std::span<const glm::dvec3> places);

/// A number of every control point, carried over to a lattice that refined the one before: that of
/// a new control point is the mean of those of the level before by knot insertion, exactly zero if
/// all of these are. values: #controls before; result: #controls after. Throws ParameterError for
/// another number of them.
[[nodiscard]] std::vector<double> carried_over(const ThbLattice& before, const ThbLattice& after,
                                               std::span<const double> values);

}  // namespace espalier
