#pragma once

/// Running commands in this process, each test in a folder of its own.

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace espalier::tools {

using Json = nlohmann::ordered_json;

/// What a command leaves behind.
struct Outcome {
  int status = 0;
  std::string out;
  std::string err;
};

/// The current folder is a fresh one, so files have short names. It is gone after the test.
class CommandLineTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Runs a command as the program would.
  static Outcome run(const std::vector<std::string>& words);
  /// The same of a command that must succeed: its standard output.
  static std::string done(const std::vector<std::string>& words);
  /// Standard error of a command that must fail with this status, without the "espalier: " that it
  /// must begin with and without the hint that must follow wrong usage.
  static std::string refusal(const std::vector<std::string>& words, int status);

  /// The names of all files in the folder, sorted.
  static std::vector<std::string> files();

 private:
  test::TemporaryFolder folder_;
  std::filesystem::path folder_before_;
};

/// A lattice file as JSON, and back.
[[nodiscard]] Json read_json(const std::string& path);
void write_json(const std::string& path, const Json& json);
[[nodiscard]] glm::dvec3 point_of(const Json& triple);

/// x' = A x + t, with nothing symmetric about it.
struct AffineMap {
  glm::dmat3 A{1.5, 0.25, -0.125, 0.5, 0.75, 0.375, -0.25, 0.125, 1.25};
  glm::dvec3 t{10, -20, 30};
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& x) const { return A * x + t; }
};

/// Sets the "pose" of a lattice file to its rest points under a map.
template <class Map>
void pose_by(const std::string& path, const std::string& posed_path, const Map& map) {
  Json json = read_json(path);
  json["pose"] = Json::array();
  for (const Json& vertex : json["vertices"]) {
    const glm::dvec3 posed = map(point_of(vertex));
    json["pose"].push_back({posed.x, posed.y, posed.z});
  }
  write_json(posed_path, json);
}

/// Moves one control point of a lattice file by a vector.
void drag(const std::string& path, const std::string& posed_path, std::size_t vertex,
          const glm::dvec3& by);

/// The lines of a CSV as words.
[[nodiscard]] std::vector<std::vector<std::string>> rows_of(const std::string& csv);

/// The unit cube as OBJ, faces outward.
[[nodiscard]] std::string cube_obj();

}  // namespace espalier::tools
