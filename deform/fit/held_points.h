#pragma once

/// Whether a volume holds the points it was made for.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "lattice/core/progress.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// How many points lie outside a volume at rest, or nearer to its boundary than `clearance` by more
/// than 0.1 % of it. points: model units, finite; clearance: model units, 0 or more. The same
/// result for any number of threads.
[[nodiscard]] std::size_t count_not_held(const Volume& volume, std::span<const glm::dvec3> points,
                                         double clearance, const Progress& progress = {});

}  // namespace espalier
