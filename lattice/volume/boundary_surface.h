#pragma once

/// The boundary of a lattice's volume by the lattice's own faces, whatever its type: what joining
/// the volume's motion to its surroundings takes.

#include <cstdint>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// How smoothly a motion that is zero beyond a border joins there: in value, in the first
/// derivatives too, in the second too.
enum class Continuity { C0, C1, C2 };

/// Quadrilaterals close to the volume's boundary.
struct BoundarySurface {
  StencilTable points;                 ///< over control points
  CompressedRows<std::int32_t> quads;  ///< loops of four points, counter-clockwise from outside
  std::vector<std::int32_t> faces;     ///< #quads: the lattice's boundary face that each lies on
};

}  // namespace espalier
