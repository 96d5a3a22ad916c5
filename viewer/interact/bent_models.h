#pragma once

/// The models of a scene as their lattices bend them, and while these are dragged.

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/scene/scene.h"
#include "viewer/interact/bent_model.h"

namespace espalier::viewer {

/// Control points of one lattice on their way.
struct ControlDrag {
  std::string lattice;
  std::vector<glm::dvec3> start;  ///< #controls at mouse-down
  DragPlan plan;                  ///< where is_fast; `dragged` is found by the models
  bool is_fast = false;           ///< one displacement, or one linear map, moves all of them
};

/// One BentModel a model, and what bends it.
class BentModels {
 public:
  /// Makes the models that are new, and bends all that are not bent so yet: by all lattices that
  /// they are bound to, or by none. Ends a drag.
  void update(const Scene& scene, const DrawingFrame& frame, bool is_bent);

  /// Mouse-down, after update(): from here on the lattice's control points move.
  void begin_drag(ControlDrag drag);
  [[nodiscard]] bool is_dragging() const { return drag_.has_value(); }
  /// The models as they are with the control points at `target`, where `motion` takes them if the
  /// drag is fast; or, if it stops at folds, as far on the straight way there as nothing folds.
  /// Returns that part of the way. target: #controls.
  double follow(const DragMotion& motion, std::span<const glm::dvec3> target, bool stops_at_folds);
  /// Back to mouse-down.
  void cancel_drag();

  [[nodiscard]] const std::map<std::string, BentModel>& all() const { return models_; }

 private:
  struct Bends {
    std::vector<Bend> bends;
    std::vector<std::string> lattices;              ///< #bends
    std::vector<std::vector<std::int32_t>> locked;  ///< #bends: controls that count as unmoved
  };
  /// Where the controls are for a model: those that are locked stay.
  [[nodiscard]] std::vector<glm::dvec3> locked(const std::string& model, std::size_t bend,
                                               std::span<const glm::dvec3> controls) const;
  [[nodiscard]] std::optional<std::size_t> dragged(const std::string& model) const;
  double follow_fast(const DragMotion& motion, bool stops_at_folds);
  double follow_slowly(std::span<const glm::dvec3> target, bool stops_at_folds);

  DrawingFrame frame_;
  std::map<std::string, BentModel> models_;
  std::uint64_t n_made_ = 0;
  std::map<std::string, Bends> bends_;  // by model, at mouse-down
  std::optional<ControlDrag> drag_;
};

}  // namespace espalier::viewer
