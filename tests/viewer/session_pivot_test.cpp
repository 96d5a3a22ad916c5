/// Sessions: what points turn about and scale from, and the cursor.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "deform/scene/operations.h"
#include "lattice/core/file.h"
#include "viewer/interact/commands.h"
#include "viewer/interact/pivot.h"

namespace espalier::viewer {
namespace {

/// A bar of three cells along x from 0 to 3, and a square at z = 0.5 across its middle.
class SessionPivotTest : public ::testing::Test {
 protected:
  SessionPivotTest() {
    const std::string path = ::testing::TempDir() + "/espalier_pivot.obj";
    write_file(path, "v 0.5 0.2 0.5\nv 2.5 0.2 0.5\nv 2.5 0.8 0.5\nv 0.5 0.8 0.5\nf 1 2 3 4\n");
    session_.open(path);
    session_.run_line("new box output=a cells=3,1,1 max=3,1,1");
    session_.frame_all();
    press({"kp1", "kp5"});
  }

  void press(const std::vector<std::string>& chords) {
    for (const std::string& chord : chords) {
      session_.handle(KeyPress{chord});
    }
  }
  [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec3& point) const {
    return glm::dvec2(session_.view().project(point));
  }
  void select_x(double from, double to) {
    session_.handle(
        MousePress{MouseButton::Left, pixel_of({from - 0.1, -0.3, 1}), {.shift = true}});
    session_.handle(MouseMove{pixel_of({to + 0.1, 1.3, 1})});
    session_.handle(MouseRelease{MouseButton::Left, pixel_of({to + 0.1, 1.3, 1})});
  }
  void place_cursor(const glm::dvec2& at) {
    session_.handle(MousePress{MouseButton::Right, at, {.shift = true}});
    session_.handle(MouseRelease{MouseButton::Right, at});
  }
  void choose(Pivot pivot) {
    Handling handling = session_.handling();
    handling.pivot = pivot;
    session_.set_handling(handling);
  }
  void choose(const std::string& name) {
    const auto& all = commands();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Command& command) { return command.name == name; });
    ASSERT_NE(found, all.end());
    found->run(session_);
  }
  [[nodiscard]] const Lattice& lattice() const { return lattice_in(session_.scene(), "a"); }
  /// Where a map takes the control points between two x; the others stay.
  template <class Map>
  void expect_rest(double from, double to, const std::vector<glm::dvec3>& before, const Map& map) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool is_moved = before[i].x >= from && before[i].x <= to;
      const glm::dvec3 expected = is_moved ? map(before[i]) : before[i];
      EXPECT_LE(glm::distance(lattice().rest_points()[i], expected), 1e-14) << i;
    }
  }
  [[nodiscard]] std::vector<glm::dvec3> rest() const {
    return {lattice().rest_points().begin(), lattice().rest_points().end()};
  }

  Session session_;
};

TEST_F(SessionPivotTest, every_part_of_the_selection_scales_about_its_own_middle) {
  choose(Pivot::Individual);
  press({"1"});
  select_x(0, 0);
  select_x(2, 3);
  ASSERT_EQ(session_.selection().size(), 12u);
  const std::vector<glm::dvec3> before = rest();
  press({"s", "0", ".", "5", "enter"});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double x = before[i].x == 0 ? 0 : 2.5;
    const glm::dvec3 middle(x, 0.5, 0.5);
    const glm::dvec3 expected = before[i].x == 1 ? before[i] : middle + 0.5 * (before[i] - middle);
    EXPECT_LE(glm::distance(lattice().rest_points()[i], expected), 1e-14);
  }
}

TEST_F(SessionPivotTest, the_middle_of_the_box_is_not_the_median) {
  press({"1"});
  select_x(0, 1);
  select_x(3, 3);
  const std::vector<glm::dvec3> before = rest();
  choose(Pivot::Box);
  press({"s", "x", "2", "enter"});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double x = before[i].x == 2 ? 2 : 1.5 + 2 * (before[i].x - 1.5);
    EXPECT_NEAR(lattice().rest_points()[i].x, x, 1e-14);
  }
  press({"ctrl+z"});
  choose(Pivot::Median);
  ASSERT_TRUE(session_.gizmo());
  EXPECT_NEAR(session_.gizmo()->pivot.x, 4.0 / 3, 1e-14);
}

TEST_F(SessionPivotTest, shift_and_the_right_button_place_the_cursor_on_the_model_as_it_is_bent) {
  for (const char* projection : {"orthographic", "perspective"}) {
    const glm::dvec3 point(1.7, 0.3, 0.5);
    place_cursor(pixel_of(point));
    ASSERT_TRUE(session_.cursor()) << projection;
    EXPECT_LE(glm::distance(*session_.cursor(), point), 1e-6);
    press({"kp5"});
  }
  press({"b", "ctrl+3", "1", "a", "g", "z", "2", "enter"});
  const glm::dvec3 bent(1.7, 0.3, 2.5);
  place_cursor(pixel_of(bent));
  EXPECT_LE(glm::distance(*session_.cursor(), bent), 1e-6);
}

TEST_F(SessionPivotTest, the_cursor_follows_the_mouse_until_the_button_is_released) {
  session_.handle(MousePress{MouseButton::Right, pixel_of({0.6, 0.5, 0.5}), {.shift = true}});
  const glm::dvec3 end(2.1, 0.4, 0.5);
  session_.handle(MouseMove{pixel_of(end)});
  session_.handle(MouseRelease{MouseButton::Right, pixel_of(end)});
  session_.handle(MouseMove{pixel_of({0.6, 0.5, 0.5})});
  EXPECT_LE(glm::distance(*session_.cursor(), end), 1e-6);
  EXPECT_TRUE(session_.selection().empty());
}

TEST_F(SessionPivotTest, beside_the_models_the_cursor_stays_as_far_away_as_it_was) {
  session_.set_cursor(glm::dvec3(1, 0.5, 2));
  place_cursor(pixel_of({-2, 0.9, 2}));
  EXPECT_LE(glm::distance(*session_.cursor(), glm::dvec3(-2, 0.9, 2)), 1e-12);
}

TEST_F(SessionPivotTest, points_turn_about_the_cursor) {
  choose(Pivot::Cursor);
  session_.set_cursor(glm::dvec3(2, 0, 0));
  press({"1"});
  select_x(3, 3);
  const std::vector<glm::dvec3> before = rest();
  press({"r", "z", "3", "0", "enter"});
  const double c = std::sqrt(0.75);
  expect_rest(3, 3, before, [&](const glm::dvec3& p) {
    return glm::dvec3(2 + c * (p.x - 2) - 0.5 * p.y, 0.5 * (p.x - 2) + c * p.y, p.z);
  });
}

TEST_F(SessionPivotTest, the_cursor_goes_to_what_is_selected_and_the_selection_to_the_cursor) {
  press({"1"});
  select_x(1, 2);
  choose("Snap: cursor to what is selected");
  EXPECT_LE(glm::distance(*session_.cursor(), glm::dvec3(1.5, 0.5, 0.5)), 1e-14);
  session_.set_cursor(*session_.cursor() + glm::dvec3(1.25, 0.5, 0));
  session_.select_all(false);
  select_x(3, 3);
  const std::vector<glm::dvec3> before = rest();
  choose("Snap: selection to the cursor");
  expect_rest(3, 3, before, [](const glm::dvec3& p) { return p + glm::dvec3(-0.25, 0.5, 0); });
  EXPECT_EQ(session_.selection().size(), 4u);
  choose("Snap: cursor to the origin");
  EXPECT_EQ(*session_.cursor(), glm::dvec3(0));
  press({"ctrl+z"});
  EXPECT_EQ(rest(), before);
}

TEST_F(SessionPivotTest, without_a_cursor_or_a_selection_nothing_snaps_and_that_is_said) {
  choose("Snap: selection to the cursor");
  choose("Snap: cursor to what is selected");
  choose("Snap: cursor to what was selected last");
  EXPECT_EQ(session_.messages().size(), 3u);
  EXPECT_FALSE(session_.cursor());
}

TEST_F(SessionPivotTest, forms_begin_with_the_cursor_as_joint_centre_and_mirror_plane) {
  session_.set_cursor(glm::dvec3(1, -0.5, 0.25));
  for (const auto& [operation, parameter] :
       std::vector<std::pair<std::string, std::string>>{{"pose rotate", "about"},
                                                        {"pose bend", "from"},
                                                        {"mirror", "point"},
                                                        {"transform", "about"},
                                                        {"new junction", "center"}}) {
    OperationForm form = form_for(operation_named(operation), session_.form_context());
    const auto field = std::find_if(
        form.fields.begin(), form.fields.end(),
        [&](const FormField& candidate) { return candidate.parameter->name == parameter; });
    ASSERT_NE(field, form.fields.end()) << operation;
    EXPECT_EQ(field->text, "1,-0.5,0.25") << operation;
    EXPECT_TRUE(field->is_place());
  }
}

TEST_F(SessionPivotTest, a_list_of_places_takes_one_after_the_other) {
  OperationForm form = form_for(operation_named("new limb"), session_.form_context());
  FormField& joints = form.fields.front();
  ASSERT_EQ(joints.parameter->name, "joint");
  ASSERT_TRUE(joints.is_place());
  joints.put({0, 1, 0});
  joints.put({0, 2, 0});
  EXPECT_EQ(joints.text, "0,1,0\n0,2,0");
  EXPECT_EQ(form.call().arguments.texts("joint").size(), 2u);
}

TEST(Pivots, islands_are_parts_of_the_selection_that_hang_together) {
  const Scene scene = apply(parse_call("new box output=a cells=4,1,1 max=4,1,1"), Scene());
  const LatticeElements elements = elements_of(lattice_in(scene, "a"));
  const auto points = points_of(scene, "a", Shape::Rest);
  Selection cells = {0, 1, 3};
  std::vector<Selection> found = islands(elements, ElementKind::Cell, cells);
  // Cells 1 and 3 have no vertex in common, 0 and 1 have four.
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].size() + found[1].size(), 20u);
  const std::vector<glm::dvec3> pivots = island_pivots(points, found);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 expected(points[i].x <= 2 ? 1 : 3.5, 0.5, 0.5);
    EXPECT_LE(glm::distance(pivots[i], expected), 1e-15);
  }
  EXPECT_TRUE(islands(elements, ElementKind::Face, {}).empty());
}

TEST(Menus, are_opened_by_keys_and_their_entries_are_commands_too) {
  ASSERT_NE(menu_on("."), nullptr);
  EXPECT_EQ(menu_on("."), menu_on("."));
  ASSERT_NE(menu_on("shift+s"), nullptr);
  EXPECT_EQ(menu_on("g"), nullptr);
  for (const Menu& menu : menus()) {
    for (const Preset preset : {Preset::Blender, Preset::Maya}) {
      const auto& all = commands(preset);
      EXPECT_TRUE(std::none_of(all.begin(), all.end(), [&](const Command& command) {
        return (" " + command.keys + " ").find(" " + menu.key + " ") != std::string::npos;
      })) << menu.key;
      for (const Command& entry : menu.entries) {
        EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Command& command) {
          return command.name == menu.title + ": " + entry.name;
        }));
      }
    }
  }
}

}  // namespace
}  // namespace espalier::viewer
