#pragma once

/// The faces of prisms and pyramids.

#include <cstdint>
#include <span>
#include <vector>

namespace espalier {

using VertexLoop = std::vector<std::int32_t>;

/// The faces of the prism between two loops whose vertices correspond: `lower` reversed, a
/// quadrilateral for each edge, `upper`. They are counter-clockwise seen from outside if `lower` is
/// so seen from `upper`.
[[nodiscard]] std::vector<VertexLoop> prism_loops(std::span<const std::int32_t> lower,
                                                  std::span<const std::int32_t> upper);

/// The faces of the pyramid over a loop: `base` reversed and a triangle for each edge, outward if
/// `base` is counter-clockwise seen from `apex`.
[[nodiscard]] std::vector<VertexLoop> pyramid_loops(std::span<const std::int32_t> base,
                                                    std::int32_t apex);

}  // namespace espalier
