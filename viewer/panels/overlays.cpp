/// The panels that are called for.

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "deform/scene/operations.h"
#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool begin_overlay(const char* title, float width, float height) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x / 2, size.y / 2), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowSize(ImVec2(std::min(width, size.x - 20), std::min(height, size.y - 20)));
  bool is_open = true;
  ImGui::Begin(title, &is_open,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
  return is_open;
}

void draw_help(const Session& session, PanelState& state) {
  if (!state.shows_help) {
    return;
  }
  state.shows_help = begin_overlay("Keys and mouse", 1040, 640);
  ImGui::TextWrapped(
      "Middle button: turn the view; with Shift shift it; wheel: zoom. Alt and the left button "
      "turn "
      "it, too. Click selects, Shift adds, a dragged box selects, Alt and a click takes a loop. "
      "While "
      "points move: x, y, z lock an axis, Shift with them a plane, digits give a number.");
  ImGui::TextUnformatted(
      "F1 help   F2 files   F3 find a command   . pivots   Shift+S snap   Shift and the right "
      "button: place the cursor");
  ImGui::Separator();
  std::vector<Command> all = commands(session.handling().preset);
  std::erase_if(all, [](const Command& command) { return command.keys.empty(); });
  const std::size_t n_rows = (all.size() + 1) / 2;
  ImGui::Columns(4, "keys", false);
  ImGui::SetColumnWidth(0, 120);
  ImGui::SetColumnWidth(1, 380);
  ImGui::SetColumnWidth(2, 170);
  for (std::size_t i = 0; i < 2 * n_rows; ++i) {
    const std::size_t which = i / 2 + (i % 2) * n_rows;
    ImGui::TextUnformatted(which < all.size() ? all[which].keys.c_str() : "");
    ImGui::NextColumn();
    ImGui::TextUnformatted(which < all.size() ? all[which].name.c_str() : "");
    ImGui::NextColumn();
  }
  ImGui::Columns(1);
  ImGui::End();
}

/// Commands run at once; an operation opens its form; Enter takes the first that is listed; and a
/// whole line, as journals have it, is done.
void draw_palette(const Session& session, PanelState& state, std::vector<Action>& actions) {
  if (!state.shows_palette) {
    return;
  }
  state.shows_palette = begin_overlay("Find a command", 640, 420);
  if (ImGui::IsWindowAppearing()) {
    ImGui::SetKeyboardFocusHere();
  }
  const bool is_entered = ImGui::InputText("##search", state.search.data(), state.search.size(),
                                           ImGuiInputTextFlags_EnterReturnsTrue);
  const std::string text = state.search.data();
  bool takes_next = is_entered;
  if (is_entered && text.find('=') != std::string::npos) {
    actions.emplace_back([text](Session& target) { target.run_line(text); });
    state.shows_palette = takes_next = false;
  }
  ImGui::BeginChild("found");
  const std::string wanted = lower(text.substr(0, text.find('=')));
  const auto is_chosen = [&](const std::string& label) {
    return lower(label).find(wanted) != std::string::npos &&
           (ImGui::Selectable(label.c_str()) || std::exchange(takes_next, false));
  };
  for (const Command& command : commands(session.handling().preset)) {
    const std::string label =
        command.name + (command.keys.empty() ? "" : "   (" + command.keys + ")");
    if (is_chosen(label)) {
      actions.emplace_back(command.run);
      state.shows_palette = false;
    }
  }
  for (const Operation& operation : operations()) {
    const std::string label = operation.name + " ...   " + operation.summary;
    if (is_chosen(label)) {
      open_form(operation, session, state);
      state.shows_palette = false;
    }
  }
  ImGui::EndChild();
  ImGui::End();
}

void draw_quit_question(PanelState& state, std::vector<Action>& actions) {
  if (!state.asks_to_quit) {
    return;
  }
  state.asks_to_quit = begin_overlay("There are unsaved changes", 380, 90);
  if (ImGui::Button("Save and quit")) {
    actions.emplace_back([](Session& session) { session.save(); });
    state.saves_and_quits = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("Quit")) {
    state.quits = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("Go on working")) {
    state.asks_to_quit = false;
  }
  ImGui::End();
}

std::vector<Action> draw_panels(const Session& session, PanelState& state) {
  std::vector<Action> actions;
  draw_tool_panel(session, state, actions);
  const float end = draw_object_panel(session, actions);
  if (!state.form) {
    draw_show_panel(session, end, actions);
  }
  draw_message_panel(session, actions);
  draw_status_line(session, state);
  draw_help(session, state);
  draw_palette(session, state, actions);
  draw_file_panel(session, state, actions);
  draw_form_panel(session, state, actions);
  draw_menu(state, actions);
  draw_recovery_panel(state);
  draw_quit_question(state, actions);
  return actions;
}

}  // namespace espalier::viewer
