/// The panels that tell what is going on.

#include <algorithm>
#include <cstdio>
#include <string>

#include "viewer/panels/fixed_panel.h"
#include "viewer/panels/panels.h"

namespace espalier::viewer {

namespace {

/// How much there is to see, and how long a frame takes if that is known.
std::string counts_of(const Session& session, double frame_seconds) {
  std::size_t n_points = 0;
  std::size_t n_triangles = 0;
  for (const auto& [name, model] : session.bent_models().all()) {
    n_points += model.model().points().size();
    n_triangles += model.drawing().triangles().size() / 3;
  }
  std::string text = std::to_string(n_points) + " points   " + std::to_string(n_triangles) +
                     " triangles   " + std::to_string(session.elements().n_vertices) + " controls";
  if (frame_seconds > 0) {
    char time[32];
    std::snprintf(time, sizeof time, "   %6.1f ms", 1e3 * frame_seconds);
    text += time;
  }
  return text;
}

}  // namespace

void draw_message_panel(const Session& session, std::vector<Action>& actions) {
  if (session.messages().empty()) {
    return;
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x / 2, size.y - 44), ImGuiCond_Always, ImVec2(0.5F, 1));
  ImGui::SetNextWindowSize(ImVec2(std::min(720.0F, size.x - 2 * kMargin), 0));
  ImGui::Begin("messages", nullptr, kFixed);
  const std::size_t n = session.messages().size();
  for (std::size_t i = n > 4 ? n - 4 : 0; i < n; ++i) {
    ImGui::TextWrapped("%s", session.messages()[i].c_str());
  }
  if (ImGui::SmallButton("Copy")) {
    std::string all;
    for (const std::string& message : session.messages()) {
      all += message + "\n";
    }
    ImGui::SetClipboardText(all.c_str());
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("Close")) {
    actions.emplace_back([](Session& target) { target.forget_messages(); });
  }
  ImGui::End();
}

void draw_status_line(const Session& session, const PanelState& state) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0, size.y), ImGuiCond_Always, ImVec2(0, 1));
  ImGui::SetNextWindowSize(ImVec2(size.x, 34));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::Begin("status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
  ImGui::TextUnformatted(session.status().c_str());
  const std::string counts = counts_of(session, state.frame_seconds);
  ImGui::SameLine(size.x - ImGui::CalcTextSize(counts.c_str()).x - 12);
  ImGui::TextColored(kFaint, "%s", counts.c_str());
  ImGui::End();
  ImGui::PopStyleVar();
}

bool draw_progress(std::string_view task, double fraction) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x / 2, size.y / 2), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowSize(ImVec2(360, 0));
  ImGui::Begin("progress", nullptr, kFixed);
  constexpr float kButton = 90;
  ImGui::TextUnformatted(std::string(task).c_str());
  ImGui::ProgressBar(static_cast<float>(fraction),
                     ImVec2(-kButton - ImGui::GetStyle().ItemSpacing.x, 0));
  ImGui::SameLine();
  const bool is_stopped = ImGui::Button("Stop (Esc)", ImVec2(kButton, 0));
  ImGui::End();
  return is_stopped;
}

}  // namespace espalier::viewer
