#include "viewer/app/gui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace espalier::viewer {
namespace {

/// Keys that ImGui's text fields need, at places of our own.
constexpr std::array<std::pair<std::string_view, int>, 14> kKeys{{{"tab", ImGuiKey_Tab},
                                                                  {"left", ImGuiKey_LeftArrow},
                                                                  {"right", ImGuiKey_RightArrow},
                                                                  {"up", ImGuiKey_UpArrow},
                                                                  {"down", ImGuiKey_DownArrow},
                                                                  {"home", ImGuiKey_Home},
                                                                  {"end", ImGuiKey_End},
                                                                  {"delete", ImGuiKey_Delete},
                                                                  {"backspace", ImGuiKey_Backspace},
                                                                  {"enter", ImGuiKey_Enter},
                                                                  {"escape", ImGuiKey_Escape},
                                                                  {"a", ImGuiKey_A},
                                                                  {"c", ImGuiKey_C},
                                                                  {"v", ImGuiKey_V}}};

int button_index(MouseButton button) {
  return button == MouseButton::Left ? 0 : button == MouseButton::Right ? 1 : 2;
}

void set_mouse(const glm::dvec2& at) {
  ImGui::GetIO().MousePos = ImVec2(static_cast<float>(at.x), static_cast<float>(at.y));
}

void press_key(std::string_view chord) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = chord.starts_with("ctrl+");
  const std::size_t plus = chord.rfind('+');
  const std::string_view key = chord.substr(plus == chord.npos ? 0 : plus + 1);
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    io.KeysDown[i] = io.KeysDown[i] || kKeys.at(i).first == key;
  }
}

/// Dark and unobtrusive: the model is what matters.
void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 6;
  style.FrameRounding = 4;
  style.WindowBorderSize = 0;
  style.WindowPadding = ImVec2(12, 10);
  style.ItemSpacing = ImVec2(8, 6);
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.10F, 0.11F, 0.12F, 0.92F);
  style.Colors[ImGuiCol_Button] = ImVec4(0.22F, 0.24F, 0.27F, 1);
  style.Colors[ImGuiCol_ButtonHovered] = ImVec4(0.30F, 0.33F, 0.38F, 1);
  style.Colors[ImGuiCol_ButtonActive] = ImVec4(0.85F, 0.58F, 0.15F, 1);
  style.Colors[ImGuiCol_FrameBg] = ImVec4(0.18F, 0.19F, 0.21F, 1);
  style.Colors[ImGuiCol_Header] = ImVec4(0.30F, 0.33F, 0.38F, 1);
  style.Colors[ImGuiCol_TitleBgActive] = ImVec4(0.14F, 0.15F, 0.17F, 1);
}

}  // namespace

Gui::Gui() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    io.KeyMap[kKeys.at(i).second] = static_cast<int>(i);
  }
  ImFontConfig font;
  font.SizePixels = 13;  // the size it was drawn for
  io.Fonts->AddFontDefault(&font);
  set_style();
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

bool Gui::handle(const Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  if (const auto* press = std::get_if<MousePress>(&event)) {
    set_mouse(press->at);
    io.MouseDown[button_index(press->button)] = true;
    return io.WantCaptureMouse;
  }
  if (const auto* release = std::get_if<MouseRelease>(&event)) {
    set_mouse(release->at);
    io.MouseDown[button_index(release->button)] = false;
    return false;
  }
  if (const auto* move = std::get_if<MouseMove>(&event)) {
    set_mouse(move->at);
    return false;
  }
  if (const auto* scroll = std::get_if<Scroll>(&event)) {
    io.MouseWheel += static_cast<float>(scroll->steps);
    return io.WantCaptureMouse;
  }
  return false;
}

void Gui::type(const Event& event) {
  if (const auto* text = std::get_if<TextInput>(&event)) {
    ImGui::GetIO().AddInputCharactersUTF8(text->text.c_str());
  } else if (const auto* key = std::get_if<KeyPress>(&event)) {
    press_key(key->chord);
  }
}

void Gui::begin(int width, int height, double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Gui::finish() {
  ImGui::Render();
  ImGuiIO& io = ImGui::GetIO();
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  io.KeyCtrl = false;
}

void Gui::draw() {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace espalier::viewer
