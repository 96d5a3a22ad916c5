#pragma once

/// What an operation would make of a lattice, before it is done.

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deform/scene/operation_text.h"
#include "deform/scene/scene.h"
#include "lattice/core/progress.h"

namespace espalier::viewer {

struct Preview {
  std::vector<glm::dvec3> segments;  ///< the net of the lattice that would result, two points each
  std::string error;                 ///< why it cannot be done; empty if it can
  bool was_stopped = false;          ///< by its progress: then nothing is known
  std::optional<Scene> posed{};      ///< if models that are bound would follow
};

/// Tries an operation that has a lattice as its result; of others nothing is known. Writes no
/// files.
[[nodiscard]] Preview preview_of(const OperationCall& call, const Scene& scene,
                                 const Progress& progress = {});

/// Stops what takes longer than a user waits while typing.
[[nodiscard]] Progress impatience();

}  // namespace espalier::viewer
