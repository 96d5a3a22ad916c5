#pragma once

/// How much room a closed model encloses, and how that changes as it is deformed.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "lattice/core/compressed_rows.h"

namespace espalier {

/// The volume inside closed surfaces whose faces run counter-clockwise seen from outside; negative
/// if they run the other way. Polygons count as fans of triangles from their first corners.
/// points: model units; faces: loops of points.
[[nodiscard]] double signed_volume(std::span<const glm::dvec3> points,
                                   const CompressedRows<std::int32_t>& faces);

/// Whether the faces are closed with one outside: as many run along every edge in one direction as
/// in the other; no for no faces. Points in one place count as one. O(n log n).
[[nodiscard]] bool is_closed(std::span<const glm::dvec3> points,
                             const CompressedRows<std::int32_t>& faces);

/// 100 (V' / V − 1), in per cent; none if the faces are not closed or enclose nothing at rest.
/// before, after: #points, model units.
[[nodiscard]] std::optional<double> volume_change(std::span<const glm::dvec3> before,
                                                  std::span<const glm::dvec3> after,
                                                  const CompressedRows<std::int32_t>& faces);

}  // namespace espalier
