#pragma once

/// A quick proof that a patch is not folded, good enough where it bends little.

#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// A t below which X + t V is surely locally injective and keeps its orientation; 0 if this proof
/// does not go through. In the frame of the derivative at the middle, the derivatives are strictly
/// column diagonally dominant as long as their Bernstein coefficients are, and so they are never
/// singular. motion: V, or null: then infinite or 0. The errors are those of the coordinates of the
/// points. O(#points).
[[nodiscard]] double dominant_step(const BezierView& start, const BezierPatch* motion,
                                   double start_error, double motion_error);

}  // namespace espalier
