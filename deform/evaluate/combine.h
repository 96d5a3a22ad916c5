#pragma once

/// Several lattices on one model, as strongly as they are asked to act.

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "deform/embed/embed.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// One lattice's part: a binding of the rest points, and how the volume's points move.
struct LatticeMotion {
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const Binding> binding;
  std::vector<glm::dvec3> displacements;  ///< as Volume::displacements() makes them
  std::vector<double> pose_weights = {};  ///< as displaced_points() takes them
};

/// How much of a motion the points follow.
struct Influence {
  double strength = 1;          ///< of the whole, any finite number
  std::vector<double> weights;  ///< #points in [0, 1], or empty: all 1

  [[nodiscard]] double at(std::size_t point) const {
    return weights.empty() ? strength : strength * weights[point];
  }
};

/// x' = x + strength · weight · Σ displacements: every lattice is bound to the rest points, and
/// their displacements add, in the order given. A point that does not move keeps its bits: weight
/// or strength 0, or no moved control point reaches it.
/// rest_points: #points. Throws ParameterError for a strength that is not finite, a weight outside
/// [0, 1], or arrays of other lengths. The same bits for any number of threads.
[[nodiscard]] std::vector<glm::dvec3> combined_points(std::span<const glm::dvec3> rest_points,
                                                      std::span<const LatticeMotion> motions,
                                                      const Influence& influence = {});

/// J = I + strength · weight · Σ (J_i − I) at the points. The weights count as constants: how they
/// vary from point to point is known at points only, so their slope is left out. n_points: bound.
/// Throws as combined_points.
[[nodiscard]] std::vector<glm::dmat3> combined_gradients(std::size_t n_points,
                                                         std::span<const LatticeMotion> motions,
                                                         const Influence& influence = {});

}  // namespace espalier
