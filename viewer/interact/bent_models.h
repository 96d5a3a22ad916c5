#pragma once

/// Models as their lattices bend them, while these are moved.

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "viewer/interact/session.h"

namespace espalier::viewer {

/// A bound lattice, and where its control points are on the screen.
struct Bend {
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const Binding> binding;
  std::vector<glm::dvec3> controls;

  bool operator==(const Bend&) const = default;
};

/// What bends a model on the screen: in Pose mode all lattices that it is bound to, with a
/// transform in progress; nothing in other modes. O(#controls).
[[nodiscard]] std::vector<Bend> bends_of(const Session& session, const std::string& model);

/// Where a model's points go. rest: #points. O(#points · degree³).
[[nodiscard]] std::vector<glm::dvec3> bent_points(std::span<const glm::dvec3> rest,
                                                  std::span<const Bend> bends);

}  // namespace espalier::viewer
