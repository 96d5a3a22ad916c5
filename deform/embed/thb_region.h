#pragma once

/// Refining a hierarchical lattice where a model, or part of it, is.

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/tensor/thb_lattice.h"

namespace espalier {

/// The places in [0,1]³ of the points that a lattice holds at rest, in any order. points: model
/// units, finite.
[[nodiscard]] std::vector<glm::dvec3> places_of_points(const ThbLattice& lattice,
                                                       std::span<const glm::dvec3> points,
                                                       const Progress& progress = {});

/// The cells and `n_rings` cells more on every side, as far as the grid of n_cells goes: each once,
/// ascending. O(n log n), n the cells that there are then.
[[nodiscard]] std::vector<GridIndex> with_rings(std::span<const GridIndex> cells,
                                                const std::array<int, 3>& n_cells, int n_rings);

/// The same volume, at rest and posed, refined up to `level` under points of a model: at each level
/// from 1 on the cells of the level before that hold a point, and n_rings cells round them, join
/// the domain. A cubic function reaches over four cells of its level, so that it takes one ring to
/// get a control point of level 1 inside. Throws ParameterError for a level below 1 or above
/// kMostThbLevels − 1, for less than 0 or more than 16 rings, if the lattice holds no point, and
/// before more than 131072 cells of a level are refined.
[[nodiscard]] ThbLattice refined_under(const ThbLattice& lattice,
                                       std::span<const glm::dvec3> points, int level,
                                       int n_rings = 0, const Progress& progress = {});

}  // namespace espalier
