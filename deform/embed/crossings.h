#pragma once

/// Where a model's faces leave a lattice.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/embed/embed.h"
#include "lattice/core/compressed_rows.h"
#include "lattice/volume/boundary_surface.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// An edge of a model's face from a point that a lattice holds to one that it does not.
struct Crossing {
  std::int32_t face = 0;           ///< of the model
  std::int32_t held = 0;           ///< the point inside or on the border
  std::int32_t boundary_face = 0;  ///< of the lattice: where the edge leaves it first
};

/// All of them, in the order of the model's faces; an edge that two faces share is there twice.
struct Crossings {
  std::vector<Crossing> edges;
  StencilTable points;  ///< #edges: where each leaves the lattice, over control points
};

/// Finds where edges leave the lattice, on quadrilaterals close to its boundary; a point that lies
/// between these and the boundary itself counts as leaving where they are closest. controls: at
/// rest; points, faces: the model's; status: #points, of the model bound to the lattice. The same
/// result for any number of threads. O((#boundary + #crossings) log #boundary).
[[nodiscard]] Crossings find_crossings(const BoundarySurface& boundary,
                                       std::span<const glm::dvec3> controls,
                                       std::span<const glm::dvec3> points,
                                       const CompressedRows<std::int32_t>& faces,
                                       std::span<const PointStatus> status);

}  // namespace espalier
