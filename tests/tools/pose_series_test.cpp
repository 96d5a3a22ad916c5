/// espalier deform with many poses in one run.

#include "tools/pose_series.h"

#include <algorithm>

#include "deform/scene/operations.h"
#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class PoseSeries : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    std::filesystem::create_directory("poses");
    std::filesystem::create_directory("out");
    done({"new", "box", "-o", "box.json"});
    for (std::size_t i = 0; i < 3; ++i) {
      drag("box.json", "poses/frame" + std::to_string(i) + ".json", 13 + i, {0.1, 0.2, 0.3});
    }
    write_file("cube.obj", "v 0.5 0.5 0.5\nv 0.25 0.5 0.75\nv 0.9 0.5 0.1\nf 1 2 3\n");
  }

  static std::vector<std::string> results() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator("out")) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  static std::vector<std::string> series(const std::string& poses, const std::string& output) {
    return {"deform", "cube.obj", "--lattice", "box.json", "--pose", poses, "-o", output};
  }
};

TEST_F(PoseSeries, gives_the_bytes_of_one_run_for_each_pose) {
  const std::string report = done(series("poses/*.json", "out/{}.obj"));
  EXPECT_EQ(results(), (std::vector<std::string>{"frame0.obj", "frame1.obj", "frame2.obj"}));
  std::string reports;
  for (const std::string name : {"frame0", "frame1", "frame2"}) {
    reports += done(series("poses/" + name + ".json", "out/single.obj"));
    EXPECT_EQ(read_file("out/" + name + ".obj"), read_file("out/single.obj"));
    EXPECT_NE(read_file("out/single.obj"), read_file("cube.obj"));
    reports.replace(reports.find("single"), 6, name);
  }
  EXPECT_EQ(report, reports);
}

TEST_F(PoseSeries, reports_a_json_array) {
  auto words = series("poses/frame[02].json", "out/{}.obj");
  words.emplace_back("--json");
  const Json report = Json::parse(done(words));
  ASSERT_EQ(report.size(), 2u);
  EXPECT_EQ(report[0]["output"], "out/frame0.obj");
  EXPECT_EQ(report[1]["output"], "out/frame2.obj");
  EXPECT_EQ(report[1]["inside"], 3);
}

TEST_F(PoseSeries, goes_on_after_a_pose_that_fails) {
  done({"new", "box", "--cells", "1", "1", "1", "-o", "poses/frame0b.json"});
  write_file("poses/frame1.json", "no lattice");
  const Outcome outcome = run(series("poses/*.json", "out/{}.obj"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(results(), (std::vector<std::string>{"frame0.obj", "frame2.obj"}));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2);
  EXPECT_EQ(outcome.err.find("espalier: poses/frame0b.json: has 8 vertices"), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("\nespalier: poses/frame1.json:1: "), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.out.find("out/frame2.obj: 3 points"), std::string::npos);
}

TEST_F(PoseSeries, refuses_patterns_without_matches_and_results_without_names) {
  EXPECT_EQ(refusal(series("poses/*.ovm", "out/{}.obj"), 1), "poses/*.ovm: no file matches");
  EXPECT_EQ(
      refusal(series("poses/*.json", "out/all.obj"), 2),
      "--output is 'out/all.obj', must contain {}, which stands for the names of the 3 poses");
  EXPECT_EQ(refusal(series("poses/*.json", "out/{}.json"), 1).substr(0, 17), "out/frame0.json: ");
  done({"convert", "poses/frame1.json", "-o", "poses/frame1.ovm"});
  EXPECT_EQ(refusal(series("poses/*", "out/{}.obj"), 2),
            "--output: poses/frame1.json and poses/frame1.ovm would both be written to "
            "out/frame1.obj");
  auto words = series("poses/frame?.json", "out/{}.obj");
  words.insert(words.end(), {"--freeze", "deep"});
  EXPECT_EQ(refusal(words, 2).substr(0, 8), "--freeze");
  EXPECT_EQ(results(), std::vector<std::string>());
}

TEST_F(PoseSeries, of_one_pose_needs_no_place_for_its_name) {
  done(series("poses/frame1*", "out/one.obj"));
  done(series("poses/frame1.json", "out/{}.obj"));
  EXPECT_EQ(read_file("out/frame1.obj"), read_file("out/one.obj"));
}

TEST_F(PoseSeries, takes_a_file_that_is_named_like_a_pattern_as_that_file) {
  drag("box.json", "poses/frame[1].json", 13, {1, 1, 1});
  EXPECT_FALSE(is_pose_series("poses/frame[1].json", "out/one.obj"));
  EXPECT_TRUE(is_pose_series("poses/frame[12].json", "out/one.obj"));
  const auto jobs = pose_jobs("poses/frame[1].json", "{}/{}.obj");
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0].pose, "poses/frame[1].json");
  EXPECT_EQ(jobs[0].output, "frame[1]/frame[1].obj");
}

TEST_F(PoseSeries, is_bound_once) {
  const auto words = [](const std::string& path) { return Arguments({{"path", path}}); };
  Scene scene = apply(operation_named("open"), Scene(), words("cube.obj"));
  scene = apply(operation_named("open"), scene, words("box.json"));
  const Volume* volume = nullptr;
  for (const std::string pose : {"poses/frame0.json", "poses/frame1.json"}) {
    scene = apply(operation_named("open"), scene,
                  Arguments({{"path", pose}, {"kind", std::string("pose")}}));
    scene = apply(operation_named("deform"), scene,
                  Arguments({{"model", std::string("cube.obj")},
                             {"lattice", std::string("box.json")},
                             {"pose", pose},
                             {"output", std::string("moved")}}));
    ASSERT_EQ(scene.bound.size(), 1u);
    const Volume* bound = scene.bound.begin()->second.volume.get();
    EXPECT_TRUE(volume == nullptr || bound == volume);
    volume = bound;
  }
}

}  // namespace
}  // namespace espalier::tools
