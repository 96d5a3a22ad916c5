/// How a session moves control points.

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "lattice/core/box.h"
#include "viewer/interact/pivot.h"
#include "viewer/interact/session.h"
#include "viewer/interact/symmetry.h"

namespace espalier::viewer {

bool Session::may_move() {
  if (lattice_.empty() || selection_.empty()) {
    say("Select control points first: click them, or press a for all.");
  } else if (mode_ == Mode::Bind) {
    say("Bind mode moves nothing: press Tab for Pose mode.");
  } else if (std::ranges::includes(locked_, selected_vertices())) {
    say("A lock keeps these control points at rest, or the model would tear where it leaves the "
        "lattice; the list below the model's name takes it away.");
  } else {
    return true;
  }
  return false;
}

void Session::begin_transform(TransformKind kind) {
  if (!may_move()) {
    return;
  }
  cancel_transform();
  end_preview();
  if (kind != TransformKind::Extrude) {
    handling_.gizmo = kind;
  }
  transform_ = Transform{kind, {}, {}, mouse_, mouse_, pivot(), glm::dvec3(0.0), false, {}};
  begin_drag();
}

/// What the handles stand at; where every part has its own, the mean of all.
glm::dvec3 Session::pivot() const {
  const std::span<const glm::dvec3> points = shown_points();
  const Selection vertices = selected_vertices();
  switch (handling_.pivot) {
    case Pivot::Origin:
      return glm::dvec3(0.0);
    case Pivot::Active:
      return middle_of(points, last_selected_.empty() ? vertices : last_selected_);
    case Pivot::Cursor:
      return cursor_ ? *cursor_ : middle_of(points, vertices);
    case Pivot::Box: {
      Box box;
      for (const std::int32_t vertex : vertices) {
        box.add(points[static_cast<std::size_t>(vertex)]);
      }
      return box.center();
    }
    default:
      return middle_of(points, vertices);
  }
}

/// From mouse-down: also where the radius of a soft selection changed since.
void Session::begin_drag() {
  if (transform_->kind == TransformKind::Extrude) {
    return;
  }
  weights_ = soft_weights(points_, selected_vertices(), handling_.radius());
  transform_->pivots = handling_.pivot == Pivot::Individual
                           ? island_pivots(points_, islands(elements_, kind_, selection_))
                           : std::vector<glm::dvec3>();
  for (const std::int32_t control : locked_) {
    weights_[static_cast<std::size_t>(control)] = 0;
  }
  moved_ = points_;
  fraction_ = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    images_.at(at) = handling_.mirrors.at(at)
                         ? mirror_images(points_of(scene(), lattice_, Shape::Rest), axis)
                         : std::vector<std::int32_t>();
  }
  if (mode_ == Mode::Pose) {
    const bool is_turned = transform_->kind != TransformKind::Move;
    // A soft turn gives every point an angle of its own.
    const bool is_fast = !handling_.is_mirrored() &&
                         !(transform_->kind == TransformKind::Turn && handling_.radius() > 0);
    // A point with a pivot of its own moves as one that stands so to the common one.
    std::vector<glm::dvec3> controls = points_;
    for (std::size_t i = 0; i < transform_->pivots.size(); ++i) {
      controls[i] += transform_->pivot - transform_->pivots[i];
    }
    bent_.begin_drag({lattice_,
                      points_,
                      {0, weights_, std::move(controls), transform_->pivot, is_turned},
                      is_fast});
  }
}

void Session::follow_transform() {
  if (!transform_ || transform_->kind == TransformKind::Extrude) {
    return;
  }
  moved_ = transform_->apply(view_, points_, weights_);
  mirror(moved_);
  if (!bent_.is_dragging()) {
    return;
  }
  fraction_ = bent_.follow(transform_->motion(view_), moved_, handling_.stops_at_folds);
  if (fraction_ < 1) {
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      moved_[i] = points_[i] + fraction_ * (moved_[i] - points_[i]);
    }
  }
}

void Session::mirror(std::vector<glm::dvec3>& to) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto& images = images_.at(static_cast<std::size_t>(axis)); !images.empty()) {
      mirror_motion(points_, images, axis, to);
    }
  }
  for (const std::int32_t control : locked_) {
    const auto i = static_cast<std::size_t>(control);
    to[i] = points_[i];
  }
}

void Session::cancel_transform() {
  transform_.reset();
  fraction_ = 1;
  bent_.cancel_drag();
}

std::span<const glm::dvec3> Session::shown_points() const {
  const bool is_moving = transform_ && transform_->kind != TransformKind::Extrude;
  return is_moving ? moved_ : points_;
}

std::optional<Gizmo> Session::gizmo() const {
  const bool has_gizmo = handling_.has_gizmo && !lattice_.empty() && !selection_.empty() &&
                         mode_ != Mode::Bind && (!transform_ || transform_->is_held);
  if (!has_gizmo) {
    return std::nullopt;
  }
  if (!transform_) {
    return Gizmo{handling_.gizmo, pivot()};
  }
  const glm::dvec3 by = fraction_ * transform_->motion(view_).displacement;
  return Gizmo{transform_->kind, transform_->pivot + by};
}

std::optional<AxisLock> Session::active_handle() const {
  if (transform_ && transform_->is_held) {
    return transform_->lock;
  }
  const auto shown = gizmo();
  return shown ? gizmo_hit(*shown, view_, mouse_) : std::nullopt;
}

void Session::finish_transform() {
  if (transform_->kind == TransformKind::Extrude) {
    finish_extrusion();
    return;
  }
  const std::vector<glm::dvec3>& before = points_;
  const std::vector<glm::dvec3> after = moved_;
  std::vector<std::int64_t> indices;
  std::vector<double> to;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] != before[i]) {
      indices.push_back(static_cast<std::int64_t>(i));
      to.insert(to.end(), {after[i].x, after[i].y, after[i].z});
    }
  }
  if (indices.empty()) {
    cancel_transform();
  } else {
    apply({"move points", Arguments({{"lattice", lattice_},
                                     {"points", std::move(indices)},
                                     {"to", std::move(to)},
                                     {"shape", shape_name()}})});
  }
}

}  // namespace espalier::viewer
