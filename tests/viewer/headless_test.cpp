#include "viewer/app/headless.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice.h"
#include "tests/support/temporary_folder.h"

namespace espalier::viewer {
namespace {

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

class HeadlessTest : public ::testing::Test {
 protected:
  HeadlessTest() { write_file(path("square.obj"), kSquare); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }
  [[nodiscard]] Picture run(const std::string& script) const {
    return run_headless({{path("square.obj")}, script, "test.script", 800, 600});
  }
  /// Clay is redder than it is blue, and light; panels and background are grey and dark.
  static bool is_clay(const Picture& picture, int x, int y) {
    const auto pixel = picture.at(x, y);
    return pixel[0] > pixel[2] + 30 && pixel[0] > 100;
  }

  test::TemporaryFolder folder_;
};

TEST_F(HeadlessTest, shows_the_model_between_the_panels) {
  const Picture picture = run("key kp1");
  EXPECT_TRUE(is_clay(picture, 400, 300));
  EXPECT_FALSE(is_clay(picture, 400, 590));
  const auto panel = picture.at(14, 200);
  const auto background = picture.at(300, 8);
  EXPECT_LT(panel[1], 50);
  EXPECT_GT(background[1], panel[1] + 10);
}

TEST_F(HeadlessTest, pictures_are_taken_where_the_script_says) {
  std::map<std::string, Picture> taken;
  HeadlessOptions options{{path("square.obj")},
                          "key kp1\npicture front\nkey kp3\npicture side\nkey f1",
                          "test.script",
                          800,
                          600};
  const Picture without = run_headless(options);
  options.on_picture = [&](const std::string& name, const Picture& picture) {
    taken.emplace(name, picture);
  };
  const Picture last = run_headless(options);
  EXPECT_EQ(last.pixels, without.pixels);
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_TRUE(is_clay(taken.at("front"), 380, 280));
  EXPECT_FALSE(is_clay(taken.at("side"), 380, 280));
  EXPECT_EQ(taken.at("front").pixels, run("key kp1").pixels);
}

TEST_F(HeadlessTest, a_script_builds_binds_bends_and_saves) {
  const Picture picture =
      run("# the square goes to the right by its width\n"
          "key n b kp1 ctrl+3 a g x 1 enter\n"
          "key ctrl+s");
  EXPECT_EQ(read_file(path("square_bent.obj")), "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4\n");
  EXPECT_FALSE(is_clay(picture, 300, 300));
  EXPECT_TRUE(is_clay(picture, 790, 250) || is_clay(picture, 790, 350));
}

/// In a picture: below the knee control points turn by 50 degrees about the middle of its ring.
TEST_F(HeadlessTest, the_guide_bends_the_figures_knee) {
  const std::string data = ESPALIER_TEST_DATA;
  std::filesystem::copy_file(data + "/figure.obj", path("figure.obj"));
  const std::string script = read_file(data + "/leg_session.txt") + "key ctrl+s\n";
  (void)run_headless({{path("figure.obj")}, script, "leg_session.txt", 1000, 640});
  const Lattice lattice = read_any_lattice(path("lattice_bent.json"));
  const auto* leg = lattice.as<SubdivisionLattice>();
  ASSERT_NE(leg, nullptr);
  ASSERT_EQ(leg->complex->n_cells(), 5u);
  ASSERT_EQ(leg->pose.size(), 24u);
  // Rings grow downward, four corners each: the third is the knee.
  glm::dvec3 knee(0.0);
  for (std::size_t i = 12; i < 16; ++i) {
    EXPECT_EQ(leg->pose[i - 4], leg->rest[i - 4]);
    knee += leg->rest[i - 4] / 4.0;
  }
  const double angle = glm::radians(50.0);
  for (std::size_t i = 12; i < 24; ++i) {
    const glm::dvec3 arm = leg->rest[i] - knee;
    const glm::dvec3 turned(arm.x, std::cos(angle) * arm.y - std::sin(angle) * arm.z,
                            std::sin(angle) * arm.y + std::cos(angle) * arm.z);
    EXPECT_LE(glm::distance(leg->pose[i], knee + turned), 1e-12) << i;
  }
  EXPECT_TRUE(std::filesystem::exists(path("figure_bent.obj")));
}

TEST_F(HeadlessTest, a_file_is_opened_by_typing_its_path_into_the_panel) {
  const Picture picture =
      run_headless({{},
                    "key f2\ntype " + path("square.obj") + "\nkey enter\nkey n kp1 home ctrl+s",
                    "s",
                    800,
                    600});
  EXPECT_TRUE(is_clay(picture, 370, 330));  // beside the handles
  EXPECT_TRUE(std::filesystem::exists(path("lattice_bent.json")));
}

TEST_F(HeadlessTest, enter_in_the_palette_opens_a_form_whose_preview_goes_with_it) {
  const auto count_amber = [](const Picture& picture) {
    int n = 0;
    for (int y = 0; y < 560; ++y) {
      for (int x = 250; x < 400; ++x) {
        const auto pixel = picture.at(x, y);
        n += pixel[0] > 200 && pixel[1] > 120 && pixel[1] < 210 && pixel[2] < 90 ? 1 : 0;
      }
    }
    return n;
  };
  const std::string open_form = "key f3\ntype new box\nkey enter\n";
  EXPECT_GT(count_amber(run(open_form)), 200);
  EXPECT_EQ(count_amber(run(open_form + "key escape")), 0);
}

TEST_F(HeadlessTest, an_error_names_the_line_of_the_script) {
  try {
    (void)run("key kp1\nopen path=nothing.obj");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("test.script:2: open: nothing.obj: "))
        << error.what();
  }
  EXPECT_THROW((void)run("fly"), FileError);
  EXPECT_THROW((void)run_headless({{path("none.obj")}, "", "s", 80, 60}), Error);
}

}  // namespace
}  // namespace espalier::viewer
