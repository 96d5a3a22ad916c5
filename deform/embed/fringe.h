#pragma once

/// Outside points that follow the volume's boundary, the less the farther they are.

#include <span>
#include <vector>

#include "deform/embed/embed.h"

namespace espalier {

/// How much a point at `distance` from the boundary follows it: 1 − 3τ² + 2τ³ with τ = distance /
/// reach, so 1 at the boundary, 0 from `reach` on, and without slope at both.
[[nodiscard]] double falloff(double distance, double reach);

/// Finds for every point of status Outside that is less than `reach` from the volume's boundary the
/// closest boundary point: x' = x + falloff · displacement there. So nothing jumps at the border or
/// at `reach`; where two boundary points are equally close, beside a hollow of the boundary, the
/// motion is that of either, and may jump.
///
/// Newton's method on the boundary's Bézier faces from the closest of a grid of samples: exact to
/// round-off on faces that bend less than once across a sample. points: #points, those that were
/// embedded; reach: model units, > 0. The same result for any number of threads. Tells `progress`
/// "falloff".
[[nodiscard]] Fringe make_fringe(const Volume& volume, std::span<const glm::dvec3> points,
                                 std::span<const PointStatus> status, double reach,
                                 const Progress& progress = {});

}  // namespace espalier
