#pragma once

/// Bézier, B-spline, NURBS and hierarchical lattices in files, and a model in them.

#include <cmath>
#include <string>
#include <vector>

#include "deform/model/model_file.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {

using Words = std::vector<std::string>;

inline constexpr const char* kCloud =
    "v 0.1 0.2 0.3\nv 0.9 0.1 0.4\nv 0.25 0.75 0.5\nv 0.6 0.55 0.95\nv 0.05 0.05 0.05\n"
    "f 1 2 3\nf 2 3 4\nf 1 3 5\n";

class TensorCommands : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    write_file("cloud.obj", kCloud);
  }

  /// One lattice of each type on the unit cube, in TYPE.json; with knots and levels inside.
  static Words make_all() {
    done({"new", "bezier", "--counts", "3", "4", "2", "-o", "bezier.json"});
    done({"new", "bspline", "--counts", "5", "6", "4", "--degree", "2", "3", "1", "--ends",
          "open,uniform,natural", "-o", "bspline.json"});
    done({"new", "nurbs", "--counts", "4", "5", "4", "-o", "nurbs.json"});
    Json nurbs = read_json("nurbs.json");
    for (std::size_t i = 0; i < nurbs["weights"].size(); ++i) {
      nurbs["weights"][i] = 1 + 0.125 * static_cast<double>(i % 5);
    }
    write_json("nurbs.json", nurbs);
    done({"new", "thb", "--counts", "5", "5", "5", "--degree", "2", "2", "2", "-o", "base.json"});
    done({"refine", "base.json", "--box", "0", "0", "0", "0.6666666666666666", "1",
          "0.6666666666666666", "--level", "1", "-o", "thb.json"});
    return {"bezier", "bspline", "nurbs", "thb"};
  }

  /// The lattice file with the pose that a map makes of its rest points.
  template <class Map>
  static void pose_lattice(const std::string& path, const std::string& posed, const Map& map) {
    const Lattice lattice = read_any_lattice(path);
    std::vector<glm::dvec3> pose;
    for (const glm::dvec3& point : lattice.rest_points()) {
      pose.push_back(map(point));
    }
    write_any_lattice(posed, lattice.with_pose(pose));
  }

  /// Where the model's points go.
  static std::vector<glm::dvec3> deformed_points(const std::string& lattice,
                                                 const Words& more = {}) {
    Words words = {"deform", "cloud.obj", "--lattice", lattice, "-o", "out.obj"};
    words.insert(words.end(), more.begin(), more.end());
    done(words);
    const Model model = read_model("out.obj");
    return {model.points().begin(), model.points().end()};
  }
};

/// Smooth and not affine.
inline glm::dvec3 bend(const glm::dvec3& x) {
  return x + 0.1 * glm::dvec3(x.y * x.y, std::sin(3 * x.z), x.x * x.y);
}

inline double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double distance = a.size() == b.size() ? 0 : 1e300;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    distance = std::max(distance, glm::distance(a[i], b[i]));
  }
  return distance;
}

}  // namespace espalier::tools
