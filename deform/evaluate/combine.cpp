#include "deform/evaluate/combine.h"

#include <cmath>
#include <string>

#include "deform/evaluate/displace.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

void require_valid(std::size_t n_points, std::span<const LatticeMotion> motions,
                   const Influence& influence) {
  if (!std::isfinite(influence.strength)) {
    throw ParameterError("the strength must be a finite number");
  }
  if (!influence.weights.empty() && influence.weights.size() != n_points) {
    throw ParameterError(std::to_string(influence.weights.size()) + " weights given for " +
                         std::to_string(n_points) + " points");
  }
  for (std::size_t i = 0; i < influence.weights.size(); ++i) {
    if (!(influence.weights[i] >= 0 && influence.weights[i] <= 1)) {
      throw ParameterError("weight " + std::to_string(i) + " is " +
                           std::to_string(influence.weights[i]) + ", must be 0 to 1");
    }
  }
  for (const LatticeMotion& motion : motions) {
    if (motion.binding->status.size() != n_points) {
      throw ParameterError("a binding of " + std::to_string(motion.binding->status.size()) +
                           " points given for " + std::to_string(n_points));
    }
  }
}

}  // namespace

std::vector<glm::dvec3> combined_points(std::span<const glm::dvec3> rest_points,
                                        std::span<const LatticeMotion> motions,
                                        const Influence& influence) {
  require_valid(rest_points.size(), motions, influence);
  std::vector<glm::dvec3> sums(rest_points.size(), glm::dvec3(0));
  for (const LatticeMotion& motion : motions) {
    const auto moves = point_displacements(*motion.volume, *motion.binding, motion.displacements,
                                           motion.pose_weights);
    parallel_for(sums.size(), [&](std::size_t i) { sums[i] += moves[i]; });
  }
  std::vector<glm::dvec3> points(rest_points.begin(), rest_points.end());
  parallel_for(points.size(), [&](std::size_t i) {
    const glm::dvec3 move = influence.at(i) * sums[i];
    if (move != glm::dvec3(0)) {
      points[i] += move;
    }
  });
  return points;
}

std::vector<glm::dmat3> combined_gradients(std::size_t n_points,
                                           std::span<const LatticeMotion> motions,
                                           const Influence& influence) {
  require_valid(n_points, motions, influence);
  std::vector<glm::dmat3> sums(n_points, glm::dmat3(0));
  for (const LatticeMotion& motion : motions) {
    const auto gradients = deformation_gradients(*motion.volume, *motion.binding,
                                                 motion.displacements, motion.pose_weights);
    parallel_for(n_points, [&](std::size_t i) { sums[i] += gradients[i] - glm::dmat3(1); });
  }
  parallel_for(n_points,
               [&](std::size_t i) { sums[i] = glm::dmat3(1) + influence.at(i) * sums[i]; });
  return sums;
}

}  // namespace espalier
