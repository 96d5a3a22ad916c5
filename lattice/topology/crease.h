#pragma once

/// Marking creases and corners by hand.

#include <span>
#include <vector>

#include "lattice/topology/sharpness.h"

namespace espalier {

/// The line of boundary edges through one: beyond each vertex with four boundary edges it goes on
/// along the edge that shares no boundary face with the last; elsewhere, and where it meets itself,
/// it ends. Throws LatticeError if the edge is inside.
[[nodiscard]] std::vector<EdgeId> boundary_line(const CellComplex& complex, EdgeId edge);

/// The tags with those of some edges and vertices set; 0 makes them smooth. Throws ParameterError
/// for a sharpness that is negative or not finite, LatticeError naming an element that is not on
/// the boundary.
[[nodiscard]] Sharpness with_tags(const CellComplex& complex, Sharpness sharpness,
                                  std::span<const EdgeId> edges, std::span<const VertexId> vertices,
                                  float value);

}  // namespace espalier
