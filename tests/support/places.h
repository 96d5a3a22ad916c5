#pragma once

/// Random places in patches and volumes.

#include <cstddef>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "lattice/volume/volume.h"

namespace espalier::test {

/// A random place in the unit cube; one coordinate in four is 0 or 1, so that faces, edges and
/// corners are among the places.
inline glm::dvec3 random_place(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  glm::dvec3 uvw(unit(random), unit(random), unit(random));
  for (int axis = 0; axis < 3; ++axis) {
    if (random() % 4 == 0) {
      uvw[axis] = random() % 2 == 0 ? 0 : 1;
    }
  }
  return uvw;
}

/// Points of random patches at random places.
inline std::vector<glm::dvec3> points_inside(const Volume& volume, std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t patch = random() % volume.n_patches();
    points.push_back(volume.bezier(patch, volume.rest_points()).value(random_place(random)));
  }
  return points;
}

}  // namespace espalier::test
