#include "lattice/tensor/placed.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "lattice/core/error.h"

namespace espalier {
namespace {

void require_invertible(const Placement& placement) {
  require_finite(placement);
  if (glm::determinant(placement.linear) == 0) {
    throw ParameterError("transform: no factor of a scale may be zero");
  }
}

template <class AnyLattice>
void place_points(AnyLattice& lattice, const Placement& placement) {
  for (auto* points : {&lattice.rest, &lattice.pose}) {
    for (glm::dvec3& point : *points) {
      point = placement.of(point);
    }
  }
}

/// Thickness that an axis has without saying so depends on the box: it is said from now on. The
/// frozen volume's points are doubled along it.
void set_thickness(TensorLattice& lattice) {
  const std::array<int, 3> counts = lattice.counts();
  if (std::find(counts.begin(), counts.end(), 1) == counts.end()) {
    return;
  }
  const Volume volume = freeze(lattice);
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool is_doubled = counts[axis] == 1;
    if (is_doubled) {
      lattice.thickness[axis] = volume.rest_points()[stride] - volume.rest_points()[0];
    }
    stride *= is_doubled ? 2 : static_cast<std::size_t>(counts[axis]);
  }
}

}  // namespace

TensorLattice placed(TensorLattice lattice, const Placement& placement) {
  require_invertible(placement);
  set_thickness(lattice);
  place_points(lattice, placement);
  for (glm::dvec3& thickness : lattice.thickness) {
    thickness = placement.linear * thickness;
  }
  require_valid(lattice);
  return lattice;
}

ThbLattice placed(ThbLattice lattice, const Placement& placement) {
  require_invertible(placement);
  place_points(lattice, placement);
  require_valid(lattice);
  return lattice;
}

}  // namespace espalier
