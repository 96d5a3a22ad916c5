#pragma once

/// Evaluation of patches that no kernel knows: of high degree, of degree 0, or the derivatives of
/// pyramids.

#include "deform/evaluate/kernels.h"
#include "deform/evaluate/point_runs.h"
#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// As a kernel does for a run that is not scattered, point by point and in double. moves: the
/// patch's Bézier form of displacements; uvw: #points; points.powers is not read.
template <class Real>
void evaluate_general(const BezierView& moves, std::span<const glm::dvec3> uvw,
                      const PatchPoints<Real>& points);

}  // namespace espalier
