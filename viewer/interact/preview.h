#pragma once

/// What an operation would make of a lattice, before it is done.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "deform/scene/operation_text.h"
#include "deform/scene/scene.h"

namespace espalier::viewer {

struct Preview {
  std::vector<glm::dvec3> segments;  ///< the net of the lattice that would result, two points each
  std::string error;                 ///< why it cannot be done; empty if it can, or takes long
};

/// Tries an operation that has a lattice as its result, for as long as a user does not notice; of
/// others, and of those that take longer, nothing is known. Writes no files.
[[nodiscard]] Preview preview_of(const OperationCall& call, const Scene& scene);

}  // namespace espalier::viewer
