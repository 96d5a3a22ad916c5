#pragma once

/// The patches of a volume at rest, ready to be searched.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/volume/patch_frame.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// The patches of a volume at rest in Bézier form. Trilinear ones, of which there may be millions,
/// are made when they are asked for, the others once.
class RestPatches {
 public:
  /// slack: as PatchFrame's. O(#patches).
  RestPatches(const Volume& volume, double slack);

  [[nodiscard]] std::size_t size() const { return kept_.size(); }

  /// scratch: memory that the view may use.
  [[nodiscard]] BezierView view(std::size_t i, BezierPatch& scratch) const;

  /// The frame of a patch that is kept; nothing for a trilinear one.
  [[nodiscard]] const PatchFrame* frame(std::size_t i) const {
    return kept_[i] < 0 ? nullptr : &frames_[static_cast<std::size_t>(kept_[i])];
  }

 private:
  const Volume* volume_;
  std::vector<std::int32_t> kept_;  // number among those kept, or -1
  std::vector<std::size_t> first_;  // of those kept, in points_
  std::vector<PatchFrame> frames_;
  std::vector<glm::dvec3> points_;
  std::vector<double> weights_;  // #points_, or empty
};

}  // namespace espalier
