#pragma once

/// A folder with a model and lattices, and commands run in it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "deform/model/model_file.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice_file.h"
#include "tests/support/families.h"
#include "tests/support/temporary_folder.h"
#include "tools/command_line.h"

namespace espalier::test {

/// Four points in the unit cube, in two groups of one object, and one far outside, in neither.
inline constexpr const char* kModel =
    "o all\n"
    "v 0.25 0.25 0.25\n"
    "v 0.75 0.25 0.25\n"
    "v 0.5 0.75 0.25  # comment\n"
    "v 0.5 0.5 0.75\n"
    "v 9 9 9\n"
    "vn 0 0 1\n"
    "g low\nf 1//1 2//1 3//1\n"
    "g high\nf 1//1 2//1 4//1\n";

/// Where the points of kModel are, and the number of them that the unit cube holds.
inline const std::vector<glm::dvec3> kModelPoints = {
    {0.25, 0.25, 0.25}, {0.75, 0.25, 0.25}, {0.5, 0.75, 0.25}, {0.5, 0.5, 0.75}, {9, 9, 9}};
inline constexpr std::size_t kHeld = 4;

/// The command's exit status, and what it said.
struct Outcome {
  int status = 0;
  std::string output;
  std::string errors;
};

class DeformCommand : public ::testing::Test {
 protected:
  DeformCommand() {
    write("model.obj", kModel);
    add_lattice("box.json", "shifted.json", {0.5, 0, 0});
    add_lattice("other.json", "raised.json", {0, 0, 0.25});
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }
  void write(const std::string& name, const std::string& bytes) const {
    write_file(path(name), bytes);
  }
  [[nodiscard]] std::string bytes(const std::string& name) const { return read_file(path(name)); }
  [[nodiscard]] std::vector<glm::dvec3> points(const std::string& name) const {
    const Model model = read_model(path(name));
    return {model.points().begin(), model.points().end()};
  }

  /// The unit cube in 2 × 2 × 2 cells, and the same moved by `shift` as a pose.
  void add_lattice(const std::string& rest, const std::string& pose,
                   const glm::dvec3& shift) const {
    SubdivisionLattice lattice = lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1}));
    write_lattice(path(rest), lattice);
    lattice.pose = lattice.rest;
    for (glm::dvec3& point : lattice.pose) {
      point += shift;
    }
    write_lattice(path(pose), lattice);
  }

  /// Runs a command; words that end in a known extension are files of the folder, also after @.
  [[nodiscard]] Outcome run(std::vector<std::string> words) const {
    for (std::string& word : words) {
      for (const char* extension : {".obj", ".json", ".txt", ".binding"}) {
        if (word.ends_with(extension) && !word.starts_with("/")) {
          word = word[0] == '@' ? "@" + path(word.substr(1)) : path(word);
        }
      }
    }
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    Outcome outcome;
    std::string thrown;
    try {
      outcome.status = static_cast<int>(tools::run_command_line(words));
    } catch (const Error& error) {
      outcome.status = 1;
      thrown = error.what();
    }
    outcome.output = ::testing::internal::GetCapturedStdout();
    outcome.errors = ::testing::internal::GetCapturedStderr() + thrown;
    return outcome;
  }

  /// The points after `espalier deform` with these words, which must succeed.
  [[nodiscard]] std::vector<glm::dvec3> deformed_points(std::vector<std::string> options) const {
    std::vector<std::string> words = {"deform", "model.obj",    "--lattice", "box.json",
                                      "--pose", "shifted.json", "-o",        "out.obj"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return points("out.obj");
  }

  /// The points of kModel that `follows` tells moved by `move`.
  template <class Follows>
  [[nodiscard]] static std::vector<glm::dvec3> moved(const glm::dvec3& move,
                                                     const Follows& follows) {
    std::vector<glm::dvec3> points = kModelPoints;
    for (std::size_t i = 0; i < kHeld; ++i) {
      points[i] += follows(i) * move;
    }
    return points;
  }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace espalier::test
