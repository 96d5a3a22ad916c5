#pragma once

/// Tying points to a volume: for each the patch that holds it and its place in the patch.

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/volume/point_locator.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// How many points have each status.
struct StatusCounts {
  std::size_t inside = 0;
  std::size_t border = 0;
  std::size_t outside = 0;
  std::size_t unconverged = 0;
};

/// Outside points that follow the boundary point closest to them, each with a weight; fringe.h
/// makes it. All arrays: #fringe, sorted by patch.
struct Fringe {
  std::vector<std::int32_t> points;       ///< index of the point
  std::vector<std::int32_t> patches;      ///< ascending
  std::vector<glm::dvec3> uvw;            ///< of the boundary point, in [0,1]³
  std::vector<double> weights;            ///< in [0, 1]
  std::vector<glm::dvec3> weight_slopes;  ///< ∂weight/∂x, as the point moves
  std::vector<glm::dmat3> uvw_slopes;     ///< ∂uvw/∂x; column b along axis b
};

/// Points tied to a volume at rest. Arrays over the points that a patch holds are sorted by patch,
/// so that evaluation reads every patch once.
struct Binding {
  std::vector<PointStatus> status;    ///< #points
  std::vector<std::int32_t> points;   ///< #held: index of the point
  std::vector<std::int32_t> patches;  ///< #held, ascending
  std::vector<glm::dvec3> uvw;        ///< #held, in [0,1]³, or within kLeafReach of it in a leaf
  Fringe fringe;                      ///< empty unless outside points follow
  [[nodiscard]] StatusCounts counts() const;
};

/// Finds every point's place, as PointLocator tells. The same result for any number of threads.
/// points: model units, finite. O(#points log #patches + #patches). Tells `progress` "embed".
[[nodiscard]] Binding embed(const PointLocator& locator, std::span<const glm::dvec3> points,
                            const Progress& progress = {});

/// The same where the volume is asked once: makes the locator.
[[nodiscard]] Binding embed(const Volume& volume, std::span<const glm::dvec3> points,
                            const Progress& progress = {});

}  // namespace espalier
