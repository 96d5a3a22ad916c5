#include "deform/evaluate/volume_motion.h"

#include <string>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {

template <class Real>
VolumeMotion<Real>::VolumeMotion(std::size_t n_points)
    : displacements_(n_points, glm::dvec3(0)), values_(4 * n_points, 0), flags_(n_points, 0) {}

template <class Real>
VolumeMotion<Real>::VolumeMotion(std::span<const glm::dvec3> displacements)
    : VolumeMotion(displacements.size()) {
  set(displacements);
}

template <class Real>
void VolumeMotion<Real>::set(std::span<const glm::dvec3> displacements) {
  if (displacements.size() != displacements_.size()) {
    throw ParameterError(std::to_string(displacements.size()) +
                         " displacements given for a volume of " +
                         std::to_string(displacements_.size()) + " points");
  }
  const auto take = [this, displacements = displacements.data()](std::size_t i) {
    const glm::dvec3& move = displacements[i];
    flags_[i] = static_cast<std::uint8_t>((move != glm::dvec3(0) ? kMoved : 0) |
                                          (move != displacements_[i] ? kChanged : 0));
    displacements_[i] = move;
    for (int axis = 0; axis < 3; ++axis) {
      values_[4 * i + static_cast<std::size_t>(axis)] = static_cast<Real>(0 - move[axis]);
    }
  };
  parallel_for(displacements.size(), take, 16384);
}

template class VolumeMotion<float>;
template class VolumeMotion<double>;

}  // namespace espalier
