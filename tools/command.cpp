#include "tools/command.h"

#include <algorithm>

#include "deform/scene/operations.h"

namespace espalier::tools {
namespace {

/// A command reads its files itself, runs one operation, and writes what that makes.
bool has_output(const Operation& operation) {
  return std::any_of(operation.parameters.begin(), operation.parameters.end(),
                     [](const Parameter& parameter) { return parameter.name == "output"; });
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> kCommands = [] {
    std::vector<Command> all;
    for (const Operation& operation : operations()) {
      if (has_output(operation)) {
        all.push_back(operation_command(operation));
      }
    }
    all.push_back(info_command());
    all.push_back(check_command());
    all.push_back(eval_command());
    all.push_back(pull_command());
    all.push_back(weights_command());
    all.push_back(render_command());
    return all;
  }();
  return kCommands;
}

}  // namespace espalier::tools
