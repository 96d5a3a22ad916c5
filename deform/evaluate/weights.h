#pragma once

/// How bound points depend on the control points, as a matrix.

#include "deform/embed/embed.h"
#include "lattice/volume/stencil_table.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// W = ∂x'/∂P, the same for x, y and z: x' = x + W (P − P_rest). #points × #controls; row i belongs
/// to bound point i and sums to 1, or is empty if no patch holds the point. Weights that are
/// exactly zero are left out. The same bits for any number of threads. O(#weights of the patches).
[[nodiscard]] StencilTable control_weights(const Volume& volume, const Binding& binding);

}  // namespace espalier
