#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "deform/scene/operation_text.h"
#include "lattice/core/file.h"
#include "viewer/interact/bent_models.h"
#include "viewer/interact/session.h"

namespace espalier::viewer {
namespace {

/// A wavy sheet of 40 × 40 points in a bar of 4 × 2 × 2 cells, bound, in Pose mode.
class BentModelTest : public ::testing::Test {
 protected:
  BentModelTest() {
    constexpr int n = 40;
    std::string obj;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        obj += "v " + std::to_string(0.1 + 3.8 * i / (n - 1)) + " " +
               std::to_string(0.1 + 1.8 * j / (n - 1)) + " " +
               std::to_string(1 + 0.3 * std::sin(0.4 * i)) + "\n";
      }
    }
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        const int at = 1 + i + n * j;
        obj += "f " + std::to_string(at) + " " + std::to_string(at + 1) + " " +
               std::to_string(at + n + 1) + " " + std::to_string(at + n) + "\n";
      }
    }
    path_ = ::testing::TempDir() + "/espalier_bent.obj";
    write_file(path_, obj);
    session_.open(path_);
    session_.run_line("new box cells=4,2,2 max=4,2,2 output=bar");
    session_.frame_all();
    session_.bind();
    session_.set_mode(Mode::Pose);
  }

  void press(const std::vector<std::string>& chords) {
    for (const std::string& chord : chords) {
      session_.handle(KeyPress{chord});
    }
  }
  /// The vertices at an x of the lattice at rest.
  void select_x(double x) {
    session_.select_all(false);
    const View view = session_.view();
    for (const glm::dvec3& point : session_.shown_points()) {
      if (point.x == x) {
        const glm::dvec2 at(view.project(point));
        session_.handle(MousePress{MouseButton::Left, at, {.shift = true}});
        session_.handle(MouseRelease{MouseButton::Left, at});
      }
    }
    ASSERT_FALSE(session_.selection().empty());
  }
  [[nodiscard]] const BentModel& bent() const { return session_.bent_models().all().at(path_); }
  [[nodiscard]] std::vector<glm::vec3> positions() const {
    return {bent().positions().begin(), bent().positions().end()};
  }
  [[nodiscard]] std::vector<glm::vec3> normals() const {
    return {bent().normals().begin(), bent().normals().end()};
  }
  static double farthest(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      most = std::max(most, double(glm::distance(a[i], b[i])));
    }
    return most;
  }
  /// What a transform shows while it lasts is what its operation makes of the model.
  void expect_drag_is_operation(const std::vector<std::string>& chords) {
    press(chords);
    ASSERT_TRUE(session_.transform());
    const std::vector<glm::vec3> dragged = positions();
    const std::vector<glm::vec3> turned = normals();
    const std::size_t n_before = session_.journal().text().size();
    press({"enter"});
    ASSERT_GT(session_.journal().text().size(), n_before);
    EXPECT_LE(farthest(dragged, positions()), 4e-6);
    EXPECT_LE(farthest(turned, normals()), 1e-4);
  }

  std::string path_;
  Session session_;
};

TEST_F(BentModelTest, dragging_moves_the_model_as_the_operation_does) {
  select_x(4);
  const std::vector<glm::vec3> before = positions();
  expect_drag_is_operation({"g", "z", "0", ".", "7"});
  EXPECT_GE(farthest(before, positions()), 0.3);
  expect_drag_is_operation({"r", "x", "3", "0"});
  expect_drag_is_operation({"s", "1", ".", "4"});
  expect_drag_is_operation({"o", "g", "y", "0", ".", "3"});
  expect_drag_is_operation({"r", "x", "2", "0"});
  expect_drag_is_operation({"s", "shift+x", "0", ".", "8"});
  expect_drag_is_operation({"o", "shift+y", "g", "y", "0", ".", "1"});
}

TEST_F(BentModelTest,
       parts_that_turn_about_their_own_middles_move_the_model_as_the_operation_does) {
  select_x(0);
  const Selection first = session_.selection();
  Handling handling = session_.handling();
  handling.pivot = Pivot::Individual;
  session_.set_handling(handling);
  press({"ctrl+i"});  // the other ends of the first cells come along: all but x = 0
  const std::vector<glm::vec3> before = positions();
  expect_drag_is_operation({"r", "x", "2", "0"});
  expect_drag_is_operation({"s", "1", ".", "2"});
  EXPECT_GE(farthest(before, positions()), 0.2);
  press({"o"});
  expect_drag_is_operation({"r", "x", "1", "0"});
  expect_drag_is_operation({"s", "0", ".", "9"});
}

TEST_F(BentModelTest, positions_after_an_operation_are_those_of_the_saved_model) {
  select_x(4);
  press({"g", "z", "0", ".", "7", "enter"});
  const Scene scene =
      apply(parse_call("deform model=\"" + path_ + "\" lattice=bar output=bent"), session_.scene());
  const auto saved = model_in(scene, "bent").points();
  const auto& points = bent().drawing().vertex_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Written at the file's precision.
    EXPECT_LE(glm::distance(bent().positions()[i],
                            glm::vec3(saved[points[i]] - session_.view().frame.origin)),
              1e-6);
  }
}

TEST_F(BentModelTest, a_preview_of_a_pose_bends_the_model_as_the_operation_does_and_goes_back) {
  const std::vector<glm::vec3> before = positions();
  const std::string call = "pose twist lattice=bar from=0,1,1 to=4,1,1 angle=40";
  session_.preview(parse_call(call + " output=bar"));
  ASSERT_TRUE(session_.shown_preview().error.empty()) << session_.shown_preview().error;
  const std::vector<glm::vec3> previewed = positions();
  EXPECT_GE(farthest(before, previewed), 0.3);
  EXPECT_TRUE(std::ranges::equal(lattice_in(session_.scene(), "bar").rest_points(),
                                 lattice_in(session_.scene(), "bar").posed_points()));
  session_.end_preview();
  EXPECT_EQ(positions(), before);
  session_.preview(parse_call(call + " output=bar"));
  select_x(4);
  press({"g", "x", "0", "escape"});  // hands go on from where the lattice is
  EXPECT_EQ(positions(), before);
  session_.preview(parse_call(call + " output=bar"));
  session_.run_form(parse_call(call + " output=bar"));
  EXPECT_EQ(positions(), previewed);
}

TEST_F(BentModelTest, a_preview_does_not_outlive_what_it_was_made_from) {
  session_.preview(parse_call("pose twist lattice=bar from=0,1,1 to=4,1,1 angle=40 output=bar"));
  while (session_.journal().can_undo()) {
    session_.undo();
  }
  EXPECT_TRUE(session_.bent_models().all().empty());
}

TEST_F(BentModelTest, a_preview_of_another_lattice_or_of_nothing_bends_no_model) {
  const std::vector<glm::vec3> before = positions();
  for (const char* line :
       {"pose twist lattice=bar from=0,1,1 to=4,1,1 angle=40 output=other", "new box output=bar2",
        "pose twist lattice=bar from=0,1,1 to=0,1,1 "
        "angle=40 output=bar"}) {
    session_.preview(parse_call(line));
    EXPECT_EQ(positions(), before) << line;
  }
  EXPECT_FALSE(session_.shown_preview().error.empty());
}

TEST_F(BentModelTest, escape_brings_the_model_back_bit_for_bit) {
  select_x(4);
  press({"g", "z", "0", ".", "3", "enter"});
  const std::vector<glm::vec3> before = positions();
  press({"g", "y", "0", ".", "2"});
  EXPECT_NE(positions(), before);
  press({"escape"});
  EXPECT_EQ(positions(), before);
}

TEST_F(BentModelTest, a_drag_stops_before_space_folds_and_so_does_the_lattice) {
  select_x(4);
  press({"g", "x", "-", "9"});
  EXPECT_LT(session_.done_fraction(), 1);
  const std::span<const glm::dvec3> shown = session_.shown_points();
  const double way = 9 * session_.done_fraction();
  for (const std::int32_t vertex : session_.selection()) {
    EXPECT_NEAR(shown[static_cast<std::size_t>(vertex)].x, 4 - way, 1e-12);
  }
  press({"enter"});
  const auto folded = bent().folded();
  EXPECT_EQ(std::count(folded.begin(), folded.end(), 1), 0);
}

TEST_F(BentModelTest, without_the_stop_it_goes_on_and_folded_points_are_marked) {
  press({"shift+f"});
  select_x(4);
  press({"g", "x", "-", "9"});
  EXPECT_EQ(session_.done_fraction(), 1);
  const std::vector<std::uint8_t> marked(bent().folded().begin(), bent().folded().end());
  EXPECT_GT(std::count(marked.begin(), marked.end(), 1), 0);
  press({"enter"});
  EXPECT_TRUE(std::ranges::equal(marked, bent().folded()));
}

TEST_F(BentModelTest, a_motion_that_is_no_fast_drag_stops_as_the_fast_one) {
  press({"tab", "tab", "tab"});
  select_x(4);
  press({"g", "x", "-", "9"});
  const double fast = session_.done_fraction();
  press({"escape", "shift+z", "g", "x", "-", "9"});  // both sides are selected: nothing changes
  EXPECT_LT(fast, 1);
  EXPECT_NEAR(session_.done_fraction(), fast, 1e-6);
}

TEST_F(BentModelTest, only_ranges_that_a_drag_reaches_change) {
  select_x(4);
  press({"g"});
  const std::uint64_t before = bent().revision();
  const std::vector<glm::vec3> at_rest = positions();
  press({"z", "0", ".", "5"});
  const std::vector<VertexRange> ranges = bent().changed_since(before);
  ASSERT_FALSE(ranges.empty());
  std::vector<bool> is_in_range(at_rest.size(), false);
  for (const VertexRange& range : ranges) {
    std::fill_n(is_in_range.begin() + static_cast<std::ptrdiff_t>(range.first), range.count, true);
  }
  for (std::size_t i = 0; i < at_rest.size(); ++i) {
    EXPECT_TRUE(is_in_range[i] || bent().positions()[i] == at_rest[i]);
  }
  EXPECT_TRUE(bent().changed_since(bent().revision()).empty());
  EXPECT_EQ(bent().changed_since(0), (std::vector<VertexRange>{{0, at_rest.size()}}));
}

TEST_F(BentModelTest, two_lattices_bend_a_model_together_while_one_is_dragged) {
  session_.run_line("new bspline counts=4,4,4 max=4,2,2 output=grid");
  session_.choose_lattice("grid");
  session_.bind();
  press({"a"});
  expect_drag_is_operation({"s", "z", "1", ".", "5"});
  session_.choose_lattice("bar");
  select_x(4);
  expect_drag_is_operation({"g", "z", "0", ".", "4"});
}

TEST_F(BentModelTest, strength_and_weights_of_points_are_followed_by_drags_and_operations) {
  const std::string file = ::testing::TempDir() + "/espalier_bent_weights.txt";
  std::string weights;
  for (int i = 0; i < 1600; ++i) {
    weights += i % 3 == 0 ? "0\n" : i % 3 == 1 ? "0.5\n" : "1\n";
  }
  write_file(file, weights);
  press({"a", "g", "z", "1", "enter"});
  const std::vector<glm::vec3> whole = positions();
  session_.run_line("set influence model=\"" + path_ + "\" strength=0.5 weights=\"" + file + "\"");
  const auto& points = bent().drawing().vertex_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double part = 0.25 * (points[i] % 3);
    EXPECT_NEAR(bent().positions()[i].z, whole[i].z - (1 - part), 1e-6);
  }
  select_x(4);
  expect_drag_is_operation({"g", "z", "0", ".", "7"});
  expect_drag_is_operation({"r", "x", "3", "0"});
  expect_drag_is_operation({"o", "r", "x", "2", "0"});
  press({"ctrl+z", "ctrl+z", "ctrl+z", "ctrl+z"});
  EXPECT_EQ(positions(), whole);
}

TEST_F(BentModelTest, a_pose_with_weights_of_its_own_is_dragged_by_evaluation) {
  const std::string file = ::testing::TempDir() + "/espalier_bent_nurbs.json";
  session_.run_line("new nurbs counts=4,4,4 max=4,2,2 output=grid");
  session_.run_line("save name=grid path=\"" + file + "\"");
  std::string text = read_file(file);
  std::string weights = "\"pose_weights\": [2";
  for (int i = 1; i < 64; ++i) {
    weights += i % 3 == 0 ? ", 0.5" : ", 1";
  }
  text.insert(text.rfind('}'), ", " + weights + "]\n");
  write_file(file, text);
  ASSERT_TRUE(session_.open(file)) << session_.messages().back();
  session_.choose_lattice(file);
  session_.bind();
  press({"a"});
  expect_drag_is_operation({"g", "z", "0", ".", "5"});
}

}  // namespace
}  // namespace espalier::viewer
