#include "deform/evaluate/volume_motion.h"

#include <cmath>
#include <string>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/volume/rational_motion.h"

namespace espalier {

template <class Real>
VolumeMotion<Real>::VolumeMotion(std::size_t n_points)
    : displacements_(n_points, glm::dvec3(0)), values_(4 * n_points, 0), flags_(n_points, 0) {}

template <class Real>
VolumeMotion<Real>::VolumeMotion(std::span<const glm::dvec3> displacements,
                                 const WeightChange& weights)
    : VolumeMotion(displacements.size()) {
  set(displacements, weights);
}

template <class Real>
void VolumeMotion<Real>::require_valid(std::span<const glm::dvec3> displacements,
                                       const WeightChange& weights) const {
  const std::size_t n = displacements_.size();
  if (displacements.size() != n) {
    throw ParameterError(std::to_string(displacements.size()) +
                         " displacements given for a volume of " + std::to_string(n) + " points");
  }
  if (weights.posed.size() != weights.rest.size() ||
      (!weights.posed.empty() && weights.posed.size() != n)) {
    throw ParameterError(std::to_string(weights.posed.size()) + " weights of a pose given for " +
                         std::to_string(weights.rest.size()) + " at rest of " + std::to_string(n) +
                         " points");
  }
  for (std::size_t i = 0; i < weights.posed.size(); ++i) {
    if (!(weights.posed[i] > 0 && std::isfinite(weights.posed[i]))) {
      throw ParameterError("the pose's weight " + std::to_string(i) + " is " +
                           std::to_string(weights.posed[i]) + ", must be positive");
    }
  }
}

template <class Real>
void VolumeMotion<Real>::set(std::span<const glm::dvec3> displacements,
                             const WeightChange& weights) {
  require_valid(displacements, weights);
  const std::span<const double> before = weights_.empty() ? weights.rest : weights_;
  const auto take = [&](std::size_t i) {
    const glm::dvec3& move = displacements[i];
    const bool was_reweighted = (flags_[i] & kReweighted) != 0;
    const bool is_reweighted = !weights.posed.empty() && weights.posed[i] != weights.rest[i];
    const bool has_new_weight =
        weights.posed.empty() ? was_reweighted : weights.posed[i] != before[i];
    const bool is_moved = move != glm::dvec3(0) || is_reweighted;
    const bool has_changed = move != displacements_[i] || has_new_weight;
    flags_[i] = static_cast<std::uint8_t>((is_moved ? kMoved : 0) | (has_changed ? kChanged : 0) |
                                          (is_reweighted ? kReweighted : 0));
    displacements_[i] = move;
    for (int axis = 0; axis < 3; ++axis) {
      values_[4 * i + static_cast<std::size_t>(axis)] = static_cast<Real>(0 - move[axis]);
    }
  };
  parallel_for(displacements.size(), take, 16384);
  weights_.assign(weights.posed.begin(), weights.posed.end());
}

template <class Real>
void find_motion(const Volume& volume, const VolumeMotion<Real>& motion, std::size_t i,
                 BezierPatch& out) {
  if (motion.is_any_reweighted(volume.block(i))) {
    out = rational_motion(volume, i, motion.displacements(), motion.weights());
  } else {
    volume.bezier(i, motion.displacements(), out);
  }
}

template void find_motion(const Volume&, const VolumeMotion<float>&, std::size_t, BezierPatch&);
template void find_motion(const Volume&, const VolumeMotion<double>&, std::size_t, BezierPatch&);
template class VolumeMotion<float>;
template class VolumeMotion<double>;

}  // namespace espalier
