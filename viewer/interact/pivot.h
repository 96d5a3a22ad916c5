#pragma once

/// What chosen elements turn about and scale from, each part of them by itself.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/interact/lattice_elements.h"

namespace espalier::viewer {

/// The vertices of chosen elements, those that hang together in one set: vertices through edges
/// both of whose ends are chosen, other elements through common vertices. By their first vertex.
[[nodiscard]] std::vector<Selection> islands(const LatticeElements& elements, ElementKind kind,
                                             const Selection& chosen);

/// The middle of points.
[[nodiscard]] glm::dvec3 middle_of(std::span<const glm::dvec3> points, const Selection& some);

/// For each point the middle of the island that it is in, or that the nearest point of an island is
/// in if it is in none. islands: at least one; points: #vertices. O(#points not chosen · #chosen).
[[nodiscard]] std::vector<glm::dvec3> island_pivots(std::span<const glm::dvec3> points,
                                                    const std::vector<Selection>& islands);

}  // namespace espalier::viewer
