/// Sessions: handles, presets, pivots, symmetry, hiding, previews, lattices of all types.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/interact/session.h"

namespace espalier::viewer {
namespace {

class SessionHandlingTest : public ::testing::Test {
 protected:
  void make(const std::string& line) {
    ASSERT_TRUE(session_.run_line(line)) << session_.messages().back();
    session_.frame_all();
    press({"kp1"});
  }
  void press(const std::vector<std::string>& chords) {
    for (const std::string& chord : chords) {
      session_.handle(KeyPress{chord});
    }
  }
  [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec3& point) const {
    return glm::dvec2(session_.view().project(point));
  }
  void drag(const glm::dvec2& from, const glm::dvec2& to) {
    session_.handle(MouseMove{from});
    session_.handle(MousePress{MouseButton::Left, from, {}});
    session_.handle(MouseMove{to});
    session_.handle(MouseRelease{MouseButton::Left, to});
  }
  void click(const glm::dvec3& point, bool adds = false) {
    session_.handle(MousePress{MouseButton::Left, pixel_of(point), {.shift = adds}});
    session_.handle(MouseRelease{MouseButton::Left, pixel_of(point)});
  }
  [[nodiscard]] const Lattice& lattice() const {
    return lattice_in(session_.scene(), session_.lattice());
  }
  [[nodiscard]] std::vector<glm::dvec3> moves() const {
    std::vector<glm::dvec3> moves;
    for (std::size_t i = 0; i < lattice().rest_points().size(); ++i) {
      moves.push_back(lattice().posed_points()[i] - lattice().rest_points()[i]);
    }
    return moves;
  }

  Session session_;
};

TEST_F(SessionHandlingTest, lattices_of_every_type_are_posed_by_their_control_points) {
  for (const char* line : {"new bezier output=a", "new bspline output=a counts=4,3,1 degree=3,2,0",
                           "new nurbs output=a", "new thb output=a counts=4,4,4"}) {
    session_ = Session();
    make(line);
    press({"ctrl+3", "a", "g", "x", "2", "enter"});
    for (const glm::dvec3& move : moves()) {
      EXPECT_LE(glm::length(move - glm::dvec3(2, 0, 0)), 1e-14) << line;
    }
    press({"ctrl+z"});
    EXPECT_TRUE(std::ranges::equal(lattice().posed_points(), lattice().rest_points()));
  }
}

TEST_F(SessionHandlingTest, what_only_subdivision_lattices_can_is_said_of_others) {
  make("new bspline output=a");
  press({"3", "a", "e"});
  ASSERT_FALSE(session_.messages().empty());
  EXPECT_NE(session_.messages().back().find("subdivision"), std::string::npos);
  EXPECT_FALSE(session_.transform());
}

TEST_F(SessionHandlingTest,
       an_arrow_of_the_gizmo_moves_along_its_axis_until_the_button_is_released) {
  make("new box output=a");
  press({"ctrl+3", "a"});
  ASSERT_TRUE(session_.gizmo());
  const glm::dvec3 pivot = session_.gizmo()->pivot;
  EXPECT_LE(glm::length(pivot - glm::dvec3(0.5)), 1e-15);
  const glm::dvec2 tip = pixel_of(pivot) + glm::dvec2(70, 0);
  session_.handle(MouseMove{tip});
  ASSERT_TRUE(session_.active_handle());
  EXPECT_EQ(session_.active_handle()->axis, 0);
  const double pixel = session_.view().pixel_size(pivot);
  drag(tip, tip + glm::dvec2(50, 33));
  EXPECT_FALSE(session_.transform());
  for (const glm::dvec3& move : moves()) {
    EXPECT_LE(glm::length(move - glm::dvec3(50 * pixel, 0, 0)), 1e-3 * pixel);
  }
}

TEST_F(SessionHandlingTest, a_click_on_the_gizmo_selects_what_is_behind_it) {
  make("new box output=a cells=2,1,1 max=2,1,1");
  press({"ctrl+3"});
  click({2, 1, 1});
  ASSERT_EQ(session_.selection().size(), 1u);
  const std::string before = session_.journal().text();
  ASSERT_TRUE(session_.gizmo());
  click(session_.gizmo()->pivot);  // the middle handle is there, and so is the point
  EXPECT_FALSE(session_.transform());
  EXPECT_EQ(session_.selection().size(), 1u);
  session_.handle(MouseMove{pixel_of({2, 1, 1})});
  EXPECT_EQ(session_.journal().text(), before);
}

TEST_F(SessionHandlingTest, the_gizmo_shows_what_was_done_last_and_rings_turn) {
  make("new box output=a");
  press({"ctrl+3", "a", "r", "escape"});
  ASSERT_TRUE(session_.gizmo());
  EXPECT_EQ(session_.gizmo()->kind, TransformKind::Turn);
  const glm::dvec2 center = pixel_of(glm::dvec3(0.5));
  drag(center + glm::dvec2(96, 0) * std::sqrt(0.5) * glm::dvec2(1, 0) +
           glm::dvec2(0, -96) * std::sqrt(0.5),
       center + glm::dvec2(0, -96));  // an eighth to the left, seen from +z
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 arm = lattice().rest_points()[i] - 0.5;
    const double c = std::sqrt(0.5);
    const glm::dvec3 expected(0.5 + c * (arm.x - arm.y), 0.5 + c * (arm.x + arm.y), 0.5 + arm.z);
    EXPECT_LE(glm::length(lattice().posed_points()[i] - expected), 1e-9);
  }
}

TEST_F(SessionHandlingTest, keys_as_in_maya_switch_what_the_gizmo_does) {
  make("new box output=a");
  press({"f4", "ctrl+3", "ctrl+shift+a", "e"});
  EXPECT_EQ(session_.gizmo()->kind, TransformKind::Turn);
  press({"r"});
  EXPECT_EQ(session_.gizmo()->kind, TransformKind::Scale);
  press({"w"});
  EXPECT_EQ(session_.gizmo()->kind, TransformKind::Move);
  press({"q"});
  EXPECT_FALSE(session_.gizmo());
  press({"kp5"});
  const glm::dvec2 before = pixel_of({0, 0, 0});
  session_.handle(MousePress{MouseButton::Middle, {100, 100}, {.alt = true}});
  session_.handle(MouseMove{{120, 90}});
  session_.handle(MouseRelease{MouseButton::Middle, {120, 90}});
  EXPECT_GT(pixel_of({0, 0, 0}).x, before.x);
  const double size = session_.view().pixel_size({0, 0, 0});
  session_.handle(MousePress{MouseButton::Right, {100, 100}, {.alt = true}});
  session_.handle(MouseMove{{100, 80}});
  session_.handle(MouseRelease{MouseButton::Right, {100, 80}});
  EXPECT_LT(session_.view().pixel_size({0, 0, 0}), size);
}

TEST_F(SessionHandlingTest, scaling_keeps_the_pivot_that_was_chosen) {
  make("new box output=a");
  press({"ctrl+3", "kp5"});
  session_.look_from("three-quarter");
  click({0, 0, 0}, true);
  click({1, 1, 1}, true);
  press({"shift+.", "s", "3", "enter"});  // about the last selected
  std::vector<glm::dvec3> expected = {{-2, -2, -2}, {1, 1, 1}};
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3& rest = lattice().rest_points()[i];
    if (rest == glm::dvec3(0) || rest == glm::dvec3(1)) {
      EXPECT_LE(glm::length(lattice().posed_points()[i] - expected[rest.x == 0 ? 0 : 1]), 1e-14);
    }
  }
  press({"ctrl+z", "shift+.", "s", "3", "enter"});  // about the origin
  expected = {{0, 0, 0}, {3, 3, 3}};
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3& rest = lattice().rest_points()[i];
    if (rest == glm::dvec3(0) || rest == glm::dvec3(1)) {
      EXPECT_LE(glm::length(lattice().posed_points()[i] - expected[rest.x == 0 ? 0 : 1]), 1e-14);
    }
  }
}

TEST_F(SessionHandlingTest, mirrored_moves_happen_on_the_other_side_too) {
  make("new box output=a cells=2,1,1 min=-1,0,0 max=1,1,1");
  press({"ctrl+3", "shift+x"});
  click({1, 1, 1});
  ASSERT_EQ(session_.selection().size(), 1u);
  press({"g", "x", "0", ".", "5", "enter"});
  for (std::size_t i = 0; i < 12; ++i) {
    const glm::dvec3& rest = lattice().rest_points()[i];
    const bool is_moved = std::abs(rest.x) == 1 && rest.y == 1 && rest.z == 1;
    EXPECT_EQ(moves()[i], glm::dvec3(is_moved ? 0.5 * rest.x : 0, 0, 0));
  }
}

TEST_F(SessionHandlingTest, what_is_hidden_is_not_selected_until_it_is_shown_again) {
  make("new box output=a cells=3,1,1 max=3,1,1");
  press({"4", "a"});
  EXPECT_EQ(session_.selection().size(), 3u);
  session_.handle(MousePress{MouseButton::Left, pixel_of({0.5, 0.5, 0.5}), {}});
  session_.handle(MouseRelease{MouseButton::Left, pixel_of({0.5, 0.5, 0.5})});
  ASSERT_EQ(session_.selection().size(), 1u);
  press({"h"});
  EXPECT_TRUE(session_.selection().empty());
  press({"a"});
  EXPECT_EQ(session_.selection().size(), 2u);
  press({"1", "a"});
  EXPECT_EQ(session_.selection().size(), 12u);
  click({0, 1, 1});
  EXPECT_TRUE(session_.selection().empty());
  press({"alt+h", "a"});
  EXPECT_EQ(session_.selection().size(), 16u);
  press({"shift+c", "a"});  // the cut takes the upper half of the lattice along x
  EXPECT_EQ(session_.selection().size(), 12u);
}

TEST_F(SessionHandlingTest, a_preview_shows_what_would_be_and_is_no_entry) {
  make("new box output=a");
  const std::string before = session_.journal().text();
  session_.preview(parse_call("new box output=b cells=2,1,1"));
  EXPECT_EQ(session_.shown_preview().segments.size(), 2u * 20);
  EXPECT_EQ(session_.journal().text(), before);
  session_.preview(parse_call("new box output=b cells=0,1,1"));
  EXPECT_TRUE(session_.shown_preview().segments.empty());
  EXPECT_NE(session_.shown_preview().error.find("cells"), std::string::npos);
  session_.run_form(parse_call("new box output=b cells=2,1,1"));
  EXPECT_TRUE(session_.shown_preview().error.empty());
  EXPECT_EQ(session_.lattice(), "b");
}

TEST_F(SessionHandlingTest, the_sharpness_of_selected_edges_and_vertices_is_set) {
  make("new box output=a cells=2,1,1 max=2,1,1 sharp=none");
  press({"2"});
  session_.handle(MousePress{MouseButton::Left, pixel_of({1, 0.5, 1}), {}});
  session_.handle(MouseRelease{MouseButton::Left, pixel_of({1, 0.5, 1})});
  ASSERT_EQ(session_.selection().size(), 1u);
  const auto edge = static_cast<std::size_t>(*session_.selection().begin());
  EXPECT_EQ(session_.sharpness(), 0);
  session_.set_sharpness(2.5);
  EXPECT_EQ(session_.elements().edge_sharpness[edge], 2.5F);
  EXPECT_EQ(session_.selection().size(), 1u);
  EXPECT_EQ(session_.sharpness(), 2.5);
}

TEST(Preview, is_stopped_by_its_progress_and_complete_without) {
  const OperationCall call = parse_call("new box cells=2,1,1 output=box.json");
  EXPECT_EQ(preview_of(call, Scene()).segments.size(), 2u * 20u);
  const Scene scene = apply(call, Scene());
  const OperationCall refine = parse_call("refine input=box.json levels=1 output=box.json");
  const Preview stopped =
      preview_of(refine, scene, Progress([](std::string_view, double) { return false; }));
  EXPECT_TRUE(stopped.was_stopped);
  EXPECT_TRUE(stopped.segments.empty() && stopped.error.empty());
  EXPECT_FALSE(preview_of(refine, scene).was_stopped);
}

}  // namespace
}  // namespace espalier::viewer
