#pragma once

/// What hands do, as values: from a window, a script or a test.

#include <glm/vec2.hpp>
#include <string>
#include <variant>

namespace espalier::viewer {

/// A key that went down, with the modifiers held, in this order: "g", "ctrl+shift+z", "shift+x",
/// "kp1" (of the number pad), "f1", "enter", "escape", "backspace", "home", "tab", "-", ".".
struct KeyPress {
  std::string chord;
};

struct Modifiers {
  bool ctrl = false;
  bool shift = false;
  bool alt = false;
};

enum class MouseButton { Left, Middle, Right };

/// Places are pixels from the top left corner of the window.
struct MousePress {
  MouseButton button = MouseButton::Left;
  glm::dvec2 at{0.0};
  Modifiers held{};
};
struct MouseRelease {
  MouseButton button = MouseButton::Left;
  glm::dvec2 at{0.0};
};
struct MouseMove {
  glm::dvec2 at{0.0};
};
/// steps: of the wheel; above 0 away from the hand.
struct Scroll {
  double steps = 0;
};
/// What typing makes, UTF-8.
struct TextInput {
  std::string text;
};
struct Resize {
  int width = 1;
  int height = 1;
};

using Event =
    std::variant<KeyPress, MousePress, MouseRelease, MouseMove, Scroll, TextInput, Resize>;

}  // namespace espalier::viewer
