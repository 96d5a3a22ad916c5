#pragma once

/// The boundary of a frozen volume, whatever its lattice's type.

#include "lattice/volume/boundary_surface.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// A grid of quadrilaterals on each face of a patch that lies on the boundary, one more than its
/// degree each way; their points lie on the boundary itself. faces: 6 · patch + face of
/// index_order.h. O(#weights of the boundary's patches).
[[nodiscard]] BoundarySurface boundary_surface(const Volume& volume);

}  // namespace espalier
