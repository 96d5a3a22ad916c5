#pragma once

/// What keys do: one table for them, the help and the command palette.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/interact/session.h"

namespace espalier::viewer {

/// A thing a key, the help and the command palette know.
struct Command {
  std::string name;
  std::string keys;  ///< chords, separated by blanks; empty: none
  std::function<void(Session&)> run;
};

/// All commands of a session, in the order in which help lists them.
[[nodiscard]] const std::vector<Command>& commands(Preset preset = Preset::Blender);

/// A short list that a key opens at the mouse.
struct Menu {
  std::string title;
  std::string key;  ///< that opens it
  std::vector<Command> entries;
};

/// Their entries are among the commands, too.
[[nodiscard]] const std::vector<Menu>& menus();
/// The menu that a key opens; null if it opens none.
[[nodiscard]] const Menu* menu_on(std::string_view chord);

}  // namespace espalier::viewer
