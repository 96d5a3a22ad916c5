#pragma once

/// Truncated hierarchical B-spline lattices [THB18]: finer where it matters, on any level.

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lattice/tensor/oriented_box.h"
#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_hierarchy.h"
#include "lattice/volume/stencil_table.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Control points of a hierarchy, at rest and posed. A value; copies share the hierarchy, and the
/// lattice before a refinement is what undoes it.
struct ThbLattice {
  std::shared_ptr<const ThbHierarchy> hierarchy;
  std::vector<glm::dvec3> rest;  ///< #controls of the hierarchy, model units
  std::vector<glm::dvec3> pose;  ///< the same, or empty: at rest
  std::string extra_json;        ///< keys of its file that are not ours, a JSON object; empty: none

  /// The pose if there is one, else the rest points.
  [[nodiscard]] std::span<const glm::dvec3> posed_points() const {
    return pose.empty() ? rest : pose;
  }
};

/// One level on a box, which it fills, every control point at its Greville place. Throws
/// ParameterError as ThbHierarchy.
[[nodiscard]] ThbLattice make_thb_lattice(const std::array<int, 3>& counts,
                                          const std::array<int, 3>& degree, const OrientedBox& box);

/// Throws LatticeError unless there are as many points as the hierarchy has control points, all
/// finite.
void require_valid(const ThbLattice& lattice);

/// The same volume, at rest and posed, over a hierarchy with the same level 0 and domains that hold
/// the lattice's own. Throws ParameterError for another level 0. O(#new functions).
[[nodiscard]] ThbLattice refined_to(const ThbLattice& lattice,
                                    std::shared_ptr<const ThbHierarchy> hierarchy);

/// The same volume with more cells, of level − 1, in the domain of `level`: finer control points
/// there. Throws ParameterError for a level below 1 or more than one above the finest, and
/// LatticeError for a cell outside the domain of level − 1.
[[nodiscard]] ThbLattice with_cells(const ThbLattice& lattice, int level,
                                    std::span<const GridIndex> cells);

/// One leaf cell is one patch, in the order of leaves(); a point for each function that a leaf
/// sees, over the control points. The whole of truncation is in the points: a function that is no
/// control point of its level has the coefficient that knot insertion gives it from the level
/// before, D_j = Σ_i c_ij D_i. Throws as require_valid(). O(#functions + #leaves).
[[nodiscard]] Volume freeze(const ThbLattice& lattice);

/// Where in the frozen volume a place of [0,1]³ is; clamped. leaves: those of the hierarchy.
[[nodiscard]] PatchPlace place_of(const ThbHierarchy& hierarchy, std::span<const ThbCell> leaves,
                                  const glm::dvec3& uvw);

/// The places of [0,1]³ that places in patches are. patches, uvw: #places, as a binding has them.
[[nodiscard]] std::vector<glm::dvec3> places_in_whole(const ThbHierarchy& hierarchy,
                                                      std::span<const ThbCell> leaves,
                                                      std::span<const std::int32_t> patches,
                                                      std::span<const glm::dvec3> uvw);

/// What the control points of a level do to a model, as in [THB18] tables 2 and 3.
struct LevelInfluence {
  std::size_t n_controls = 0;
  double mean_points = 0;     ///< how many of the model's points one moves on average
  std::size_t n_without = 0;  ///< how many move none
};

/// Of all levels. weights: #model points × #controls, those of a model bound to the volume.
[[nodiscard]] std::vector<LevelInfluence> level_influences(const ThbHierarchy& hierarchy,
                                                           const StencilTable& weights);

}  // namespace espalier
