#pragma once

/// From a model's points to the vertices that are drawn at them.

#include <cstdint>
#include <span>

#include "deform/embed/embed.h"

namespace espalier::viewer {

/// A binding of points as one of the vertices that are drawn at them. vertex_points: the point of
/// each vertex. O(#points + #vertices).
[[nodiscard]] Binding binding_of_vertices(const Binding& binding,
                                          std::span<const std::uint32_t> vertex_points);

}  // namespace espalier::viewer
