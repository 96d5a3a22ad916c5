/// The panel of modes and tools.

#include <imgui.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "deform/scene/operations.h"
#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {
namespace {

/// A button that shows whether it is on.
bool choice(const char* label, bool is_on, float width) {
  if (is_on) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.72F, 0.47F, 0.10F, 1));
  }
  const bool is_pressed = ImGui::Button(label, ImVec2(width, 0));
  if (is_on) {
    ImGui::PopStyleColor();
  }
  return is_pressed;
}

/// A button for a command of the table, with its key beside it.
void command_button(const char* label, const char* chord, float width, std::vector<Action>& actions,
                    Preset preset = Preset::Blender) {
  if (ImGui::Button(label, ImVec2(width, 0))) {
    for (const Command& command : commands(preset)) {
      if (command.keys == chord) {
        actions.emplace_back(command.run);
      }
    }
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("key: %s", chord);
  }
}

/// A list of operations; the one that is chosen opens its form.
void operation_menu(const char* title, const std::function<bool(const std::string&)>& has,
                    const Session& session, PanelState& state) {
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo((std::string("##") + title).c_str(), title, ImGuiComboFlags_HeightLarge)) {
    return;
  }
  for (const Operation& operation : operations()) {
    if (has(operation.name)) {
      if (ImGui::Selectable(operation.name.c_str())) {
        open_form(operation, session, state);
      }
      if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", operation.summary.c_str());
      }
    }
  }
  ImGui::EndCombo();
}

bool makes_lattices(const std::string& operation) {
  return operation.starts_with("new ") || operation == "convert";
}

bool edits_lattices(const std::string& operation) {
  constexpr std::array<const char*, 11> kEdits = {"refine",    "extrude", "attach", "split",
                                                  "delete",    "merge",   "weld",   "mirror",
                                                  "transform", "relax",   "crease"};
  return std::find(kEdits.begin(), kEdits.end(), operation) != kEdits.end();
}

bool poses_lattices(const std::string& operation) {
  return operation.starts_with("pose ") || operation == "pull" || operation == "set pose";
}

/// What to do next.
const char* advice(const Session& session) {
  const bool is_bound =
      std::any_of(session.scene().bound.begin(), session.scene().bound.end(),
                  [&](const auto& entry) { return entry.first.second == session.lattice(); });
  if (session.scene().models.empty()) {
    return "Open a model: press F2, or drop its file here.";
  }
  if (session.lattice().empty()) {
    return "Make a lattice round it: press n for a box, or choose from the list below.";
  }
  switch (session.mode()) {
    case Mode::Lattice:
      return is_bound ? "Bound: go on to Pose. Changing the lattice at rest unties it."
                      : "Shape the lattice round the part that is to bend: press 3, click a face, "
                        "e grows a cell. Then b binds the model.";
    case Mode::Bind:
      return is_bound ? "Bound. Green points are inside and will follow: go on to Pose."
                      : "Press Bind: it finds the points that the lattice holds.";
    default:
      return is_bound ? "Select control points and move them: the models follow."
                      : "Nothing is bound to this lattice yet: press b.";
  }
}

void draw_kinds(const Session& session, float width, std::vector<Action>& actions) {
  constexpr std::array<const char*, 4> kKinds = {"Vertex (1)", "Edge (2)", "Face (3)", "Cell (4)"};
  for (int i = 0; i < 4; ++i) {
    const auto kind = static_cast<ElementKind>(i);
    if (choice(kKinds.at(static_cast<std::size_t>(i)), session.element_kind() == kind, width)) {
      actions.emplace_back([kind](Session& target) { target.set_element_kind(kind); });
    }
    if (i % 2 == 0) {
      ImGui::SameLine();
    }
  }
}

void draw_handling(const Session& session, std::vector<Action>& actions) {
  Handling handling = session.handling();
  ImGui::Checkbox("Soft selection  (o)", &handling.is_soft);
  bool is_visible_only = !handling.is_through;
  ImGui::Checkbox("Only what is visible", &is_visible_only);
  handling.is_through = !is_visible_only;
  if (session.mode() == Mode::Pose) {
    ImGui::Checkbox("Stop before folds", &handling.stops_at_folds);
  }
  ImGui::Checkbox("Handles", &handling.has_gizmo);
  ImGui::SameLine();
  ImGui::Checkbox("Wireframe", &handling.has_wireframe);
  bool is_matcap = handling.shading == Shading::Matcap;
  ImGui::Checkbox("Shiny ball (matcap)", &is_matcap);
  handling.shading = is_matcap ? Shading::Matcap : Shading::Phong;
  ImGui::TextColored(kFaint, "Mirror");
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ImGui::SameLine();
    ImGui::Checkbox(kAxes.at(axis), &handling.mirrors.at(axis));
  }
  int pivot = static_cast<int>(handling.pivot);
  ImGui::SetNextItemWidth(-1);
  ImGui::Combo("##pivot", &pivot,
               "about the median\0about the last selected\0about the origin\0about the box's "
               "middle\0each part about its own\0about the cursor\0");
  handling.pivot = static_cast<Pivot>(pivot);
  if (handling != session.handling()) {
    actions.emplace_back([handling](Session& target) { target.set_handling(handling); });
  }
}

}  // namespace

void draw_tool_panel(const Session& session, PanelState& state, std::vector<Action>& actions) {
  ImGui::SetNextWindowPos(ImVec2(kMargin, kMargin));
  ImGui::SetNextWindowSize(ImVec2(kWidth, 0));
  ImGui::Begin("tools", nullptr, kFixed);
  const float full = ImGui::GetContentRegionAvail().x;
  const float half = (full - ImGui::GetStyle().ItemSpacing.x) / 2;
  constexpr std::array<const char*, 3> kModes = {"Lattice  (ctrl+1)", "Bind  (ctrl+2)",
                                                 "Pose  (ctrl+3)"};
  for (int i = 0; i < 3; ++i) {
    const auto mode = static_cast<Mode>(i);
    if (choice(kModes.at(static_cast<std::size_t>(i)), session.mode() == mode, full)) {
      actions.emplace_back([mode](Session& target) { target.set_mode(mode); });
    }
  }
  ImGui::PushStyleColor(ImGuiCol_Text, kFaint);
  ImGui::TextWrapped("%s", advice(session));
  ImGui::PopStyleColor();
  ImGui::Separator();
  if (session.mode() == Mode::Bind) {
    command_button("Bind  (b)", "b", full, actions);
  } else {
    draw_kinds(session, half, actions);
    const Preset preset = session.handling().preset;
    const bool is_maya = preset == Preset::Maya;
    command_button(is_maya ? "Move  (w)" : "Move  (g)", is_maya ? "w" : "g", half, actions, preset);
    ImGui::SameLine();
    command_button(is_maya ? "Turn  (e)" : "Turn  (r)", is_maya ? "e" : "r", half, actions, preset);
    command_button(is_maya ? "Scale  (r)" : "Scale  (s)", is_maya ? "r" : "s", half, actions,
                   preset);
    ImGui::SameLine();
    if (session.mode() == Mode::Lattice) {
      command_button(is_maya ? "Extrude" : "Extrude (e)", is_maya ? "ctrl+e" : "e", half, actions,
                     preset);
      command_button("New box  (n)", "n", full, actions);
      operation_menu("another lattice ...", makes_lattices, session, state);
      operation_menu("change the lattice ...", edits_lattices, session, state);
    } else {
      command_button("At rest", "alt+g", half, actions);
      operation_menu("pose a limb ...", poses_lattices, session, state);
    }
    draw_handling(session, actions);
  }
  ImGui::Separator();
  command_button("Undo", "ctrl+z", half, actions);
  ImGui::SameLine();
  command_button("Save", "ctrl+s", half, actions);
  ImGui::End();
}

}  // namespace espalier::viewer
