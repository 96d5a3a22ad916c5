#pragma once

/// The viewer in a window.

#include <string>
#include <vector>

namespace espalier::viewer {

struct WindowOptions {
  std::vector<std::string> files;  ///< models and lattices to open
  std::string script;              ///< done first, see parse_script_line()
  int width = 1280;
  int height = 800;
  std::string autosave;          ///< where the journal is kept while the program runs; "": nowhere
  double autosave_interval = 2;  ///< seconds
  std::string recent;            ///< where the files opened are remembered; "": nowhere
  bool recovers = false;         ///< begins with what autosave holds
};

/// Runs until the user quits. Throws Error if the system has no display, or none with OpenGL 3.3,
/// and ParameterError for a script that cannot be read.
void run_window(const WindowOptions& options);

}  // namespace espalier::viewer
