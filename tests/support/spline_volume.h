#pragma once

/// Volumes of uniform cubic B-splines, made by hand.

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/volume/bezier_patch.h"
#include "lattice/volume/volume.h"

namespace espalier::test {

/// A grid of (nu+1)(nv+1)(nw+1) points over [0,nu] × [0,nv] × [0,nw], u fastest.
[[nodiscard]] std::vector<glm::dvec3> grid_points(const std::array<int, 3>& n);

/// n intervals an axis, natural ends; controls: as many as grid_points() makes.
[[nodiscard]] Volume spline_volume(const std::array<int, 3>& n, std::vector<glm::dvec3> controls);

/// The unit cube with a degree per axis, its points moved by noise of at most `noise` a coordinate;
/// a pyramid if asked for.
[[nodiscard]] BezierPatch warped_cube(const std::array<int, 3>& degree, double noise, unsigned seed,
                                      bool is_pyramid = false);

}  // namespace espalier::test
