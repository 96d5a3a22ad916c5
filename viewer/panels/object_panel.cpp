/// The panel of models and lattices.

#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>

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

/// How a model that leaves a lattice joins the rest of itself.
void draw_lock(const std::pair<std::string, std::string>& names, const Lock& lock,
               std::vector<Action>& actions) {
  constexpr std::array<const char*, 4> kOptions = {"none", "C0", "C1", "C2"};
  constexpr std::array<const char*, 4> kLabels = {
      "tears where it leaves it", "joins there in position (C0)", "joins there in slope (C1)",
      "joins there in curvature (C2)"};
  ImGui::PushID((names.first + "\n" + names.second).c_str());
  ImGui::SetNextItemWidth(-1);
  const auto now = std::find(kOptions.begin(), kOptions.end(), lock.option);
  const auto shown = static_cast<std::size_t>(now - kOptions.begin());
  if (ImGui::BeginCombo("##lock", now == kOptions.end() ? lock.option.c_str() : kLabels[shown])) {
    for (std::size_t i = 0; i < kOptions.size(); ++i) {
      if (ImGui::Selectable(kLabels.at(i), i == shown)) {
        const Arguments arguments({{"model", names.first},
                                   {"lattice", names.second},
                                   {"lock", std::string(kOptions.at(i))}});
        actions.emplace_back([arguments](Session& target) {
          target.apply({"set lock", arguments});
        });
      }
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
}

}  // namespace

float draw_object_panel(const Session& session, std::vector<Action>& actions) {
  const Scene& scene = session.scene();
  if (scene.models.empty() && scene.lattices.empty()) {
    return 0;
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x - kMargin, kMargin), ImGuiCond_Always, ImVec2(1, 0));
  ImGui::SetNextWindowSizeConstraints(ImVec2(kWidth + 40, 0), ImVec2(kWidth + 40, size.y * 0.45F));
  ImGui::Begin("objects", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
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
        const std::string which =
            scene.lattices.size() > 1 ? ": " + file_name(names.second) : std::string();
        ImGui::TextColored(kFaint, "  %zu inside, %zu outside%s", counts.inside + counts.border,
                           counts.outside + counts.unconverged, which.c_str());
        if (session.mode() == Mode::Pose) {
          draw_lock(names, bound.lock, actions);
        }
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
  const float end = ImGui::GetWindowPos().y + ImGui::GetWindowSize().y;
  ImGui::End();
  return end;
}

}  // namespace espalier::viewer
