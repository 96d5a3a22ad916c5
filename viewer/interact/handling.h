#pragma once

/// How a user likes to work: what panels and keys switch.

#include <array>

#include "viewer/interact/transform.h"
#include "viewer/render/drawing.h"

namespace espalier::viewer {

/// Whose keys and mouse buttons.
enum class Preset { Blender, Maya };

/// What points turn about and scale from.
enum class Pivot {
  Median,      ///< the mean of the selected points
  Active,      ///< the element that was selected last
  Origin,      ///< of the model's coordinates
  Box,         ///< the middle of the box round the selected points
  Individual,  ///< of each part of the selection that hangs together its own mean
  Cursor       ///< where the cursor was placed
};

/// A value.
struct Handling {
  Preset preset = Preset::Blender;
  Pivot pivot = Pivot::Median;
  TransformKind gizmo = TransformKind::Move;  ///< what its handles do
  bool has_gizmo = true;
  bool has_wireframe = false;  ///< the models' triangles are outlined
  Shading shading = Shading::Phong;
  bool is_soft = false;           ///< neighbours of what is selected follow
  double soft_radius = 0;         ///< model units
  bool is_through = true;         ///< what the lattice's outer faces hide can be selected
  bool stops_at_folds = true;     ///< a drag ends where the model's space would fold
  std::array<bool, 3> mirrors{};  ///< x, y, z: moves on the other side of the lattice's middle too
  bool operator==(const Handling&) const = default;

  [[nodiscard]] bool is_mirrored() const { return mirrors[0] || mirrors[1] || mirrors[2]; }
  [[nodiscard]] double radius() const { return is_soft ? soft_radius : 0; }
};

}  // namespace espalier::viewer
