#include "tools/pose_series.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "lattice/core/error.h"

namespace espalier::tools {
namespace {

constexpr std::string_view kPlace = "{}";

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

bool is_pattern(const std::string& path) {
  return path.find_first_of("*?[") != std::string::npos && !is_file(path);
}

/// The matches of a shell pattern, sorted by their bytes.
std::vector<std::string> files_matching(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> paths;
  if (::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0) {
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  ::globfree(&found);
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string with_stem(std::string output, const std::string& pose) {
  const std::string stem = std::filesystem::path(pose).stem().string();
  for (std::size_t at = output.find(kPlace); at != std::string::npos;
       at = output.find(kPlace, at + stem.size())) {
    output.replace(at, kPlace.size(), stem);
  }
  return output;
}

}  // namespace

bool is_pose_series(const std::string& pose, const std::string& output) {
  return is_pattern(pose) || output.find(kPlace) != std::string::npos;
}

std::vector<PoseJob> pose_jobs(const std::string& pose, const std::string& output) {
  const std::vector<std::string> poses =
      is_pattern(pose) ? files_matching(pose) : std::vector<std::string>{pose};
  if (poses.empty()) {
    throw FileError(pose, "no file matches");
  }
  if (poses.size() > 1 && output.find(kPlace) == std::string::npos) {
    throw ParameterError(fmt::format(
        "'output' is '{}', must contain {{}}, which stands for the names of the {} poses", output,
        poses.size()));
  }
  std::vector<PoseJob> jobs;
  std::map<std::string, std::string> sources;
  for (const std::string& path : poses) {
    const std::string result = with_stem(output, path);
    const auto [first, is_new] = sources.try_emplace(result, path);
    if (!is_new) {
      throw ParameterError(fmt::format("'output': {} and {} would both be written to {}",
                                       first->second, path, result));
    }
    jobs.push_back({path, result});
  }
  return jobs;
}

}  // namespace espalier::tools
