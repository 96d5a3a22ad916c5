#include "viewer/interact/session.h"

#include <glm/geometric.hpp>
#include <utility>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

Box bounds_of(const Scene& scene) {
  Box box;
  for (const auto& [name, model] : scene.models) {
    box.add(model.points());
  }
  for (const auto& [name, lattice] : scene.lattices) {
    box.add(lattice.rest_points());
    box.add(lattice.posed_points());
  }
  return box;
}

/// The control points that count as unmoved for every model bound to a lattice.
Selection locked_by_all(const Scene& scene, const std::string& lattice) {
  std::map<std::int32_t, std::size_t> n_locks;
  std::size_t n_bound = 0;
  for (const auto& [names, bound] : scene.bound) {
    if (names.second == lattice) {
      ++n_bound;
      for (const std::int32_t control : bound.lock.controls) {
        ++n_locks[control];
      }
    }
  }
  Selection locked;
  for (const auto& [control, n] : n_locks) {
    if (n == n_bound) {
      locked.insert(control);
    }
  }
  return locked;
}

}  // namespace

void Session::say(const std::string& message) {
  std::erase(messages_, message);
  messages_.push_back(message);
}

void Session::handle(const Event& event) {
  try {
    std::visit([this](const auto& what) { on(what); }, event);
  } catch (const Error& error) {
    say(error.what());
    cancel_transform();
  }
}

bool Session::apply(const OperationCall& call) {
  transform_.reset();
  fraction_ = 1;
  const Preview before = std::exchange(preview_, Preview());
  try {
    journal_.apply(call, progress_);
    scene_changed();
    return true;
  } catch (const Error& error) {
    say(call.operation + ": " + error.what());
    bent_.cancel_drag();
    if (before.posed) {
      bend_models();
    }
    return false;
  }
}

bool Session::open(const std::string& path) {
  const bool is_first = scene().models.empty() && scene().lattices.empty();
  const bool is_open = apply({"open", Arguments({{"path", path}})});
  if (is_open && is_first) {
    frame_all();
  }
  return is_open;
}

bool Session::run_line(const std::string& line) {
  try {
    return apply(parse_call(line));
  } catch (const Error& error) {
    say(error.what());
    return false;
  }
}

bool Session::recover(const std::string& journal_text) {
  bool is_whole = true;
  try {
    replay(journal_text, journal_, progress_);
  } catch (const Error& error) {
    say(error.what());
    is_whole = false;
  }
  scene_changed();
  frame_all();
  return is_whole;
}

/// The chosen lattice may be gone or another one, and so what a preview was made from.
void Session::scene_changed() {
  preview_.posed.reset();
  if (!scene().lattices.contains(lattice_)) {
    lattice_ = scene().lattices.empty() ? "" : scene().lattices.begin()->first;
    elements_source_.reset();
  }
  if (lattice_.empty()) {
    elements_ = LatticeElements();
    elements_source_.reset();
  } else if (const Lattice& now = lattice_in(scene(), lattice_);
             !elements_source_ || !is_same(now, *elements_source_)) {
    const LatticeElements before = std::exchange(elements_, elements_of(now));
    if (!elements_source_ || !elements_.is_same_net(before)) {
      selection_.clear();
      last_selected_.clear();
      show_.hidden_vertices.clear();
      show_.hidden_cells.clear();
    }
    elements_source_ = now;
  }
  if (lattice_.empty()) {
    selection_.clear();
  }
  note_bindings();
  refresh();
}

/// They are kept where the binding itself is dropped.
void Session::note_bindings() {
  for (const auto& [names, bound] : scene().bound) {
    habits_[names] = {bound.freeze, bound.outside, bound.lock.option};
  }
}

/// What follows from the scene, the mode and what is shown.
void Session::refresh() {
  visible_ = lattice_.empty()
                 ? Visible()
                 : visible_elements(elements_, points_of(scene(), lattice_, Shape::Rest), show_);
  find_points();
  bend_models();
}

void Session::bend_models() {
  bent_.update(preview_.posed ? *preview_.posed : scene(), view_.frame, mode_ == Mode::Pose);
}

/// Bound models follow a pose that is only looked at.
void Session::preview(const OperationCall& call, bool waits) {
  cancel_transform();
  preview_ = preview_of(call, scene(), waits ? progress_ : impatience());
  bend_models();
}

void Session::end_preview() {
  const bool is_posed = preview_.posed.has_value();
  preview_ = Preview();
  if (is_posed) {
    bend_models();
  }
}

/// What every bound model takes as unmoved is shown where it counts: at rest.
void Session::find_points() {
  locked_.clear();
  points_.clear();
  if (lattice_.empty()) {
    return;
  }
  const auto points = points_of(scene(), lattice_, shape());
  points_.assign(points.begin(), points.end());
  if (mode_ != Mode::Pose) {
    return;
  }
  locked_ = locked_by_all(scene(), lattice_);
  const auto rest = points_of(scene(), lattice_, Shape::Rest);
  for (const std::int32_t control : locked_) {
    const auto i = static_cast<std::size_t>(control);
    points_[i] = rest[i];
  }
}

void Session::choose_lattice(const std::string& name) {
  if (scene().lattices.contains(name) && name != lattice_) {
    cancel_transform();
    lattice_ = name;
    elements_source_.reset();
    scene_changed();
  }
}

void Session::set_mode(Mode mode) {
  cancel_transform();
  if (mode != mode_) {
    forget_messages();  // they were about the other mode
  }
  mode_ = mode;
  refresh();
}

void Session::set_show(const Show& show) {
  show_ = show;
  visible_ = lattice_.empty()
                 ? Visible()
                 : visible_elements(elements_, points_of(scene(), lattice_, Shape::Rest), show_);
  std::erase_if(selection_, [&](std::int32_t element) {
    return !visible_.of(kind_)[static_cast<std::size_t>(element)];
  });
}

void Session::set_handling(const Handling& handling) {
  const bool has_no_radius = handling.is_soft && handling.soft_radius == 0 && !lattice_.empty();
  handling_ = handling;
  if (has_no_radius) {
    handling_.soft_radius = 0.3 * box_of(shown_points()).radius();
  }
}

void Session::undo() {
  cancel_transform();
  journal_.undo();
  scene_changed();
}

void Session::redo() {
  cancel_transform();
  journal_.redo();
  scene_changed();
}

/// What is being dragged stays in its frame.
void Session::frame_all() {
  const Box box = bounds_of(scene());
  if (!transform_) {
    view_.frame = DrawingFrame::of(box);
    refresh();
  }
  view_.camera = view_.camera.fitted_to(view_.frame.to_drawing(box), view_.aspect());
}

void Session::frame_selected() {
  Box box;
  const std::span<const glm::dvec3> points = shown_points();
  for (const std::int32_t vertex : selected_vertices()) {
    box.add(view_.frame.to_drawing(points[static_cast<std::size_t>(vertex)]));
  }
  if (box.radius() > 0) {
    const double radius = view_.camera.radius;
    view_.camera = view_.camera.fitted_to(box, view_.aspect(), 0.2);
    view_.camera.radius = 2 * radius + glm::length(view_.camera.target);
  }
}

void Session::look_from(const std::string& view_name) {
  view_.camera.angles = named_view(view_name);
}

void Session::toggle_projection() {
  view_.camera.projection = view_.camera.projection == Projection::Perspective
                                ? Projection::Orthographic
                                : Projection::Perspective;
}

std::string Session::status() const {
  if (transform_) {
    const bool is_stopped = fraction_ < 1;
    return transform_->text(view_) + (is_stopped ? "   stopped: space would fold" : "") +
           (transform_->is_held ? "" : "   Enter or click: done   Esc: cancel   x y z: axis");
  }
  if (lattice_.empty()) {
    return scene().models.empty()
               ? "Open a model or a lattice: drop their files here, or press F2."
               : "Make a lattice round the model: press n for a box, or F3 for all kinds.";
  }
  if (mode_ == Mode::Bind) {
    return "b ties the models to the lattice   Tab: on to the pose   F1 help";
  }
  const bool is_blender = handling_.preset == Preset::Blender;
  return std::to_string(selection_.size()) + " selected   " +
         (is_blender ? "g move   r turn   s scale" : "w move   e turn   r scale") + "   F1 help";
}

}  // namespace espalier::viewer
