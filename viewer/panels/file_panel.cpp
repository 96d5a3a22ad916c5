/// The panel that opens and saves files.

#include <imgui.h>
#include <imgui_stdlib.h>

#include <filesystem>
#include <string>

#include "viewer/interact/file_browser.h"
#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {
namespace {

void open(const std::string& file, PanelState& state, std::vector<Action>& actions) {
  actions.emplace_back([file](Session& session) { session.open(file); });
  state.shows_files = false;
  state.opened = file;
}

/// What is typed, in the folder that is shown unless it holds a slash.
std::string path_of(const PanelState& state) {
  const bool is_here = !state.path.empty() && state.path.find('/') == std::string::npos;
  return is_here ? (std::filesystem::path(state.folder) / state.path).string() : state.path;
}

/// A path that is a folder is gone to; another one is opened.
void go_to(const std::string& path, PanelState& state, std::vector<Action>& actions) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) {
    state.folder = std::filesystem::absolute(path, failure).string();
    state.path.clear();
  } else {
    open(path, state, actions);
  }
}

/// What is typed narrows the list; once it holds a slash it is a path of its own.
void draw_folder(PanelState& state, std::vector<Action>& actions) {
  const bool is_path = state.path.find('/') != std::string::npos;
  ImGui::TextColored(kFaint, "%s", state.folder.empty() ? "." : state.folder.c_str());
  ImGui::BeginChild("folder", ImVec2(-1, 300), true);
  if (ImGui::Selectable("../")) {
    state.folder = folder_above(state.folder);
  }
  for (const FileEntry& entry : entries_of(state.folder, is_path ? "" : state.path)) {
    if (ImGui::Selectable((entry.name + (entry.is_folder ? "/" : "")).c_str())) {
      go_to((std::filesystem::path(state.folder) / entry.name).string(), state, actions);
    }
  }
  ImGui::EndChild();
}

/// Messages are told behind this panel.
void save(const std::string& name, PanelState& state, std::vector<Action>& actions) {
  actions.emplace_back(
      [name, path = path_of(state)](Session& target) { target.save_as(name, path); });
  state.shows_files = false;
}

void draw_saving(const Session& session, PanelState& state, std::vector<Action>& actions) {
  if (ImGui::Button("Save the lattice there") && !session.lattice().empty()) {
    save(session.lattice(), state, actions);
  }
  for (const auto& [name, model] : session.scene().models) {
    const std::string label =
        "Save bent there: " + std::filesystem::path(name).filename().string() + "##" + name;
    if (ImGui::Button(label.c_str())) {
      save(name, state, actions);
    }
  }
}

}  // namespace

void draw_file_panel(const Session& session, PanelState& state, std::vector<Action>& actions) {
  if (!state.shows_files) {
    return;
  }
  state.shows_files = begin_overlay("Files", 640, 560);
  if (ImGui::IsWindowAppearing()) {
    ImGui::SetKeyboardFocusHere();
  }
  const bool is_entered =
      ImGui::InputText("path", &state.path, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if ((ImGui::Button("Open") || is_entered) && !state.path.empty()) {
    go_to(path_of(state), state, actions);
  }
  draw_folder(state, actions);
  draw_saving(session, state, actions);
  ImGui::Separator();
  ImGui::TextColored(kFaint, "Opened before");
  for (const std::string& file : state.recent) {
    if (ImGui::Selectable(file.c_str())) {
      open(file, state, actions);
      break;
    }
  }
  ImGui::End();
}

}  // namespace espalier::viewer
