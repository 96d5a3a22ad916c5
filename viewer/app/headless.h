#pragma once

/// The viewer without a window: scripts and pictures.

#include <functional>
#include <string>
#include <vector>

#include "viewer/render/picture.h"

namespace espalier::viewer {

struct HeadlessOptions {
  std::vector<std::string> files;      ///< models and lattices to open
  std::string script;                  ///< its text, see parse_script_line()
  std::string script_path = "script";  ///< named in errors
  int width = 1280;
  int height = 800;
  /// Gets what is taken at lines "picture NAME"; none: nobody wants it.
  std::function<void(const std::string& name, const Picture& picture)> on_picture = {};
};

/// Opens the files, does what the script says, one frame a step, and returns the last frame, panels
/// included. Throws ParameterError for a line of the script that cannot be read, and Error with the
/// messages if a step fails or the system cannot draw.
[[nodiscard]] Picture run_headless(const HeadlessOptions& options);

}  // namespace espalier::viewer
