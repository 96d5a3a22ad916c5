/// The panel of models and lattices.

#include <imgui.h>

#include <filesystem>
#include <string>

#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {
namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// What else the model's influence says is kept.
void draw_strength(const Session& session, const std::string& model, std::vector<Action>& actions) {
  const auto found = session.scene().influences.find(model);
  const ModelInfluence now =
      found == session.scene().influences.end() ? ModelInfluence() : *found->second;
  auto strength = static_cast<float>(now.strength);
  ImGui::PushID(model.c_str());
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderFloat("##strength", &strength, 0, 1, "strength %.2f");
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    Arguments arguments({{"model", model}, {"strength", static_cast<double>(strength)}});
    if (!now.only.empty()) {
      arguments.set("only", now.only);
    }
    if (!now.weights.empty()) {
      arguments.set("weights", now.weights);
    }
    actions.emplace_back([arguments](Session& target) {
      target.apply({"set influence", arguments});
    });
  }
  ImGui::PopID();
}

}  // namespace

void draw_object_panel(const Session& session, std::vector<Action>& actions) {
  const Scene& scene = session.scene();
  if (scene.models.empty() && scene.lattices.empty()) {
    return;
  }
  const float right = ImGui::GetIO().DisplaySize.x - kMargin;
  ImGui::SetNextWindowPos(ImVec2(right, kMargin), ImGuiCond_Always, ImVec2(1, 0));
  ImGui::SetNextWindowSize(ImVec2(kWidth + 40, 0));
  ImGui::Begin("objects", nullptr, kFixed);
  for (const auto& [name, model] : scene.models) {
    ImGui::TextUnformatted(file_name(name).c_str());
    ImGui::TextColored(kFaint, "  %zu points, %zu faces", model.points().size(),
                       model.faces().n_rows());
    if (session.mode() == Mode::Pose) {
      draw_strength(session, name, actions);
    }
    for (const auto& [names, bound] : scene.bound) {
      if (names.first == name) {
        const StatusCounts counts = bound.binding->counts();
        ImGui::TextColored(kFaint, "  %zu inside, %zu outside", counts.inside + counts.border,
                           counts.outside + counts.unconverged);
      }
    }
  }
  for (const auto& [name, lattice] : scene.lattices) {
    if (ImGui::Selectable(file_name(name).c_str(), name == session.lattice())) {
      actions.emplace_back([chosen = name](Session& target) { target.choose_lattice(chosen); });
    }
    ImGui::TextColored(kFaint, "  %s, %zu control points", std::string(lattice.type()).c_str(),
                       lattice.rest_points().size());
  }
  ImGui::End();
}

}  // namespace espalier::viewer
