#pragma once

/// What panels that stay in their place have in common.

#include <imgui.h>

namespace espalier::viewer {

inline constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
    ImGuiWindowFlags_NoBringToFrontOnFocus;
inline constexpr float kMargin = 10;
inline constexpr float kWidth = 230;
inline const ImVec4 kFaint(0.62F, 0.65F, 0.70F, 1);

/// A window in the middle, begun; false if it was closed.
bool begin_overlay(const char* title, float width, float height);

}  // namespace espalier::viewer
