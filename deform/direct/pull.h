#pragma once

/// Pulling points of a model: which motion of the control points takes them where they are wanted.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/volume/stencil_table.h"

namespace espalier {

/// How control points move, and what is left to the targets.
struct PullMotion {
  std::vector<glm::dvec3> motion;     ///< #controls
  std::vector<glm::dvec3> residuals;  ///< #picks: wanted − done
};

/// The smallest motion of control points, in the sense of least squares, that moves picked points
/// as wanted [HHK92] section 3: ΔP = W Rᵀ (R W Rᵀ)⁺ Δq with R the picks' weights and W the
/// mobilities. Where no motion does, picks miss by the least sum of squares. By a column-pivoted QR
/// factorisation of √W Rᵀ, as the Gram matrix would lose half the digits of picks that nearly
/// coincide, with refinement.
class Pull {
 public:
  /// rows: #picks × #controls, the picked rows of control_weights(). mobilities: #controls, how
  /// readily each control point moves, 0: pinned; or empty: all 1. Throws ParameterError for a pick
  /// with an empty row, a mobility that is negative or not finite, or arrays of other lengths.
  /// O(#picks² · #controls reached).
  explicit Pull(StencilTable rows, std::span<const double> mobilities = {});

  /// wanted: #picks, how far each is to move, model units. Throws ParameterError unless that many
  /// finite vectors are given. O(#picks² + #weights). Keeps within round-off what can be met.
  [[nodiscard]] PullMotion motion(std::span<const glm::dvec3> wanted) const;

  /// How many of the picks are independent of the others.
  [[nodiscard]] std::size_t rank() const { return rank_; }
  [[nodiscard]] std::size_t n_picks() const { return rows_.n_rows(); }

 private:
  [[nodiscard]] std::vector<glm::dvec3> solve(std::span<const glm::dvec3> wanted) const;

  StencilTable rows_;
  std::vector<double> mobilities_;
  std::size_t rank_ = 0;
  std::vector<std::size_t> order_;  // of the picks, by pivot
  std::vector<double> R_;           // rank × #picks, row-major, upper trapezoidal
  std::vector<double> fit_;         // of Rᵀ if rank < #picks: its R, rank × rank
  std::vector<std::size_t> fit_order_;
};

}  // namespace espalier
