#pragma once

/// Operations as text, one a line: what journals and scripts are made of.
///
///     open path=arm.json
///     move points lattice=arm.json points=0,1 to=0,0,1,0,1,1 shape=pose
///
/// The operation's name, then its arguments in the order of its parameters. Numbers are separated
/// by commas; a list's argument repeats; a text with blanks, quotes or '=' stands in double quotes,
/// with \" \\ and \n inside.

#include <string>
#include <string_view>

#include "deform/scene/operation.h"

namespace espalier {

/// An operation and its arguments, not yet checked.
struct OperationCall {
  std::string operation;
  Arguments arguments;
};

/// One line, without its end. Numbers read back to the same bits. Throws ParameterError for an
/// operation or an argument that does not exist.
[[nodiscard]] std::string text_of(const OperationCall& call);

/// The call that a line holds. Throws ParameterError naming what cannot be read.
[[nodiscard]] OperationCall parse_call(std::string_view line);

/// Runs it on a scene.
[[nodiscard]] Scene apply(const OperationCall& call, const Scene& scene,
                          const Progress& progress = {});

}  // namespace espalier
