#pragma once

/// What the parameters of `pull` say.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "deform/direct/pose_pull.h"
#include "deform/model/model.h"
#include "deform/scene/operation.h"

namespace espalier {

/// A point that is picked by itself.
struct RequestedPick {
  std::string name;                       ///< "point 3"
  std::optional<std::size_t> index = {};  ///< of the model; none for a point of its surface
};

/// Points [begin, end) of the task, which are told of together.
struct RequestedGroup {
  std::string name;  ///< "magnet head"
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The task's points are the picks, then those of the groups, numbered in this order.
struct PullRequest {
  PullTask task;
  std::vector<RequestedPick> picks;
  std::vector<RequestedGroup> groups;
};

/// The parameters of `pull` beyond the lattice and the model.
[[nodiscard]] std::vector<Parameter> pull_parameters();

/// Throws ParameterError naming a parameter that is not of its form or asks for a point, a group or
/// a control point that is not there.
[[nodiscard]] PullRequest pull_request(const Arguments& arguments, const Model& model,
                                       std::size_t n_controls);

}  // namespace espalier
