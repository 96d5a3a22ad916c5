#pragma once

/// The boundary of a frozen volume, whatever its lattice's type.

#include <cstdint>
#include <span>
#include <vector>

#include "lattice/volume/boundary_surface.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// A grid of quadrilaterals on each face of a patch that lies on the boundary, one more than its
/// degree each way; their points lie on the boundary itself. faces: 6 · patch + face of
/// index_order.h. O(#weights of the boundary's patches).
[[nodiscard]] BoundarySurface boundary_surface(const Volume& volume);

/// The control points that must not move for the volume to stay still at some faces of patches, up
/// to a derivative: ascending, each once. These are the first layers at the faces, all that the
/// Bézier points at the face, next to it and behind these depend on: 1, 2 and 3 for C0, C1 and C2
/// at open ends, 1, 2 and 2 at natural ones, 3 each at cubic uniform ones. faces: as those of
/// boundary_surface(). Throws ParameterError for one that is not on the boundary.
[[nodiscard]] std::vector<std::int32_t> unmoved_controls(const Volume& volume,
                                                         std::span<const std::int32_t> faces,
                                                         Continuity continuity);

}  // namespace espalier
