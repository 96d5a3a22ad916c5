#pragma once

/// A quick proof that a patch is not folded, good enough where it bends little.

#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// What the numbers of a patch may be off by.
struct PatchErrors {
  double start = 0;    ///< each coordinate of its points, or of its numerators
  double motion = 0;   ///< the same of how it moves
  double weights = 0;  ///< each weight
};

/// A t below which X + t V is surely locally injective and keeps its orientation; 0 if this proof
/// does not go through. In the frame of the derivative at the middle, the derivatives are strictly
/// column diagonally dominant as long as their Bernstein coefficients are, and so they are never
/// singular. Of a rational patch these are the derivatives of its numerators about its middle, less
/// at most the slopes of the weights times the patch's size. motion: V, with the same weights, or
/// null: then infinite or 0. O(#points).
[[nodiscard]] double dominant_step(const BezierView& start, const BezierPatch* motion,
                                   const PatchErrors& errors);

}  // namespace espalier
