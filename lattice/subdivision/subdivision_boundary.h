#pragma once

/// The boundary of a Catmull-Clark volume: where it is, and which control points hold it still.

#include <cstdint>
#include <span>
#include <vector>

#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/volume/boundary_surface.h"

namespace espalier {

/// The boundary refined twice by the surface's own rules: within about a hundredth of a face's size
/// of the volume's boundary. O(#boundary faces).
[[nodiscard]] BoundarySurface boundary_surface(const SubdivisionLattice& lattice);

/// The control points that must not move for the volume to stay still at some boundary faces, up to
/// a derivative: ascending, each once.
///
/// C0: the vertices of the faces, and, where no crease ends the boundary surface at a vertex, those
/// of the boundary faces round it: all that the surface depends on there. C1 and C2: all vertices
/// of the cells at the faces' vertices, the first two layers. These keep the first layer of cells
/// still at every level of refinement, and the volume ends naturally: where the lattice is regular
/// or extruded across the faces its motion grows as t³/6, t the cells away from them; at nodes and
/// beside other cells than hexahedra it falls by more than 6 with every level of refinement, so
/// its second derivative is zero there too. faces: of the lattice's boundary. Throws
/// ParameterError for one that is not. O(#cells at the faces).
[[nodiscard]] std::vector<std::int32_t> unmoved_controls(const SubdivisionLattice& lattice,
                                                         std::span<const std::int32_t> faces,
                                                         Continuity continuity);

}  // namespace espalier
