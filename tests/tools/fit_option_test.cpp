/// espalier new … --fit.

#include <cmath>

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class FitOption : public CommandLineTest {
 protected:
  void SetUp() override {
    CommandLineTest::SetUp();
    write_file("cube.obj", "g half\n" + cube_obj());
  }
  static Json info(const std::string& path) { return Json::parse(done({"info", path, "--json"})); }
};

TEST_F(FitOption, lattices_hold_the_model_that_they_are_fitted_to) {
  for (const char* kind : {"box", "cylinder", "ogrid", "star"}) {
    done({"new", kind, "--fit", "cube.obj", "-o", "a.json"});
    const Json report = Json::parse(
        done({"deform", "cube.obj", "--lattice", "a.json", "-o", "same.obj", "--json"}));
    EXPECT_EQ(report["inside"], 8) << kind;
  }
}

TEST_F(FitOption, a_box_has_the_padding_on_all_sides) {
  done({"new", "box", "--fit", "cube.obj", "--padding", "1", "--only", "half", "-o", "a.json"});
  const double padding = std::sqrt(3.0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(point_of(info("a.json")["min"])[axis], -padding, 1e-14);
    EXPECT_NEAR(point_of(info("a.json")["max"])[axis], 1 + padding, 1e-14);
  }
}

TEST_F(FitOption, the_axis_is_the_one_that_is_asked_for) {
  for (const auto& [along, axis] : {std::pair("x", 0), std::pair("y", 1), std::pair("z", 2)}) {
    done({"new", "ogrid", "--fit", "cube.obj", "--along", along, "--padding", "0", "-o", "a.json"});
    EXPECT_NEAR(point_of(info("a.json")["min"])[axis], 0, 1e-14);
    EXPECT_LT(point_of(info("a.json")["min"])[(axis + 1) % 3], -0.2);
  }
}

TEST_F(FitOption, places_and_sizes_keep_their_meaning_without_a_model) {
  done({"new", "cylinder", "-o", "a.json"});
  done({"new", "cylinder", "--from", "0", "0", "0", "--to", "0", "1", "0", "--radius", "0.5",
        "--sectors", "8", "--layers", "4", "-o", "b.json"});
  EXPECT_EQ(read_file("a.json"), read_file("b.json"));
}

TEST_F(FitOption, names_what_excludes_it) {
  EXPECT_EQ(refusal({"new", "box", "--fit", "cube.obj", "--max", "1", "1", "1", "-o", "a.json"}, 2),
            "--fit and --max exclude each other");
  EXPECT_EQ(refusal({"new", "sphere", "--padding", "0.1", "-o", "a.json"}, 2),
            "--padding is for --fit");
  EXPECT_EQ(refusal({"new", "sphere", "--fit", "cube.obj", "--only", "x", "-o", "a.json"}, 2),
            "cube.obj has no group or object named 'x': it has half");
  EXPECT_EQ(files(), std::vector<std::string>{"cube.obj"});
}

}  // namespace
}  // namespace espalier::tools
