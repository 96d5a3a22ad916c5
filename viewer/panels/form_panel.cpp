/// The form of an operation.

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

#include "lattice/core/error.h"
#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {
namespace {

bool choose(const char* label, FormField& field) {
  bool is_changed = false;
  if (ImGui::BeginCombo(label, field.text.c_str())) {
    if (!field.parameter->is_required && ImGui::Selectable("", field.text.empty())) {
      field.text.clear();
      is_changed = true;
    }
    for (const std::string& choice : field.choices) {
      if (ImGui::Selectable(choice.c_str(), choice == field.text)) {
        field.text = choice;
        is_changed = true;
      }
    }
    ImGui::EndCombo();
  }
  return is_changed;
}

/// A button that puts the cursor's place into a field.
bool take_cursor(const std::optional<glm::dvec3>& cursor, FormField& field) {
  if (!cursor || !field.is_place()) {
    return false;
  }
  ImGui::SameLine();
  ImGui::PushID(&field);
  const bool is_pressed = ImGui::SmallButton("cursor");
  ImGui::PopID();
  if (is_pressed) {
    field.put(*cursor);
  }
  return is_pressed;
}

bool edit(FormField& field) {
  const Parameter& parameter = *field.parameter;
  const std::string label = parameter.name + (parameter.is_required ? " *" : "");
  bool is_changed = false;
  if (parameter.type == ParameterType::Flag) {
    bool is_on = field.text == "true";
    is_changed = ImGui::Checkbox(label.c_str(), &is_on);
    field.text = is_on ? "true" : "false";
  } else if (parameter.is_list) {
    is_changed = ImGui::InputTextMultiline(label.c_str(), &field.text, ImVec2(0, 48));
  } else if (!field.choices.empty()) {
    is_changed = choose(label.c_str(), field);
  } else {
    is_changed = ImGui::InputTextWithHint(label.c_str(), parameter.help.c_str(), &field.text);
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s%s", parameter.help.c_str(), parameter.is_list ? "; one a line" : "");
  }
  return is_changed;
}

/// The preview follows what is typed, as far as it can be read.
void preview(PanelState& state, std::vector<Action>& actions) {
  state.form_error.clear();
  try {
    actions.emplace_back([call = state.form->call()](Session& session) { session.preview(call); });
  } catch (const Error& error) {
    state.form_error = error.what();
  }
}

void close(PanelState& state, std::vector<Action>& actions) {
  state.form.reset();
  actions.emplace_back([](Session& session) { session.end_preview(); });
}

}  // namespace

void open_form(const Operation& operation, const Session& session, PanelState& state) {
  state.form = form_for(operation, session.form_context());
  state.form_error.clear();
  state.previews_form = true;
}

void draw_form_panel(const Session& session, PanelState& state, std::vector<Action>& actions) {
  if (!state.form) {
    return;
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x - kMargin, size.y - 46), ImGuiCond_Always, ImVec2(1, 1));
  ImGui::SetNextWindowSizeConstraints(ImVec2(400, 0), ImVec2(400, size.y - 80));
  bool is_open = true;
  ImGui::Begin(state.form->operation->name.c_str(), &is_open,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushTextWrapPos(380);
  ImGui::TextColored(kFaint, "%s", state.form->operation->summary.c_str());
  ImGui::PushItemWidth(240);
  bool is_changed = state.previews_form;
  state.previews_form = false;
  for (FormField& field : state.form->fields) {
    is_changed |= edit(field);
    is_changed |= take_cursor(session.cursor(), field);
  }
  ImGui::PopItemWidth();
  if (is_changed) {
    preview(state, actions);
  }
  const std::string& error =
      state.form_error.empty() ? session.shown_preview().error : state.form_error;
  if (!error.empty()) {
    ImGui::TextColored(ImVec4(0.95F, 0.55F, 0.35F, 1), "%s", error.c_str());
  }
  const bool may_preview = state.form_error.empty() && session.shown_preview().was_stopped;
  if (may_preview) {
    ImGui::TextColored(kFaint, "This takes a moment: no preview yet.");
  }
  ImGui::PopTextWrapPos();
  if (may_preview && ImGui::Button("Preview")) {
    actions.emplace_back(
        [call = state.form->call()](Session& target) { target.preview(call, true); });
  }
  if (may_preview) {
    ImGui::SameLine();
  }
  if (ImGui::Button("Do it") && state.form_error.empty()) {
    actions.emplace_back([call = state.form->call()](Session& target) { target.run_form(call); });
    is_open = false;
  }
  ImGui::SameLine();
  is_open &= !ImGui::Button("Cancel");
  ImGui::End();
  if (!is_open) {
    close(state, actions);
  }
}

}  // namespace espalier::viewer
