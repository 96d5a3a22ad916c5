#pragma once

/// Control points moved, the cells kept.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/build/mesh_draft.h"

namespace espalier {

/// x' = linear · (x − about) + about + by.
struct Placement {
  glm::dmat3 linear{1};
  glm::dvec3 about{0};  ///< fixed by `linear`, model units
  glm::dvec3 by{0};     ///< model units

  [[nodiscard]] glm::dvec3 of(const glm::dvec3& x) const {
    return linear * (x - about) + about + by;
  }
};

/// Throws ParameterError for a placement that is not finite.
void require_finite(const Placement& placement);

/// A turn about an axis through the origin. Throws ParameterError for an axis that is zero or not
/// finite, or an angle that is not finite.
[[nodiscard]] glm::dmat3 rotation(const glm::dvec3& axis, double degrees);

/// Moves vertices; their displacements in a pose turn along. Throws ParameterError for vertices
/// that do not exist or are given twice, or a placement that is not finite.
[[nodiscard]] Edited placed(const CellMesh& mesh, std::span<const std::int32_t> vertices,
                            const Placement& placement);

/// Evens out the inside: `steps` times, every inner vertex moves to the mean of its neighbours
/// along edges. The boundary is kept. Throws ParameterError unless steps is in 1…10,000,
/// LatticeError if the mesh is no complex.
[[nodiscard]] Edited relaxed(const CellMesh& mesh, int steps);

}  // namespace espalier
