#pragma once

/// Scripts: what a user would do, as text.
///
///     # lines of a journal, and these
///     key g            a key, as in event.h; several on a line one after the other
///     move 400 300     the mouse
///     press left 400 300 shift
///     release left 400 300
///     click left 400 300 shift
///     scroll -2
///     type some text
///     picture leg      what is to be seen now is taken under this name

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deform/scene/operation_text.h"
#include "viewer/interact/event.h"

namespace espalier::viewer {

struct PictureStep {
  std::string name;
};

using ScriptStep = std::variant<Event, OperationCall, PictureStep>;

/// The steps of a line; none of an empty line or a comment. Throws ParameterError saying what is
/// wrong with it.
[[nodiscard]] std::vector<ScriptStep> parse_script_line(std::string_view line);

}  // namespace espalier::viewer
