#include "viewer/app/viewer.h"

#include <algorithm>
#include <utility>

#include "viewer/render/opengl_renderer.h"

namespace espalier::viewer {

Viewer::Viewer(Progress progress)
    : renderer_(make_opengl_renderer()), session_(std::move(progress)), display_(*renderer_) {}

void Viewer::handle(const Event& event) {
  const auto* key = std::get_if<KeyPress>(&event);
  const std::string chord = key != nullptr ? key->chord : "";
  if (chord == "f1" || chord == "f2" || chord == "f3") {
    bool& shows = chord == "f1"   ? state_.shows_help
                  : chord == "f2" ? state_.shows_files
                                  : state_.shows_palette;
    shows = !shows;
    return;
  }
  const bool has_text_field = state_.shows_files || state_.shows_palette;
  if (chord == "escape" && (has_text_field || state_.shows_help)) {
    state_.shows_help = state_.shows_files = state_.shows_palette = false;
    return;
  }
  if (chord == "ctrl+q") {
    ask_to_quit();
    return;
  }
  // What is typed goes to the panel that has a text field, as long as it is open.
  const bool is_typed = key != nullptr || std::holds_alternative<TextInput>(event);
  if (is_typed ? has_text_field : gui_.handle(event)) {
    gui_.type(event);
  } else {
    session_.handle(event);
  }
}

void Viewer::open(const std::string& path) {
  if (session_.open(path)) {
    std::erase(state_.recent, path);
    state_.recent.insert(state_.recent.begin(), path);
  }
}

void Viewer::draw(double seconds) {
  const View& view = session_.view();
  state_.frame_seconds = seconds;
  gui_.begin(view.width, view.height, seconds);
  for (const Action& action : draw_panels(session_, state_)) {
    action(session_);
  }
  display_.update(session_);
  renderer_->draw(view.camera, view.width, view.height);
  gui_.end();
}

void Viewer::draw_task(std::string_view task, double fraction) {
  const View& view = session_.view();
  gui_.begin(view.width, view.height, 0);
  draw_progress(task, fraction);
  renderer_->draw(view.camera, view.width, view.height);
  gui_.end();
}

void Viewer::ask_to_quit() {
  state_.asks_to_quit = session_.journal().is_changed();
  state_.quits = !state_.asks_to_quit;
}

}  // namespace espalier::viewer
