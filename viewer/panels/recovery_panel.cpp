/// The panel of sessions that did not end well.

#include <imgui.h>

#include <string>

#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {

void draw_recovery_panel(PanelState& state) {
  if (state.left.empty()) {
    return;
  }
  bool is_open = begin_overlay("Sessions that did not end well", 640, 240);
  ImGui::BeginChild("left", ImVec2(0, -34));
  for (std::size_t i = 0; i < state.left.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Button("Go on")) {
      state.recovered = i;
    }
    ImGui::SameLine();
    if (ImGui::Button("Throw away")) {
      state.thrown_away = i;
    }
    ImGui::SameLine();
    ImGui::TextUnformatted(state.left[i].c_str());
    ImGui::PopID();
  }
  ImGui::EndChild();
  is_open &= !ImGui::Button("Later");
  ImGui::End();
  if (!is_open) {
    state.left.clear();
  }
}

}  // namespace espalier::viewer
