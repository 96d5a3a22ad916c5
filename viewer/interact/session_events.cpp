/// What mouse and keys mean to a session.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "lattice/core/error.h"
#include "viewer/interact/commands.h"

namespace espalier::viewer {
namespace {

/// A press and a release no farther apart than this are a click, pixels.
constexpr double kClick = 4;
constexpr double kZoomAPixel = 0.02;
constexpr double kSoftAStep = 1.15;

}  // namespace

bool Session::on_transform_key(const std::string& chord) {
  if (chord == "enter" || chord == "kpenter") {
    finish_transform();
    return true;
  }
  if (chord == "escape") {
    cancel_transform();
    return true;
  }
  const bool is_plane = chord.starts_with("shift+");
  const std::string key = is_plane ? chord.substr(6) : chord;
  if (key == "x" || key == "y" || key == "z") {
    transform_->toggle({key[0] - 'x', is_plane});
    follow_transform();
    return true;
  }
  const bool is_typed = transform_->type(key.starts_with("kp") ? key.substr(2) : key);
  if (is_typed) {
    follow_transform();
  }
  return is_typed;
}

void Session::on(const KeyPress& key) {
  if (transform_ && on_transform_key(key.chord)) {
    return;
  }
  for (const Command& command : commands(handling_.preset)) {
    if ((" " + command.keys + " ").find(" " + key.chord + " ") != std::string::npos) {
      command.run(*this);
      return;
    }
  }
}

Session::Drag Session::drag_of(const MousePress& press) const {
  if (press.held.alt && handling_.preset == Preset::Maya && press.button != MouseButton::Left) {
    return press.button == MouseButton::Middle ? Drag::Pan : Drag::Zoom;
  }
  switch (press.button) {
    case MouseButton::Left:
      return press.held.alt ? Drag::Orbit : Drag::Select;
    case MouseButton::Middle:
      return press.held.shift ? Drag::Pan : press.held.ctrl ? Drag::Zoom : Drag::Orbit;
    default:
      return press.held.shift && !press.held.alt ? Drag::Cursor : Drag::None;
  }
}

void Session::on(const MousePress& press) {
  mouse_ = press.at;
  held_ = press.held;
  if (transform_) {
    if (press.button == MouseButton::Left) {
      transform_->at = press.at;
      follow_transform();
      finish_transform();
    } else if (press.button == MouseButton::Right) {
      cancel_transform();
    }
    return;
  }
  drag_ = drag_of(press);
  if (drag_ == Drag::Cursor) {
    place_cursor(press.at);
  }
  const auto handle = drag_ == Drag::Select ? active_handle() : std::nullopt;
  if (handle) {
    drag_ = Drag::None;
    begin_transform(handling_.gizmo);
    if (transform_) {
      transform_->lock = *handle;
      transform_->is_held = true;
    }
  } else if (press.button == MouseButton::Left) {
    rubber_ = Rubber{press.at, press.at};
  }
}

void Session::on(const MouseMove& move) {
  const glm::dvec2 by = move.at - mouse_;
  mouse_ = move.at;
  if (transform_) {
    transform_->at = move.at;
    follow_transform();
  }
  if (drag_ == Drag::Orbit) {
    view_.camera = orbited(view_.camera, by);
  } else if (drag_ == Drag::Pan) {
    view_.camera = panned(view_.camera, by, view_.height);
  } else if (drag_ == Drag::Zoom) {
    view_.camera = zoomed(view_.camera, -kZoomAPixel * by.y);
  }
  if (drag_ == Drag::Cursor) {
    place_cursor(move.at);
  }
  if (rubber_) {
    rubber_->to = move.at;
  }
}

void Session::on(const MouseRelease& release) {
  on(MouseMove{release.at});
  if (transform_ && transform_->is_held && release.button == MouseButton::Left) {
    finish_held(release.at);
    return;
  }
  const Drag drag = std::exchange(drag_, Drag::None);
  const std::optional<Rubber> box = std::exchange(rubber_, std::nullopt);
  if (!box || lattice_.empty()) {
    return;
  }
  const bool is_click = glm::length(box->to - box->from) <= kClick;
  if (drag == Drag::Orbit && is_click) {
    click_loop(release.at);
  } else if (drag == Drag::Select && is_click) {
    click(release.at);
  } else if (drag == Drag::Select) {
    select_box(*box);
  }
}

/// A click on a handle is for what lies behind it.
void Session::finish_held(const glm::dvec2& at) {
  if (glm::length(at - transform_->from) <= kClick) {
    cancel_transform();
    click(at);
  } else {
    finish_transform();
  }
}

void Session::on(const Scroll& scroll) {
  if (transform_ && handling_.is_soft) {
    handling_.soft_radius *= std::pow(kSoftAStep, scroll.steps);
    begin_drag();
    follow_transform();
  } else {
    view_.camera = zoomed(view_.camera, scroll.steps);
  }
}

void Session::on(const Resize& size) {
  view_.width = std::max(size.width, 1);
  view_.height = std::max(size.height, 1);
}

}  // namespace espalier::viewer
