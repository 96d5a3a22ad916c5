#pragma once

/// How the points of a volume move in a frame, laid out for evaluation.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/volume/volume.h"

namespace espalier {

/// Weights of a rational volume's points in a pose that has its own. Both #points, or both empty:
/// the weights are those at rest.
struct WeightChange {
  std::span<const double> rest = {};   ///< Volume::weights()
  std::span<const double> posed = {};  ///< positive
};

/// Displacements of a volume's points, which of them are not zero, and which changed last. Real:
/// float or double, what evaluation calculates in.
template <class Real>
class VolumeMotion {
 public:
  /// Everything at rest, nothing changed. n_points: of the volume.
  explicit VolumeMotion(std::size_t n_points);
  /// As if set from rest.
  explicit VolumeMotion(std::span<const glm::dvec3> displacements,
                        const WeightChange& weights = {});

  /// The next frame; a point has changed if its displacement or its weight is not that of the frame
  /// before. displacements: #points, as Volume::displacements() makes them. Throws ParameterError
  /// for another number of them or of weights, and for a weight that is not positive. Allocates
  /// nothing but room for the first weights. O(#points).
  void set(std::span<const glm::dvec3> displacements, const WeightChange& weights = {});

  /// Whether any of a patch's points is moved or has another weight, has another weight, or changed
  /// last.
  [[nodiscard]] bool is_any_moved(std::span<const std::int32_t> block) const {
    return has_any(block, kMoved);
  }
  [[nodiscard]] bool is_any_reweighted(std::span<const std::int32_t> block) const {
    return has_any(block, kReweighted);
  }
  [[nodiscard]] bool has_any_changed(std::span<const std::int32_t> block) const {
    return has_any(block, kChanged);
  }

  [[nodiscard]] std::span<const glm::dvec3> displacements() const { return displacements_; }
  /// Of the points in the pose; empty: those at rest.
  [[nodiscard]] std::span<const double> weights() const { return weights_; }
  /// Four numbers a point: x, y, z of rest minus moved, and 0. A point at rest has +0, so that
  /// what it is subtracted from keeps its bits, −0 too.
  [[nodiscard]] const Real* values() const { return values_.data(); }

 private:
  static constexpr std::uint8_t kMoved = 1;
  static constexpr std::uint8_t kChanged = 2;
  static constexpr std::uint8_t kReweighted = 4;
  void require_valid(std::span<const glm::dvec3> displacements, const WeightChange& weights) const;
  [[nodiscard]] bool has_any(std::span<const std::int32_t> block, std::uint8_t flag) const {
    std::uint8_t flags = 0;
    for (const std::int32_t point : block) {
      flags |= flags_[static_cast<std::size_t>(point)];
    }
    return (flags & flag) != 0;
  }

  std::vector<glm::dvec3> displacements_;
  std::vector<double> weights_;
  std::vector<Real> values_;
  std::vector<std::uint8_t> flags_;
};

/// How patch i moves, in Bézier form: linear in the displacements where its weights are those at
/// rest, else as rational_motion(). `out` keeps its memory. Real: of the motion.
template <class Real>
void find_motion(const Volume& volume, const VolumeMotion<Real>& motion, std::size_t i,
                 BezierPatch& out);

}  // namespace espalier
