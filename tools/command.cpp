#include "tools/command.h"

#include "deform/scene/operations.h"

namespace espalier::tools {

const std::vector<Command>& commands() {
  static const std::vector<Command> kCommands = [] {
    std::vector<Command> all;
    for (const Operation& operation : operations()) {
      // Commands open and save their files themselves.
      if (operation.name != "open" && operation.name != "save") {
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
