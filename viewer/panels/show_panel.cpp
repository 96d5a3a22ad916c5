/// What is shown of the chosen lattice.

#include <imgui.h>

#include <array>
#include <string>

#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {
namespace {

void draw_cut(Show& show) {
  bool is_cut = show.cut.has_value();
  ImGui::Checkbox("Cut open", &is_cut);
  if (!is_cut) {
    show.cut.reset();
    return;
  }
  Cut cut = show.cut.value_or(Cut());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(48);
  ImGui::Combo("##axis", &cut.axis, "x\0y\0z\0");
  ImGui::SameLine();
  ImGui::Checkbox("other side", &cut.keeps_upper);
  auto place = static_cast<float>(cut.place);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderFloat("##place", &place, 0, 1, "at %.2f")) {
    cut.place = place;
  }
  show.cut = cut;
}

/// The levels of a hierarchy, each to be shown or not.
void draw_levels(std::int32_t n_levels, Show& show) {
  ImGui::TextColored(kFaint, "Levels");
  for (std::int32_t level = 0; level < n_levels; ++level) {
    bool is_shown = !show.hidden_levels.contains(level);
    if (level % 4 != 0 || level == 0) {
      ImGui::SameLine();
    }
    ImGui::Checkbox(std::to_string(level).c_str(), &is_shown);
    if (is_shown) {
      show.hidden_levels.erase(level);
    } else {
      show.hidden_levels.insert(level);
    }
  }
}

void draw_sharpness(const Session& session, std::vector<Action>& actions) {
  const bool has_sharpness =
      session.mode() == Mode::Lattice && !session.selection().empty() &&
      (session.element_kind() == ElementKind::Edge ||
       session.element_kind() == ElementKind::Vertex) &&
      lattice_in(session.scene(), session.lattice()).as<SubdivisionLattice>() != nullptr;
  if (!has_sharpness) {
    return;
  }
  ImGui::Separator();
  static constexpr float kInfinite = 10;
  auto sharpness = static_cast<float>(session.sharpness());
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderFloat("##sharpness", &sharpness, 0, kInfinite,
                     sharpness >= kInfinite ? "sharpness: infinite" : "sharpness %.1f");
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    actions.emplace_back([sharpness](Session& target) { target.set_sharpness(sharpness); });
  }
}

}  // namespace

void draw_show_panel(const Session& session, float top, std::vector<Action>& actions) {
  if (session.lattice().empty()) {
    return;
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x - kMargin, top + kMargin), ImGuiCond_Always, ImVec2(1, 0));
  ImGui::SetNextWindowSize(ImVec2(kWidth + 40, 0));
  ImGui::Begin("show", nullptr, kFixed);
  Show show = session.show();
  ImGui::Checkbox("Control points", &show.has_cage);
  ImGui::Checkbox("Boundary of the volume", &show.has_surface);
  ImGui::Checkbox("Cells, shrunk", &show.has_shrunk_cells);
  ImGui::Checkbox("Influence of the selection", &show.has_influence);
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderInt("##refined", &show.refined_levels, 0, 3,
                   show.refined_levels == 0 ? "refined: off" : "refined %d times");
  draw_cut(show);
  if (session.elements().n_levels > 1) {
    draw_levels(session.elements().n_levels, show);
  }
  if (!(show == session.show())) {
    actions.emplace_back([show](Session& target) { target.set_show(show); });
  }
  draw_sharpness(session, actions);
  ImGui::End();
}

}  // namespace espalier::viewer
