#pragma once

/// What `espalier WORD …` can be: an operation of the scene with files round it, or a question.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "deform/scene/operation.h"
#include "lattice/core/progress.h"

namespace espalier::tools {

/// What the options of every command say.
struct Session {
  bool is_quiet = false;  ///< no report on standard output
  bool is_json = false;   ///< the report as JSON
  Progress progress;
};

/// Exit status of the program.
enum class ExitStatus { Done = 0, Failed = 1, WrongUsage = 2, Undecided = 3 };

struct Command {
  std::string name;
  std::string summary;
  std::vector<Parameter> parameters;
  std::function<ExitStatus(const Arguments&, const Session&)> run;
  bool has_json_report = true;  ///< whether --json is one of its options
};

/// All commands, in the order in which help lists them.
[[nodiscard]] const std::vector<Command>& commands();

// Its parts.
[[nodiscard]] Command operation_command(const Operation& operation);
[[nodiscard]] Command info_command();
[[nodiscard]] Command check_command();
[[nodiscard]] Command eval_command();
[[nodiscard]] Command weights_command();
[[nodiscard]] Command pull_command();
[[nodiscard]] Command render_command();

}  // namespace espalier::tools
