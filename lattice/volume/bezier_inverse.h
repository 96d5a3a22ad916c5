#pragma once

/// Where a Bézier hexahedron takes a value.

#include <glm/vec3.hpp>
#include <optional>

#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// Where a map takes its value, as nearly as it was found.
struct Preimage {
  glm::dvec3 uvw;     ///< in [0,1]³, or within the margin that was asked for
  double residual;    ///< distance between the point and the map's value there
  bool is_converged;  ///< false if the iteration ended at a singular derivative or without end
  int n_steps = 0;    ///< of Newton's method
};

/// Newton's method for value(uvw) = x, damped: a step is halved until the residual falls. Starts
/// where the best affine map of the corners takes the value x, so that an affine patch takes one
/// step. It may roam a little beyond the result's range, the unit cube grown by `margin` (a
/// parameter length; a pyramid's apex is not passed), and ends early where the solution is seen to
/// lie outside. The residual tells whether x is reached; nothing if it is no number.
[[nodiscard]] std::optional<Preimage> invert(const BezierView& patch, const glm::dvec3& x,
                                             double margin = 0);

/// The same from another start, near [0,1]³.
[[nodiscard]] std::optional<Preimage> invert_from(const BezierView& patch, const glm::dvec3& x,
                                                  const glm::dvec3& start, double margin = 0);

/// The same by subdivision, up to the first preimage within `tolerance` (a length): the cube is
/// halved by de Casteljau's algorithm, parts whose hull cannot hold x are dropped, and Newton's
/// method starts in what is left. Else the best try, and is_converged tells whether nothing can
/// have been missed; nothing if no part can hold x.
[[nodiscard]] std::optional<Preimage> invert_by_subdivision(const BezierView& patch,
                                                            const glm::dvec3& x, double tolerance);

}  // namespace espalier
