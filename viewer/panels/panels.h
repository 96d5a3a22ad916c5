#pragma once

/// What stands round the picture: state in, actions out. Made between Gui::begin() and end().

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/interact/commands.h"

namespace espalier::viewer {

/// What a panel wants done once all panels are made.
using Action = std::function<void(Session&)>;

/// What panels remember between frames.
struct PanelState {
  bool shows_help = false;
  bool shows_palette = false;
  bool shows_files = false;
  bool asks_to_quit = false;  ///< there are unsaved changes
  bool saves_and_quits = false;
  bool quits = false;    ///< set once the program may end
  std::string path{};    ///< typed
  std::string folder{};  ///< shown; "": where the program runs
  std::array<char, 128> search{};
  std::vector<std::string> recent;  ///< files, the last one first
  std::string opened{};             ///< by the panel just now; "": nothing
  double frame_seconds = 0;
  std::optional<OperationForm> form{};  ///< being filled in
  std::string form_error{};
  bool previews_form = false;     ///< the form was just opened
  const Menu* menu = nullptr;     ///< that is open
  std::vector<std::string> left;  ///< sessions that did not end well, as they are listed
  std::optional<std::size_t> recovered, thrown_away;  ///< which of them the user chose
};

/// All of them.
[[nodiscard]] std::vector<Action> draw_panels(const Session& session, PanelState& state);

// One by one; each adds its actions.
void draw_tool_panel(const Session& session, PanelState& state, std::vector<Action>& actions);
/// Returns where it ends, pixels from above.
float draw_object_panel(const Session& session, std::vector<Action>& actions);
void draw_message_panel(const Session& session, std::vector<Action>& actions);
void draw_status_line(const Session& session, const PanelState& state);
/// Sessions to go on with, as long as there are any.
void draw_recovery_panel(PanelState& state);
/// At the mouse.
void draw_menu(PanelState& state, std::vector<Action>& actions);
void draw_help(const Session& session, PanelState& state);
void draw_palette(const Session& session, PanelState& state, std::vector<Action>& actions);
void draw_file_panel(const Session& session, PanelState& state, std::vector<Action>& actions);
/// Opens the form of an operation of the table, in place of one that is open.
void open_form(const Operation& operation, const Session& session, PanelState& state);
void draw_form_panel(const Session& session, PanelState& state, std::vector<Action>& actions);
/// What is shown of the lattice, and how it is cut. top: pixels from above.
void draw_show_panel(const Session& session, float top, std::vector<Action>& actions);
void draw_quit_question(PanelState& state, std::vector<Action>& actions);
/// While a task runs: how far it is; true if it is to stop.
[[nodiscard]] bool draw_progress(std::string_view task, double fraction);

}  // namespace espalier::viewer
