#pragma once

/// What a motion of control points costs: which of the motions that do what is wanted is chosen.

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "deform/direct/minimum_norm.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// Coordinates y and a of motions such that a motion costs |y|²: a moves parts of the lattice as
/// they are, which costs nothing. Made for the rows that are asked for; immutable.
class MotionEnergy {
 public:
  MotionEnergy() = default;
  MotionEnergy(const MotionEnergy&) = delete;
  MotionEnergy& operator=(const MotionEnergy&) = delete;
  virtual ~MotionEnergy() = default;

  [[nodiscard]] virtual std::size_t n_controls() const = 0;
  /// How rows, over control points, depend on y: transposed, #y × #rows. rows: some of those that
  /// the energy was made for.
  [[nodiscard]] virtual DenseMatrix columns(const StencilTable& rows) const = 0;
  /// How they depend on a: #rows × #a.
  [[nodiscard]] virtual DenseMatrix free_columns(const StencilTable& rows) const = 0;
  /// The motion with these coordinates: #controls. That of a pinned control point is exactly zero.
  [[nodiscard]] virtual std::vector<glm::dvec3> motion(std::span<const glm::dvec3> y,
                                                       std::span<const glm::dvec3> a) const = 0;
};

/// Σ |ΔP_i|² / mobility_i: the smallest motion, as in [HHK92]. mobilities: #controls, how readily
/// each control point moves, 0: pinned; or empty: all 1. Throws ParameterError for a mobility that
/// is negative or not finite, or for another number of them.
[[nodiscard]] std::shared_ptr<const MotionEnergy> smallest_motion(
    const StencilTable& rows, std::span<const double> mobilities = {});

/// Throws ParameterError for mobilities that are none, or for another number of them.
void require_mobilities(std::span<const double> mobilities, std::size_t n_controls);

}  // namespace espalier
