#pragma once

/// From words to a command with its arguments.

#include <span>
#include <string>
#include <vector>

#include "tools/command.h"

namespace espalier::tools {

/// Parses the words after the program's name and runs the command they name. Help and version go to
/// standard output. Wrong usage is told on standard error in one line and a hint; everything a
/// command throws passes through.
[[nodiscard]] ExitStatus run_command_line(const std::vector<std::string>& words);

}  // namespace espalier::tools
