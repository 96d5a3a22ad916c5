/// The menu that a key opened.

#include <imgui.h>

#include <string>

#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {

void draw_menu(PanelState& state, std::vector<Action>& actions) {
  if (state.menu == nullptr) {
    return;
  }
  ImGui::SetNextWindowPos(ImGui::GetMousePos(), ImGuiCond_Appearing, ImVec2(0.5F, 0.2F));
  ImGui::Begin(state.menu->title.c_str(), nullptr,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  const Menu& menu = *state.menu;
  for (std::size_t i = 0; i < menu.entries.size(); ++i) {
    const std::string label = std::to_string(i + 1) + "   " + menu.entries[i].name;
    if (ImGui::Selectable(label.c_str(), false, 0, ImVec2(270, 0))) {
      actions.emplace_back(menu.entries[i].run);
      state.menu = nullptr;
    }
  }
  const bool is_left = ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
                       !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows);
  if (is_left) {
    state.menu = nullptr;
  }
  ImGui::End();
}

}  // namespace espalier::viewer
