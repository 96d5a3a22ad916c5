#pragma once

/// Dear ImGui with its OpenGL back end, fed by events.

#include "viewer/interact/event.h"

namespace espalier::viewer {

/// One at a time, since ImGui is one a process. An OpenGL context must be current.
class Gui {
 public:
  Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  ~Gui();

  /// Tells the panels what the mouse did; true if it is for them alone.
  bool handle(const Event& event);
  /// Tells the text field that has the keyboard what was typed.
  void type(const Event& event);
  /// Panels are made between these two. seconds: since the last frame.
  void begin(int width, int height, double seconds);
  void finish();
  /// Draws those that were finished last into the current frame buffer.
  void draw();
};

}  // namespace espalier::viewer
