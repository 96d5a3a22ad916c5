/// espalier check: verdicts, witnesses, exit status.

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class CheckCommand : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    done({"new", "box", "--cells", "8", "8", "8", "--min", "0", "0", "0", "--max", "8", "8", "8",
          "-o", "box.json"});
  }
  /// The report and the exit status.
  static Json report(const std::vector<std::string>& words, int status) {
    std::vector<std::string> all = {"check", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return Json::parse(outcome.out);
  }
};

constexpr std::size_t kMiddle = 4 + 9 * (4 + 9 * 4);

TEST_F(CheckCommand, certifies_a_lattice_at_rest) {
  const Json json = report({"box.json"}, 0);
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["local"], "certified");
  EXPECT_EQ(json["boundary"], "simple");
  EXPECT_EQ(json["injective"], "certified");
  EXPECT_EQ(json["patches"], 512);
  EXPECT_FALSE(json.contains("largest_step"));
}

TEST_F(CheckCommand, gives_witnesses_of_a_fold) {
  drag("box.json", "folded.json", kMiddle, {3.5, 0, 0});
  const Json json = report({"folded.json"}, 1);
  EXPECT_EQ(json["local"], "folded");
  EXPECT_EQ(json["injective"], "folded");
  ASSERT_EQ(json["folds"].size(), 4u);  // round the line that the point was moved along
  for (const Json& fold : json["folds"]) {
    EXPECT_NEAR(point_of(fold["rest"]).x, 4.75, 1e-12);
    // 1 − 3.5 · B'(3/4) · B(0)², B' = 2x − 3/2 x².
    EXPECT_NEAR(fold["determinant"].get<double>(), 1 - 3.5 * (1.5 - 27. / 32) * 4 / 9, 1e-12);
  }
  const std::string text = run({"check", "folded.json"}).out;
  const std::size_t first = text.find("folded at rest point (4.7");
  EXPECT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find("folded at", first + 1), std::string::npos) << text;  // one place, once
  EXPECT_EQ(
      report({"folded.json", "--drag", std::to_string(kMiddle) + "=1,0,0"}, 1)["largest_step"], 0);
}

TEST_F(CheckCommand, tells_the_largest_step_of_a_drag) {
  const std::string index = std::to_string(kMiddle);
  const Json json = report({"box.json", "--drag", index + "=0,2,0"}, 0);
  EXPECT_LE(json["largest_step"].get<double>(), 27.0 / 16);
  EXPECT_GE(json["largest_step"].get<double>(), 27.0 / 16 * (1 - 1e-4));
  std::vector<std::string> all = {"box.json"};
  for (int i = 0; i < 729; ++i) {
    all.insert(all.end(), {"--drag", std::to_string(i) + "=0,2,0"});
  }
  EXPECT_TRUE(report(all, 0)["largest_step"].is_null());  // a translation
  // People are told six digits, rounded down.
  const std::string text = done({"check", "box.json", "--drag", index + "=0,2,0"});
  const std::size_t at = text.find("  largest step: 1.68");
  ASSERT_NE(at, std::string::npos) << text;
  const double told = std::stod(text.substr(at + 16));
  EXPECT_LE(told, json["largest_step"].get<double>());
  EXPECT_NEAR(told, json["largest_step"].get<double>(), 1e-5);
  EXPECT_LE(text.size() - at, std::string("  largest step: 1.68750\n").size());
}

TEST_F(CheckCommand, certifies_a_moved_boundary) {
  drag("box.json", "moved.json", 0, {-0.5, 0, 0});
  const Json json = report({"moved.json"}, 0);
  EXPECT_EQ(json["local"], "certified");
  EXPECT_EQ(json["boundary"], "simple");
  EXPECT_EQ(json["injective"], "certified");
  EXPECT_EQ(json["boundary_faces"], 6 * 64);
  EXPECT_TRUE(json["crossings"].empty());
}

TEST_F(CheckCommand, shows_where_a_bar_passes_through_itself) {
  done({"new", "box", "--cells", "20", "1", "1", "--min", "0", "0", "0", "--max", "20", "1", "1",
        "-o", "bar.json"});
  const auto bend = [](double angle) {
    return [angle](const glm::dvec3& x) {
      const double radius = x.y + 20 / angle;
      return glm::dvec3(radius * std::sin(x.x * angle / 20), radius * std::cos(x.x * angle / 20),
                        x.z + 0.02 * x.x);
    };
  };
  pose_by("bar.json", "open.json", bend(5));
  EXPECT_EQ(report({"open.json"}, 0)["injective"], "certified");
  pose_by("bar.json", "closed.json", bend(6.6));
  const Json json = report({"closed.json"}, 1);
  EXPECT_EQ(json["local"], "certified");
  EXPECT_EQ(json["boundary"], "intersecting");
  EXPECT_EQ(json["injective"], "folded");
  ASSERT_FALSE(json["crossings"].empty());
  const Json& places = json["crossings"][0]["places"];
  EXPECT_GT(glm::distance(point_of(places[0]["rest"]), point_of(places[1]["rest"])), 10);
  EXPECT_NE(run({"check", "closed.json"}).out.find("the boundary crosses itself at ("),
            std::string::npos);
}

TEST_F(CheckCommand, certifies_no_lattice_that_passes_through_itself_at_rest) {
  done({"new", "bspline", "--counts", "20", "4", "4", "--max", "20", "1", "1", "-o", "bar.json"});
  Json lattice = read_json("bar.json");
  for (Json& point : lattice["rest"]) {
    const glm::dvec3 x = point_of(point);
    const double radius = x.y + 20 / 6.6;
    point = {radius * std::sin(0.33 * x.x), radius * std::cos(0.33 * x.x), x.z + 0.02 * x.x};
  }
  write_json("ring.json", lattice);
  const Json json = report({"ring.json"}, 3);
  EXPECT_EQ(json["local"], "certified");
  EXPECT_EQ(json["boundary"], "undecided");
  EXPECT_EQ(json["injective"], "undecided");
}

TEST_F(CheckCommand, leaves_a_boundary_that_only_touches_itself_undecided) {
  done({"new", "box", "--cells", "6", "1", "1", "--min", "0", "0", "0", "--max", "6", "1", "1",
        "-o", "bar.json"});
  pose_by("bar.json", "flat.json", [](const glm::dvec3& x) {  // the ends meet face to face
    const double turn = std::min(x.x, 6 - x.x) < 2 ? 0 : 1;
    return x.x >= 4 ? glm::dvec3(6 - x.x, x.y, 2 - x.z)
                    : glm::dvec3(x.x + turn * 0.5, x.y, turn == 0 ? x.z : 1 + (x.x - 3) * 0.5);
  });
  EXPECT_NE(report({"flat.json"}, 1)["boundary"], "simple");
}

TEST_F(CheckCommand, of_the_patches_of_a_model_is_not_sure_of_those_that_fold_elsewhere) {
  write_file("near.obj", "v 0.5 0.5 0.5\nv 1 0.5 0.5\nv 0.5 1 0.5\nf 1 2 3\n");
  EXPECT_EQ(report({"box.json", "--model", "near.obj"}, 0)["injective"], "certified");
  drag("box.json", "folded.json", kMiddle, {3.5, 0, 0});
  const Json json = report({"folded.json", "--model", "near.obj"}, 3);
  EXPECT_EQ(json["local"], "certified");
  EXPECT_EQ(json["boundary"], "simple");
  EXPECT_EQ(json["injective"], "undecided");
}

TEST_F(CheckCommand, tells_how_the_volume_of_a_closed_model_changes) {
  write_file("cube.obj", cube_obj());
  write_file("open.obj", "v 1 1 1\nv 2 1 1\nv 1 2 1\nf 1 2 3\n");
  pose_by("box.json", "posed.json", [](const glm::dvec3& x) { return x * glm::dvec3(1.5, 1, 1); });
  EXPECT_NEAR(report({"posed.json", "--model", "cube.obj"}, 0)["volume_change"].get<double>(), 50,
              1e-9);
  EXPECT_EQ(report({"box.json", "--model", "cube.obj"}, 0)["volume_change"], 0);
  EXPECT_TRUE(report({"posed.json", "--model", "open.obj"}, 0)["volume_change"].is_null());
  EXPECT_FALSE(report({"box.json"}, 0).contains("volume_change"));
  EXPECT_NE(run({"check", "posed.json", "--model", "cube.obj"})
                .out.find("volume of the model: +50.00 %\n"),
            std::string::npos);
}

TEST_F(CheckCommand, refuses_drags_that_name_no_point_or_vector) {
  EXPECT_EQ(refusal({"check", "box.json", "--drag", "3=1,nan,2"}, 2),
            "--drag is '3=1,nan,2', must be INDEX=x,y,z with three finite numbers");
  EXPECT_EQ(refusal({"check", "box.json", "--drag", "3=1,2"}, 2),
            "--drag is '3=1,2', must be INDEX=x,y,z with three finite numbers");
  EXPECT_EQ(refusal({"check", "box.json", "--drag", "729=1,0,2"}, 2),
            "--drag names point 729 of 729 control points, counted from 0");
  EXPECT_EQ(refusal({"check", "box.json", "--drag", "7=1,0,2", "--drag", "7=1,0,2"}, 2),
            "--drag names point 7 twice: give one vector for each");
  EXPECT_EQ(refusal({"check", "box.json", "--drag", "7=0,0,0"}, 2),
            "--drag moves nothing: give a vector that is not zero");
}

TEST_F(CheckCommand, lists_the_defects_of_an_invalid_lattice) {
  Json json = read_json("box.json");
  json["vertices"][kMiddle] = {6.5, 4, 4};
  write_json("bad.json", json);
  const Json found = report({"bad.json"}, 1);
  EXPECT_EQ(found["valid"], false);
  EXPECT_FALSE(found["defects"].empty());
  EXPECT_FALSE(found.contains("local"));
}

}  // namespace
}  // namespace espalier::tools
