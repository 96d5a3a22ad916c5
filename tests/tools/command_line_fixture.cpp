#include "tests/tools/command_line_fixture.h"

#include <algorithm>
#include <sstream>

#include "lattice/core/file.h"
#include "lattice/core/parallel.h"
#include "tools/command_line.h"

namespace espalier::tools {

void CommandLineTest::SetUp() {
  folder_before_ = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
}

void CommandLineTest::TearDown() {
  set_thread_count(0);
  std::filesystem::current_path(folder_before_);
}

Outcome CommandLineTest::run(const std::vector<std::string>& words) {
  Outcome outcome;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    outcome.status = static_cast<int>(run_command_line(words));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "espalier: %s\n", error.what());
    outcome.status = static_cast<int>(ExitStatus::Failed);
  }
  outcome.out = ::testing::internal::GetCapturedStdout();
  outcome.err = ::testing::internal::GetCapturedStderr();
  return outcome;
}

std::string CommandLineTest::done(const std::vector<std::string>& words) {
  Outcome outcome = run(words);
  EXPECT_EQ(outcome.status, 0) << ::testing::PrintToString(words);
  EXPECT_EQ(outcome.err, "") << ::testing::PrintToString(words);
  return outcome.out;
}

std::string CommandLineTest::refusal(const std::vector<std::string>& words, int status) {
  const Outcome outcome = run(words);
  EXPECT_EQ(outcome.status, status) << ::testing::PrintToString(words);
  EXPECT_EQ(outcome.out, "") << ::testing::PrintToString(words);
  const auto n_lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
  const std::size_t end = std::min(outcome.err.find('\n'), outcome.err.size());
  const std::string first = outcome.err.substr(0, end);
  EXPECT_EQ(first.substr(0, 10), "espalier: ") << outcome.err;
  EXPECT_EQ(n_lines, status == 2 ? 2 : 1) << outcome.err;
  if (status == 2) {
    EXPECT_EQ(outcome.err.substr(end, 15), "\nTry 'espalier ") << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with("--help'.\n")) << outcome.err;
  }
  return first.size() < 10 ? first : first.substr(10);
}

std::vector<std::string> CommandLineTest::files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(".")) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Json read_json(const std::string& path) {
  return Json::parse(read_file(path));
}

void write_json(const std::string& path, const Json& json) {
  write_file(path, json.dump());
}

glm::dvec3 point_of(const Json& triple) {
  return {triple.at(0).get<double>(), triple.at(1).get<double>(), triple.at(2).get<double>()};
}

void drag(const std::string& path, const std::string& posed_path, std::size_t vertex,
          const glm::dvec3& by) {
  Json json = read_json(path);
  json["pose"] = json["vertices"];
  const glm::dvec3 moved = point_of(json["pose"][vertex]) + by;
  json["pose"][vertex] = {moved.x, moved.y, moved.z};
  write_json(posed_path, json);
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    auto& row = rows.emplace_back();
    for (std::string word; std::getline(words, word, ',');) {
      row.push_back(word);
    }
  }
  return rows;
}

std::string cube_obj() {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
         "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

}  // namespace espalier::tools
