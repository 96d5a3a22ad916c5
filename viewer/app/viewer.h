#pragma once

/// The program but for what it is drawn on.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/app/display.h"
#include "viewer/app/gui.h"
#include "viewer/interact/session.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {

/// Session, renderer and panels of one picture. Needs a current OpenGL context, which must outlive
/// it.
class Viewer {
 public:
  /// progress: asked by long tasks.
  explicit Viewer(Progress progress = {});

  void handle(const Event& event);
  void open(const std::string& path);
  /// What a frame does before it is drawn: panels and what they ask for. seconds: since the last.
  void update(double seconds);
  /// A frame, drawn into the current frame buffer.
  void draw(double seconds);
  /// As handle(), while a task is under way; true if the user stops it.
  [[nodiscard]] bool stops_task(const Event& event);
  /// As draw(), while a task is under way; true if the user stops it.
  [[nodiscard]] bool draw_task(std::string_view task, double fraction);
  /// Asks about unsaved changes, if there are any.
  void ask_to_quit();
  [[nodiscard]] bool may_quit() const { return state_.quits; }

  /// Asks which sessions that did not end well to go on with; none: does not ask.
  void offer(std::vector<std::string> left) { state_.left = std::move(left); }
  [[nodiscard]] bool is_offering() const { return !state_.left.empty(); }
  /// Which of them the user wants back, or thrown away, since this was asked last.
  [[nodiscard]] std::optional<std::size_t> take_recovered() {
    return std::exchange(state_.recovered, std::nullopt);
  }
  [[nodiscard]] std::optional<std::size_t> take_thrown_away() {
    return std::exchange(state_.thrown_away, std::nullopt);
  }

  [[nodiscard]] Session& session() { return session_; }
  /// Files that were opened, the last one first, also in earlier sessions.
  [[nodiscard]] const std::vector<std::string>& recent() const { return state_.recent; }
  void set_recent(std::vector<std::string> files) { state_.recent = std::move(files); }

 private:
  [[nodiscard]] bool handle_menu(const std::string& chord);
  void remember(const std::string& path);
  void make_panels(double seconds);

  std::unique_ptr<Renderer> renderer_;
  Session session_;
  Display display_;
  Gui gui_;
  PanelState state_;
  bool has_shown_task_ = false;
};

}  // namespace espalier::viewer
