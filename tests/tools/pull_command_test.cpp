/// espalier pull: targets reached, pins, folds, residuals.

#include <glm/geometric.hpp>

#include "deform/model/model_file.h"
#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class PullCommand : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    done({"new", "box", "--cells", "8", "8", "8", "--min", "0", "0", "0", "--max", "8", "8", "8",
          "-o", "box.json"});
    write_file("model.obj", "v 4 4 4\nv 5 4.5 3\nv 2 2 2\nv 20 0 0\nf 1 2 3\n");
  }
  static Json pull(std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"pull", "box.json", "--model", "model.obj", "--json", "-o", "pulled.json"});
    return Json::parse(done(options));
  }
  static std::vector<glm::dvec3> deformed() {
    done({"deform", "model.obj", "--lattice", "pulled.json", "-o", "moved.obj"});
    const Model model = read_model("moved.obj");
    return {model.points().begin(), model.points().end()};
  }
};

TEST_F(PullCommand, takes_picks_to_their_targets) {
  const Json json = pull({"--pick", "0=4.5,4,4.25", "--pick", "1=5,4.5,3"});
  ASSERT_EQ(json["picks"].size(), 2u);
  EXPECT_LT(json["picks"][0]["distance"].get<double>(), 1e-12);
  EXPECT_EQ(json["step"], 1);
  EXPECT_EQ(json["message"], "");
  const auto points = deformed();
  EXPECT_LT(glm::distance(points[0], glm::dvec3(4.5, 4, 4.25)), 1e-6);  // as OBJ files round
  EXPECT_LT(glm::distance(points[1], glm::dvec3(5, 4.5, 3)), 1e-6);
  EXPECT_EQ(points[3], glm::dvec3(20, 0, 0));
}

TEST_F(PullCommand, starts_from_the_pose) {
  pull({"--pick", "0=4.5,4,4"});
  std::filesystem::rename("pulled.json", "box.json");
  pull({"--pick", "0=4.5,4.5,4"});
  EXPECT_LT(glm::distance(deformed()[0], glm::dvec3(4.5, 4.5, 4)), 1e-6);
}

TEST_F(PullCommand, stops_where_the_lattice_begins_to_fold) {
  const Json json = pull({"--pick", "0=8,4,4", "--stop-at-fold"});
  // A knot may go 4/3 along an axis.
  EXPECT_LE(json["step"].get<double>(), 1.0 / 3);
  EXPECT_GE(json["step"].get<double>(), 1.0 / 3 * (1 - 1.1e-4));
  EXPECT_NE(json["message"].get<std::string>().find("begins to fold"), std::string::npos);
  EXPECT_NEAR(json["picks"][0]["residual"][0].get<double>(), 8.0 / 3, 1e-3);
  EXPECT_EQ(Json::parse(done({"check", "pulled.json", "--json"}))["local"], "certified");
}

TEST_F(PullCommand, says_when_the_lattice_is_too_coarse) {
  write_file("model.obj", "v 4 4 4\nv 4 4 4\n");
  const Json json = pull({"--pick", "0=4,4,5", "--pick", "1=4,4,4"});
  EXPECT_NEAR(json["picks"][0]["residual"][2].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(json["picks"][1]["residual"][2].get<double>(), -0.5, 1e-12);
  EXPECT_NE(json["message"].get<std::string>().find("too coarse"), std::string::npos);
}

TEST_F(PullCommand, leaves_pinned_control_points) {
  const std::size_t middle = 4 + 9 * (4 + 9 * 4);
  pull({"--pick", "0=4.5,4,4", "--pin", std::to_string(middle)});
  EXPECT_EQ(point_of(read_json("pulled.json")["pose"][middle]), glm::dvec3(4, 4, 4));
  EXPECT_LT(glm::distance(deformed()[0], glm::dvec3(4.5, 4, 4)), 1e-6);
}

TEST_F(PullCommand, refuses_what_it_cannot_pick) {
  const std::vector<std::string> start = {"pull",      "box.json", "--model",
                                          "model.obj", "-o",       "a.json"};
  const auto refused = [&](std::vector<std::string> options) {
    options.insert(options.begin(), start.begin(), start.end());
    return refusal(options, 2);
  };
  EXPECT_EQ(refused({"--pick", "3=1,1,1"}),
            "--pick names point 3 at (20, 0, 0), which lies outside the lattice: no control point "
            "moves it");
  EXPECT_EQ(refused({"--pick", "4=1,1,1"}),
            "--pick names point 4 of 4 points of the model, counted from 0");
  EXPECT_EQ(refused({"--pick", "0=1,nan,1"}),
            "--pick is '0=1,nan,1', must be INDEX=x,y,z with three finite numbers");
  EXPECT_EQ(refused({"--pick", "0=1,1,1", "--pin", "729"}),
            "--pin is '729', must be the index of one of 729 control points, from 0");
  EXPECT_EQ(files(), (std::vector<std::string>{"box.json", "model.obj"}));
}

}  // namespace
}  // namespace espalier::tools
