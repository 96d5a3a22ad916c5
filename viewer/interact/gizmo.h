#pragma once

/// Handles round a pivot that move, turn or scale what is selected.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "viewer/interact/transform.h"
#include "viewer/interact/view.h"

namespace espalier::viewer {

struct Gizmo {
  TransformKind kind = TransformKind::Move;  ///< or Turn or Scale
  glm::dvec3 pivot{0.0};                     ///< model units
};

/// One handle as it is drawn: an axis, a plane (of Move), or all at once.
struct GizmoHandle {
  AxisLock lock{};
  std::vector<glm::dvec3>
      segments{};        ///< two points each, model units; the same number in all views
  bool is_area = false;  ///< the inside of its outline is hit, too

  [[nodiscard]] bool is(const AxisLock& other) const {
    return lock.axis == other.axis && lock.is_plane == other.is_plane;
  }
};

/// The handles, as large on the screen in every view.
[[nodiscard]] std::vector<GizmoHandle> gizmo_handles(const Gizmo& gizmo, const View& view);

/// What the handle under the mouse locks: that whose lines are nearest, within 7 pixels, or whose
/// area covers the place.
[[nodiscard]] std::optional<AxisLock> gizmo_hit(const Gizmo& gizmo, const View& view,
                                                const glm::dvec2& pixel);

}  // namespace espalier::viewer
