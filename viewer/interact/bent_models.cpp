#include "viewer/interact/bent_models.h"

#include <algorithm>

#include "deform/scene/lock.h"
#include "deform/scene/pose.h"
#include "lattice/tensor/tensor_lattice.h"

namespace espalier::viewer {
namespace {

Bend bend_of(const BoundModel& bound, const Lattice& lattice) {
  ControlPose pose = own_pose(lattice);
  pose.points = locked_pose(std::move(pose.points), lattice.rest_points(), bound.lock);
  pose.weights = locked_weights(std::move(pose.weights), rest_weights(lattice), bound.lock);
  return {bound.volume, bound.binding, std::move(pose.points),
          point_weights(*bound.volume, pose.weights)};
}

}  // namespace

void BentModels::update(const Scene& scene, const DrawingFrame& frame, bool is_bent) {
  drag_.reset();
  const bool is_same_frame = frame.origin == frame_.origin;
  frame_ = frame;
  std::erase_if(models_, [&](const auto& entry) {
    const auto found = scene.models.find(entry.first);
    return !is_same_frame || found == scene.models.end() ||
           found->second.bytes().data() != entry.second.model().bytes().data();
  });
  bends_.clear();
  for (const auto& [names, bound] : scene.bound) {
    if (is_bent) {
      Bends& bends = bends_[names.first];
      bends.bends.push_back(bend_of(bound, lattice_in(scene, names.second)));
      bends.lattices.push_back(names.second);
      bends.locked.push_back(bound.lock.controls);
    }
  }
  for (const auto& [name, model] : scene.models) {
    if (!models_.contains(name)) {
      // Revisions of models that took one another's place never meet.
      models_.emplace(name, BentModel(model, frame, ++n_made_ << 32));
    }
    const auto influence = scene.influences.find(name);
    models_.at(name).set_influence(influence == scene.influences.end() ? nullptr
                                                                       : influence->second);
    models_.at(name).bend(bends_[name].bends);
  }
}

std::optional<std::size_t> BentModels::dragged(const std::string& model) const {
  const std::vector<std::string>& lattices = bends_.at(model).lattices;
  const auto found = std::find(lattices.begin(), lattices.end(), drag_->lattice);
  return found == lattices.end()
             ? std::nullopt
             : std::optional(static_cast<std::size_t>(found - lattices.begin()));
}

std::vector<glm::dvec3> BentModels::locked(const std::string& model, std::size_t bend,
                                           std::span<const glm::dvec3> controls) const {
  std::vector<glm::dvec3> result(controls.begin(), controls.end());
  const Bends& bends = bends_.at(model);
  for (const std::int32_t control : bends.locked[bend]) {
    const auto i = static_cast<std::size_t>(control);
    result[i] = bends.bends[bend].controls[i];
  }
  return result;
}

void BentModels::begin_drag(ControlDrag drag) {
  cancel_drag();
  drag_ = std::move(drag);
  for (auto& [name, model] : models_) {
    const auto bend = dragged(name);
    // Weights of its own make a pose rational, which no drag knows.
    drag_->is_fast &= !bend || bends_[name].bends[*bend].pose_weights.empty();
  }
  for (auto& [name, model] : models_) {
    const auto bend = dragged(name);
    if (bend && drag_->is_fast) {
      DragPlan plan = drag_->plan;
      plan.dragged = *bend;
      plan.controls = locked(name, *bend, plan.controls);
      for (const std::int32_t control : bends_.at(name).locked[*bend]) {
        plan.weights[static_cast<std::size_t>(control)] = 0;
      }
      model.begin_drag(plan);
    } else if (bend) {
      model.begin_evaluation();
    }
  }
}

double BentModels::follow(const DragMotion& motion, std::span<const glm::dvec3> target,
                          bool stops_at_folds) {
  return drag_->is_fast ? follow_fast(motion, stops_at_folds)
                        : follow_slowly(target, stops_at_folds);
}

double BentModels::follow_fast(const DragMotion& motion, bool stops_at_folds) {
  double fraction = 1;
  for (const auto& [name, model] : models_) {
    if (stops_at_folds && dragged(name)) {
      fraction = std::min(fraction, model.safe_fraction(motion));
    }
  }
  for (auto& [name, model] : models_) {
    if (dragged(name)) {
      model.follow(fraction < 1 ? motion.part(fraction) : motion, !stops_at_folds);
    }
  }
  return fraction;
}

/// Looks for a stop only where something is folded at the end of the way.
double BentModels::follow_slowly(std::span<const glm::dvec3> target, bool stops_at_folds) {
  double fraction = 1;
  for (auto& [name, model] : models_) {
    const auto bend = dragged(name);
    // Of a pose with weights of its own no way to the fold is known.
    if (!bend) {
      continue;
    }
    const std::vector<glm::dvec3> to = locked(name, *bend, target);
    if (model.evaluate(*bend, to) && stops_at_folds &&
        bends_[name].bends[*bend].pose_weights.empty()) {
      fraction = std::min(fraction, model.safe_fraction(bends_[name].bends, *bend, to));
    }
  }
  if (fraction < 1) {
    std::vector<glm::dvec3> controls(target.begin(), target.end());
    for (std::size_t i = 0; i < controls.size(); ++i) {
      controls[i] = drag_->start[i] + fraction * (controls[i] - drag_->start[i]);
    }
    for (auto& [name, model] : models_) {
      if (const auto bend = dragged(name)) {
        model.evaluate(*bend, locked(name, *bend, controls));
      }
    }
  }
  return fraction;
}

void BentModels::cancel_drag() {
  if (drag_) {
    drag_.reset();
    for (auto& [name, model] : models_) {
      model.bend(bends_[name].bends);
    }
  }
}

}  // namespace espalier::viewer
