#pragma once

/// Creases and corners: how sharp the boundary's edges and vertices are.

#include <glm/vec3.hpp>
#include <span>

#include "lattice/core/ids.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {

/// Sharpness from here on is infinite, as in OpenSubdiv: it never decays.
inline constexpr float kInfiniteSharpness = 10.0f;

/// Sharpness of every edge and vertex, 0 smooth. Only boundary elements may be sharp.
struct Sharpness {
  IdVector<EdgeId, float> edges;
  IdVector<VertexId, float> vertices;
  bool operator==(const Sharpness&) const = default;
};

/// Nothing sharp.
[[nodiscard]] Sharpness smooth_sharpness(const CellComplex& complex);

/// The automatic tags: an edge that belongs to one cell only is infinitely sharp; a vertex that
/// belongs to one cell only, or lies on three or more sharp edges, is a corner. [MJ96] section 3,
/// read edge by edge, which keeps the side of a one-layer cylinder round.
[[nodiscard]] Sharpness automatic_sharpness(const CellComplex& complex);

/// Infinitely sharp where the boundary bends by more than `degrees` in [0, 180]: edges by the angle
/// between their two boundary faces' normals, and vertices on three or more such edges. Edges where
/// cells only touch are sharp. points: #vertices, model units.
[[nodiscard]] Sharpness sharpness_by_angle(const CellComplex& complex,
                                           std::span<const glm::dvec3> points, double degrees);

/// `sharpness` with what must be sharp because cells meet only there: boundary edges with more than
/// one fan, and vertices where the boundary is no single disk, but for those on a line of two such
/// edges. These count as infinitely sharp whatever the tags say.
[[nodiscard]] Sharpness with_touching_elements(const CellComplex& complex, Sharpness sharpness);

}  // namespace espalier
