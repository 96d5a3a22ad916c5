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

TEST_F(PullCommand, tells_people_no_more_digits_than_they_read) {
  const std::string text = done({"pull", "box.json", "--model", "model.obj", "--pick", "0=8,4,4",
                                 "--stop-at-fold", "-o", "pulled.json"});
  EXPECT_NE(text.find("  stopped at 0.3333 of the way, where the lattice begins to fold\n"),
            std::string::npos)
      << text;
  const Json json = pull({"--pick", "0=5.33334,4,4", "--stop-at-fold"});
  EXPECT_EQ(json["message"], "stopped at 0.9999 of the way, where the lattice begins to fold");
}

TEST_F(PullCommand, tells_when_a_place_is_far_from_the_surface) {
  const Json json = pull({"--pick-at", "3,3,3=3,3,3", "--pick-at", "9,4.5,3=5,4.5,3"});
  EXPECT_EQ(json["picks"].size(), 2u);
  const std::string text =
      done({"pull", "box.json", "--model", "model.obj", "--pick-at", "3,3,3=3,3,3", "--pick-at",
            "9,4.5,3=5,4.5,3", "-o", "pulled.json"});
  EXPECT_NE(text.find("  the surface at (3, 3, 3): "), std::string::npos) << text;
  EXPECT_NE(text.find("  the surface at (5, 4.5, 3), 4 from 9,4.5,3: "), std::string::npos) << text;
}

TEST_F(PullCommand, says_when_the_lattice_is_too_coarse) {
  done({"new", "bezier", "--counts", "2", "2", "2", "--min", "0", "0", "0", "--max", "8", "8", "8",
        "-o", "box.json"});
  write_file("model.obj", "v 4 4 4\nv 4 4 3\nv 4 4 5\n");
  const Json json = pull({"--pick", "0=4,4,5", "--pick", "1=4,4,3", "--pick", "2=4,4,5"});
  // A line stays one: the middle misses by 2/3, the ends by 1/3.
  EXPECT_NEAR(json["picks"][0]["residual"][2].get<double>(), 2.0 / 3, 1e-12);
  EXPECT_NEAR(json["picks"][1]["residual"][2].get<double>(), -1.0 / 3, 1e-12);
  EXPECT_NE(json["message"].get<std::string>().find("too coarse"), std::string::npos);
}

TEST_F(PullCommand, refines_a_lattice_until_it_can) {
  done({"new", "thb", "--counts", "4", "4", "4", "--min", "0", "0", "0", "--max", "8", "8", "8",
        "-o", "box.json"});
  write_file("model.obj", "v 4 4 4\nv 4 4 3.5\nv 4 4 4.5\nv 4 4 3\nv 4 4 5\n");
  const std::vector<std::string> picks = {"--pick", "0=4.1,4,4",   "--pick", "1=3.9,4,3.5",
                                          "--pick", "2=3.9,4,4.5", "--pick", "3=4.1,4,3",
                                          "--pick", "4=4.1,4,5"};
  EXPECT_NE(pull(picks)["message"], "");
  auto with_refine = picks;
  with_refine.emplace_back("--refine");
  const Json json = pull(with_refine);
  EXPECT_GT(json["added_control_points"].get<int>(), 0);
  EXPECT_EQ(json["message"], "");
  for (const Json& pick : json["picks"]) {
    EXPECT_LT(pick["distance"].get<double>(), 2e-11);
  }
  EXPECT_LT(glm::distance(deformed()[0], glm::dvec3(4.1, 4, 4)), 1e-6);
  EXPECT_EQ(Json::parse(done({"info", "pulled.json", "--json"}))["control_points"],
            64 + json["added_control_points"].get<int>());
}

TEST_F(PullCommand, tells_of_surface_points_images_and_groups) {
  const Json json = pull({"--pick-at", "3,3,3=3,3,3.5", "--pick", "2=2,2,2.25", "--symmetry", "y:4",
                          "--magnet", "1,3=0,0,0.1"});
  ASSERT_EQ(json["picks"].size(), 4u);
  EXPECT_EQ(json["picks"][0]["index"], 2);
  EXPECT_FALSE(json["picks"][1].contains("index"));
  EXPECT_EQ(json["picks"][2]["mirrored"], true);
  EXPECT_EQ(point_of(json["picks"][2]["place"]), glm::dvec3(2, 6, 2));
  ASSERT_EQ(json["groups"].size(), 1u);
  EXPECT_EQ(json["groups"][0]["name"], "magnet 1,3");
  EXPECT_EQ(json["groups"][0]["points"], 2);
  EXPECT_EQ(json["groups"][0]["outside"], 2);
  const std::string text = done(
      {"pull", "box.json", "--model", "model.obj", "--magnet", "1,3=0,0,0.1", "-o", "pulled.json"});
  EXPECT_NE(text.find("magnet 1,3: 1 points, at most "), std::string::npos);
  EXPECT_NE(text.find("1 more are outside the lattice"), std::string::npos);
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
  EXPECT_EQ(
      refused({"--pick", "0=1,1,1", "--pin", "729"}),
      "--pin is '729', must be the index of one of 729 control points, from 0, or several such "
      "as 0,3,7-9");
  EXPECT_EQ(refused({"--symmetry", "x"}), "--pick, --pick-at, --magnet or --flatten must be given");
  EXPECT_EQ(refused({"--pick", "0=1,1,1", "--refine"}),
            "--refine needs a thb lattice, this one is of type subdivision");
  EXPECT_EQ(refused({"--pick", "0=1,1,1", "--pick-at", "4,4,4=4,4,nan"}),
            "--pick-at is '4,4,4=4,4,nan', must be x,y,z=tx,ty,tz with six finite numbers: a place "
            "on the model's surface and its goal");
  EXPECT_EQ(refused({"--pick-at", "4,4,4=5,4,4", "--symmetry", "x:4"}),
            "--pick-at takes the surface at (4, 4, 4) off the plane of symmetry x = 4, on which it "
            "lies: give it a goal on the plane");
  for (const char* indices : {"0-999999999", "3-1", "1,,2", "-1"}) {
    EXPECT_EQ(refused({"--magnet", std::string(indices) + "=0,0,1"}),
              "--magnet is '" + std::string(indices) +
                  "', must be indices of the model's points, 0 to 3, such as 0,3,7-9, or a group "
                  "or @FILE");
  }
  write_file("model.obj", "v 4 4 4\nv 4 4 4\nv 2 2 2\nv 20 0 0\nf 1 2 3\n");
  EXPECT_EQ(refused({"--pick", "0=4,4,5", "--pick", "1=4,4,4"}),
            "--pick takes point 0 apart from point 1, which is at the same place (4, 4, 4): give "
            "both the same goal");
  EXPECT_EQ(files(), (std::vector<std::string>{"box.json", "model.obj"}));
}

TEST_F(PullCommand, keeps_the_file_there_was_when_the_pose_or_the_lattice_is_folded) {
  write_file("pulled.json", "as it was");
  drag("box.json", "folded.json", 4 + 9 * (4 + 9 * 4), {7, 0, 0});
  EXPECT_NE(refusal({"pull", "folded.json", "--model", "model.obj", "--pick", "0=4.5,4,4",
                     "--stop-at-fold", "-o", "pulled.json"},
                    1)
                .find("folded.json: the pose is folded before anything moves"),
            std::string::npos);
  Json flat = read_json("box.json");
  for (Json& vertex : flat["vertices"]) {
    vertex[2] = 4;
  }
  write_json("flat.json", flat);
  EXPECT_NE(refusal({"pull", "flat.json", "--model", "model.obj", "--pick", "0=4.5,4,4", "-o",
                     "pulled.json"},
                    1),
            "");
  EXPECT_EQ(read_file("pulled.json"), "as it was");
}

}  // namespace
}  // namespace espalier::tools
