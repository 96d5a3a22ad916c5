#include "lattice/volume/rational_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "lattice/tensor/tensor_lattice.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

TensorLattice nurbs() {
  TensorLattice lattice =
      make_tensor_lattice(TensorKind::Nurbs,
                          {TensorAxis::make(5, 3, Ends::Open), TensorAxis::make(3, 2, Ends::Open),
                           TensorAxis::make(4, 3, Ends::Natural)},
                          {});
  for (std::size_t i = 0; i < lattice.weights.size(); ++i) {
    lattice.weights[i] = 1 + 0.4 * std::sin(static_cast<double>(i));
  }
  return lattice;
}

TEST(RationalMotion, is_the_posed_place_minus_the_place_at_rest) {
  const TensorLattice lattice = nurbs();
  const Volume volume = freeze(lattice);
  const auto pose = test::jittered(lattice.rest, 0.2, 1);
  std::vector<double> weights = lattice.weights;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= 1 + 0.3 * std::cos(static_cast<double>(i));
  }
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const BezierPatch motion = rational_motion(volume, i, volume.displacements(pose), weights);
    BezierPatch posed;
    volume.bezier(i, pose, weights, posed);
    const BezierPatch rest = volume.bezier(i, volume.rest_points());
    for (const glm::dvec3& uvw : {glm::dvec3(0.3, 0.6, 0.2), glm::dvec3(0, 1, 0.5)}) {
      EXPECT_LT(glm::distance(motion.value(uvw), posed.value(uvw) - rest.value(uvw)), 1e-15);
      const glm::dmat3 slope = posed.derivative(uvw) - rest.derivative(uvw);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT(glm::distance(motion.derivative(uvw)[axis], slope[axis]), 1e-13);
      }
    }
  }
}

TEST(RationalMotion, is_exactly_zero_at_rest_and_linear_with_the_weights_at_rest) {
  const TensorLattice lattice = nurbs();
  const Volume volume = freeze(lattice);
  const BezierPatch still =
      rational_motion(volume, 0, volume.displacements(lattice.rest), lattice.weights);
  for (const glm::dvec3& point : still.points) {
    EXPECT_EQ(point, glm::dvec3(0));
  }
  const auto pose = test::jittered(lattice.rest, 0.2, 2);
  const BezierPatch motion =
      rational_motion(volume, 0, volume.displacements(pose), lattice.weights);
  const BezierPatch linear = volume.bezier(0, volume.displacements(pose));
  const glm::dvec3 uvw(0.4, 0.7, 0.1);
  EXPECT_LT(glm::distance(motion.value(uvw), linear.value(uvw)), 1e-15);
}

}  // namespace
}  // namespace espalier
