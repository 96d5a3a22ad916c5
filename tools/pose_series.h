#pragma once

/// Many poses in one run: the files that a pattern names, and where their results go.

#include <string>
#include <vector>

namespace espalier::tools {

/// One pose and its result.
struct PoseJob {
  std::string pose;
  std::string output;
};

/// Whether `pose` or `output` asks for a series: a pattern with *, ? or [ that is no file's own
/// name, or {} in the output.
[[nodiscard]] bool is_pose_series(const std::string& pose, const std::string& output);

/// The files that `pose` matches, sorted by name, each with `output` where {} stands for the file's
/// name without folder and extension. Throws FileError if no file matches, and ParameterError if
/// two results would go to one file.
[[nodiscard]] std::vector<PoseJob> pose_jobs(const std::string& pose, const std::string& output);

}  // namespace espalier::tools
