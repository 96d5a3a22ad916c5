#pragma once

/// Pulling points of a model: which motion of the control points takes them where they are wanted.

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "deform/direct/minimum_norm.h"
#include "deform/direct/motion_energy.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// How control points move, and what is left to the targets.
struct PullMotion {
  std::vector<glm::dvec3> motion;     ///< #controls
  std::vector<glm::dvec3> residuals;  ///< #picks: wanted − done
};

/// The cheapest motion of control points that moves picked points as wanted. For the smallest
/// motion, in the sense of least squares, that is [HHK92] section 3: ΔP = W Rᵀ (R W Rᵀ)⁺ Δq with R
/// the picks' weights and W the mobilities. Where no motion does, picks miss by the least sum of
/// squares.
///
/// Points of groups come after the picks: they do what they can without disturbing these. Many
/// points side by side ask for bends that a lattice can only make by throwing its control points
/// far away; so groups are not met exactly where control points would move more than kMostGain
/// times as far as points are to, beyond what picks alone ask of them.
class Pull {
 public:
  /// rows: #picks × #controls, the picked rows of control_weights(), or combinations of them.
  /// mobilities: as smallest_motion() takes them. Throws ParameterError for a pick with an empty
  /// row, for mobilities that are none, or too many picks. O(#picks² · #controls reached).
  explicit Pull(const StencilTable& rows, std::span<const double> mobilities = {});

  /// The same with any energy that was made for these rows. n_of_groups: how many of the last rows
  /// are those of groups. Tells `progress` "factorise".
  Pull(StencilTable rows, std::shared_ptr<const MotionEnergy> energy, std::size_t n_of_groups = 0,
       const Progress& progress = {});

  /// wanted: #rows, how far each is to move, model units. Throws ParameterError unless that many
  /// finite vectors are given. O(#picks · #controls reached). Keeps within round-off what can be
  /// met. The same bits for any number of threads.
  [[nodiscard]] PullMotion motion(std::span<const glm::dvec3> wanted) const;

  /// How many of the picks are independent of the others.
  [[nodiscard]] std::size_t rank() const { return picks_.rank(); }

  static constexpr double kMostGain = 3;

 private:
  [[nodiscard]] PullMotion solved(std::span<const glm::dvec3> wanted,
                                  const MinimumNorm* groups) const;

  StencilTable rows_;
  std::shared_ptr<const MotionEnergy> energy_;
  std::size_t n_picks_;
  MinimumNorm picks_;
  std::optional<MinimumNorm> groups_;  // for changes that keep the picks
};

/// Points that go to a plane: only their motion along its normal is asked for, and they may slide.
struct PlaneRows {
  StencilTable rows;
  glm::dvec3 normal{0, 0, 1};  ///< of unit length
};

/// Pulls points, and groups to planes of one normal, at once. rows: of picks, then of n_of_groups
/// points of other groups; may have none. wanted: #rows; distances: #points of the planes, how far
/// each is to go along the normal. Residuals are those of the rows, then those of the planes, which
/// are along the normal. energy: made for all of them. Throws as Pull.
[[nodiscard]] PullMotion pull_with_plane(const StencilTable& rows, std::size_t n_of_groups,
                                         std::span<const glm::dvec3> wanted, const PlaneRows& plane,
                                         std::span<const double> distances,
                                         const std::shared_ptr<const MotionEnergy>& energy,
                                         const Progress& progress = {});

/// The greatest length of vectors, 0 for none.
[[nodiscard]] double longest(std::span<const glm::dvec3> vectors);

}  // namespace espalier
