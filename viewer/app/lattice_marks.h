#pragma once

/// What a session's lattice is drawn with: lines and dots.

#include <string>

#include "viewer/interact/influence_heat.h"
#include "viewer/interact/session.h"
#include "viewer/render/drawing.h"
#include "viewer/render/drawing_frame.h"

namespace espalier::viewer {

/// In drawing units; empty where there is nothing to see.
struct LatticeMarks {
  LineSet cage;  ///< between control points: sharp red, outer green, inner blue; by level from 1
  PointSet controls;  ///< yellow where they are corners, red where locked; by level
  PointSet chosen;    ///< halos of those that are selected
  LineSet rest;       ///< in Pose mode, faint: where the lattice was
  LineSet ghost;      ///< of cells to come
  LineSet gizmo;
  LineSet cursor;
};

[[nodiscard]] LatticeMarks lattice_marks(const Session& session);

/// In Bind mode the points of the chosen lattice's models: green if it holds them, else red; in
/// other modes those that are folded.
[[nodiscard]] PointSet model_marks(const Session& session);

/// Adds the points of a bound model by how much the selection moves them, or all lattices may if
/// nothing is selected.
void add_influence_marks(const Session& session, const std::string& model,
                         const InfluenceHeat& heat, PointSet& dots);

/// Of the control points of a level of a hierarchy.
[[nodiscard]] glm::vec3 level_color(std::int32_t level);

}  // namespace espalier::viewer
