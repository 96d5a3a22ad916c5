#include "viewer/app/viewer.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lattice/core/error.h"
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
  const bool has_text_field = state_.shows_files || state_.shows_palette || state_.form;
  if (chord == "escape" && (has_text_field || state_.shows_help || is_offering())) {
    state_.left.clear();
    state_.shows_help = state_.shows_files = state_.shows_palette = false;
    state_.form.reset();
    session_.end_preview();
    return;
  }
  if (key != nullptr && !has_text_field && handle_menu(chord)) {
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

/// A digit takes an entry of the menu that is open, any other key closes it.
bool Viewer::handle_menu(const std::string& chord) {
  if (state_.menu == nullptr) {
    state_.menu = session_.transform() ? nullptr : menu_on(chord);
    return state_.menu != nullptr;
  }
  const Menu& menu = *std::exchange(state_.menu, nullptr);
  const std::string digit = chord.starts_with("kp") ? chord.substr(2) : chord;
  for (std::size_t i = 0; i < menu.entries.size(); ++i) {
    if (digit == std::to_string(i + 1)) {
      menu.entries[i].run(session_);
    }
  }
  return true;
}

void Viewer::open(const std::string& path) {
  if (session_.open(path)) {
    remember(path);
  }
}

/// Files are remembered where they are, wherever the program runs next.
void Viewer::remember(const std::string& path) {
  constexpr std::size_t kMost = 12;
  std::error_code failure;
  const std::string absolute = std::filesystem::absolute(path, failure).string();
  std::erase(state_.recent, absolute);
  state_.recent.insert(state_.recent.begin(), absolute);
  state_.recent.resize(std::min(state_.recent.size(), kMost));
}

void Viewer::update(double seconds) {
  state_.frame_seconds = seconds;
  has_shown_task_ = false;
  make_panels(seconds);
  if (has_shown_task_) {
    make_panels(0);  // the task's panel took their place
  }
  // What could not be saved is not lost.
  if (std::exchange(state_.saves_and_quits, false)) {
    state_.quits = !session_.journal().is_changed();
  }
  const std::string opened = std::exchange(state_.opened, "");
  if (session_.scene().models.contains(opened) || session_.scene().lattices.contains(opened)) {
    remember(opened);
  }
  try {
    display_.update(session_);
  } catch (const Error& error) {
    session_.say(error.what());
    session_.set_show(Show());  // what cannot be shown is not asked for again
  }
}

void Viewer::draw(double seconds) {
  update(seconds);
  const View& view = session_.view();
  renderer_->draw(view.camera, view.width, view.height);
  gui_.draw();
}

/// Actions are done once the panels are finished: long ones draw frames of their own.
void Viewer::make_panels(double seconds) {
  gui_.begin(session_.view().width, session_.view().height, seconds);
  const std::vector<Action> actions = draw_panels(session_, state_);
  gui_.finish();
  for (const Action& action : actions) {
    try {
      action(session_);
    } catch (const Error& error) {
      session_.say(error.what());
    }
  }
}

bool Viewer::stops_task(const Event& event) {
  const auto* key = std::get_if<KeyPress>(&event);
  static_cast<void>(gui_.handle(event));
  return key != nullptr && key->chord == "escape";
}

/// A panel that is new has its size, and is seen, in the frame after.
bool Viewer::draw_task(std::string_view task, double fraction) {
  const View& view = session_.view();
  bool is_stopped = false;
  for (int frame = std::exchange(has_shown_task_, true) ? 1 : 0; frame < 2; ++frame) {
    gui_.begin(view.width, view.height, 0);
    is_stopped |= draw_progress(task, fraction);
    gui_.finish();
  }
  renderer_->draw(view.camera, view.width, view.height);
  gui_.draw();
  return is_stopped;
}

void Viewer::ask_to_quit() {
  state_.asks_to_quit = session_.journal().is_changed();
  state_.quits = !state_.asks_to_quit;
}

}  // namespace espalier::viewer
