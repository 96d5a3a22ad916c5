#include "viewer/interact/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <set>
#include <sstream>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "tests/support/temporary_folder.h"
#include "viewer/interact/commands.h"

namespace espalier::viewer {
namespace {

constexpr const char* kModel =
    "v 0.5 0.5 0.5\nv 1.5 0.5 0.5\nv 2.5 0.5 0.5\nv 9 9 9\nf 1 2 3\nf 2 3 4\n";

/// A folder with a bar of three cells along x from 0 to 3, and points along its middle.
class SessionTest : public ::testing::Test {
 protected:
  SessionTest() {
    write_file(path("model.obj"), kModel);
    session_.open(path("model.obj"));
    session_.apply({"new box", Arguments({{"cells", std::vector<std::int64_t>{3, 1, 1}},
                                          {"max", std::vector<double>{3, 1, 1}},
                                          {"output", path("bar.json")}})});
    session_.frame_all();
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }
  void press(const std::vector<std::string>& chords) {
    for (const std::string& chord : chords) {
      session_.handle(KeyPress{chord});
    }
  }
  [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec3& point) const {
    return glm::dvec2(session_.view().project(point));
  }
  void click(const glm::dvec2& at, const Modifiers& held = {}) {
    session_.handle(MousePress{MouseButton::Left, at, held});
    session_.handle(MouseRelease{MouseButton::Left, at});
  }
  [[nodiscard]] const SubdivisionLattice& bar() const {
    return subdivision_lattice_in(session_.scene(), path("bar.json"));
  }
  /// The four vertices at an x, as the box's points tell.
  [[nodiscard]] Selection at_x(double x) const {
    Selection found;
    for (std::size_t i = 0; i < bar().rest.size(); ++i) {
      if (bar().rest[i].x == x) {
        found.insert(static_cast<std::int32_t>(i));
      }
    }
    return found;
  }
  void select_end() {
    press({"kp1"});
    session_.handle(MousePress{MouseButton::Left, pixel_of({3, 1, 1}) + glm::dvec2(-15, -15), {}});
    session_.handle(MouseMove{pixel_of({3, 0, 1}) + glm::dvec2(15, 15)});
    session_.handle(MouseRelease{MouseButton::Left, pixel_of({3, 0, 1}) + glm::dvec2(15, 15)});
    ASSERT_EQ(session_.selection(), at_x(3));
  }

  Session session_;
  test::TemporaryFolder folder_;
};

TEST_F(SessionTest, a_click_selects_the_vertex_under_the_mouse_and_shift_adds_or_takes_it_away) {
  const glm::dvec3 corner(3, 1, 1);
  click(pixel_of(corner));
  ASSERT_EQ(session_.selection().size(), 1u);
  const auto first = static_cast<std::size_t>(*session_.selection().begin());
  EXPECT_EQ(bar().rest[first], corner);
  click(pixel_of({0, 0, 1}), {.shift = true});
  EXPECT_EQ(session_.selection().size(), 2u);
  click(pixel_of(corner), {.shift = true});
  ASSERT_EQ(session_.selection().size(), 1u);
  EXPECT_EQ(bar().rest[static_cast<std::size_t>(*session_.selection().begin())],
            glm::dvec3(0, 0, 1));
  click({2, 2});
  EXPECT_TRUE(session_.selection().empty());
}

TEST_F(SessionTest, a_box_selects_through_the_lattice_or_only_what_is_visible) {
  select_end();
  press({"alt+z"});
  session_.handle(MousePress{MouseButton::Left, {1, 1}, {}});
  session_.handle(MouseRelease{MouseButton::Left, {1279, 799}});
  // Seen from above the bar's right end, only the far lower edge is behind it, but for that end.
  EXPECT_EQ(session_.selection().size(), 13u);
  for (const std::int32_t vertex : session_.selection()) {
    const glm::dvec3 point = bar().rest[static_cast<std::size_t>(vertex)];
    EXPECT_TRUE(point.z == 1 || point.y == 1 || point.x == 3);
  }
}

TEST_F(SessionTest, a_click_on_a_face_anywhere_selects_the_nearest_that_covers_the_place) {
  press({"kp1", "3"});
  click(pixel_of({0.1, 0.1, 1}));
  ASSERT_EQ(session_.selection().size(), 1u);
  for (const std::int32_t vertex : session_.selected_vertices()) {
    const glm::dvec3 point = bar().rest[static_cast<std::size_t>(vertex)];
    EXPECT_TRUE(point.z == 1 && point.x <= 1);
  }
}

TEST_F(SessionTest, what_is_selected_is_kept_as_far_as_another_kind_can_say_it) {
  select_end();
  press({"2"});
  EXPECT_EQ(session_.selection().size(), 4u);
  press({"3"});
  EXPECT_EQ(session_.selection().size(), 1u);
  press({"4"});
  EXPECT_TRUE(session_.selection().empty());
  press({"a"});
  EXPECT_EQ(session_.selection().size(), 3u);
  press({"1"});
  EXPECT_EQ(session_.selection().size(), 16u);
  press({"alt+a"});
  EXPECT_TRUE(session_.selection().empty());
  press({"ctrl+i"});
  EXPECT_EQ(session_.selection().size(), 16u);
}

TEST_F(SessionTest, l_grows_to_what_is_connected_and_alt_click_takes_the_loop_along_the_bar) {
  select_end();
  press({"l"});
  EXPECT_EQ(session_.selection().size(), 16u);
  press({"2"});
  click(0.5 * (pixel_of({1, 1, 1}) + pixel_of({2, 1, 1})), {.alt = true});
  EXPECT_EQ(session_.selection().size(), 3u);
  for (const std::int32_t vertex : session_.selected_vertices()) {
    const glm::dvec3 point = bar().rest[static_cast<std::size_t>(vertex)];
    EXPECT_EQ(glm::dvec2(point.y, point.z), glm::dvec2(1, 1));
  }
}

TEST_F(SessionTest, g_x_1_moves_the_rest_points_in_lattice_mode_and_the_pose_in_pose_mode) {
  select_end();
  press({"g", "x", "1", ".", "5", "enter"});
  EXPECT_TRUE(bar().pose.empty());
  EXPECT_EQ(at_x(4.5).size(), 4u);
  press({"tab", "tab", "g", "y", "-", "2", "enter"});
  ASSERT_EQ(bar().pose.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    const double dy = bar().rest[i].x == 4.5 ? -2 : 0;
    EXPECT_EQ(bar().pose[i], bar().rest[i] + glm::dvec3(0, dy, 0));
  }
}

TEST_F(SessionTest, the_mouse_drags_points_so_that_they_stay_under_it) {
  select_end();
  session_.handle(MouseMove{{600, 300}});
  press({"ctrl+3", "kp5", "g"});
  session_.handle(MouseMove{{640, 260}});
  const std::vector<glm::dvec3> shown(session_.shown_points().begin(),
                                      session_.shown_points().end());
  for (const std::int32_t vertex : session_.selection()) {
    const auto i = static_cast<std::size_t>(vertex);
    const glm::dvec2 by = pixel_of(shown[i]) - pixel_of(bar().rest[i]);
    EXPECT_NEAR(by.x, 40, 1e-9);
    EXPECT_NEAR(by.y, -40, 1e-9);
  }
  click({640, 260});
  EXPECT_TRUE(std::ranges::equal(session_.shown_points(), shown));
  EXPECT_FALSE(session_.transform());
}

TEST_F(SessionTest, r_turns_about_the_middle_and_s_scales_from_it_by_typed_numbers) {
  select_end();
  press({"ctrl+3", "r", "x", "9", "0", "enter"});
  for (const std::int32_t vertex : session_.selection()) {
    const auto i = static_cast<std::size_t>(vertex);
    const glm::dvec3 arm = bar().rest[i] - glm::dvec3(3, 0.5, 0.5);
    EXPECT_LE(glm::length(bar().pose[i] - glm::dvec3(3, 0.5 - arm.z, 0.5 + arm.y)), 1e-15);
  }
  press({"alt+g", "s", "shift+x", "3", "enter"});
  for (const std::int32_t vertex : session_.selection()) {
    const auto i = static_cast<std::size_t>(vertex);
    const glm::dvec3 arm = bar().rest[i] - glm::dvec3(3, 0.5, 0.5);
    EXPECT_EQ(bar().pose[i], glm::dvec3(3, 0.5, 0.5) + 3.0 * arm);
  }
}

TEST_F(SessionTest, escape_and_the_right_button_cancel_a_transform_without_an_entry) {
  const std::string before = session_.journal().text();
  select_end();
  press({"g", "x", "7", "escape", "g", "z", "2"});
  session_.handle(MousePress{MouseButton::Right, {5, 5}, {}});
  EXPECT_FALSE(session_.transform());
  EXPECT_EQ(session_.journal().text(), before);
  press({"g", "x", "backspace", "-", "enter"});  // nothing typed, mouse still: nothing moves
  EXPECT_EQ(session_.journal().text(), before);
}

TEST_F(SessionTest, soft_selection_moves_neighbours_less_and_the_wheel_grows_its_radius) {
  select_end();
  press({"ctrl+3", "o", "g", "z", "1"});
  const auto share = [&](double x) {
    return session_.shown_points()[static_cast<std::size_t>(*at_x(x).begin())].z;
  };
  EXPECT_EQ(share(3), 1);
  EXPECT_EQ(share(0), 0);
  const double before = share(2);
  session_.handle(Scroll{6});
  EXPECT_GT(share(2), before);
  EXPECT_LT(share(2), 1);
}

TEST_F(SessionTest, e_grows_cells_from_faces_along_their_normal_or_an_axis_and_selects_the_ends) {
  select_end();
  press({"e", "1", "enter"});
  ASSERT_EQ(bar().rest.size(), 20u) << session_.messages().front();
  EXPECT_EQ(session_.selected_vertices(), at_x(4));
  press({"e", "x", "2"});
  EXPECT_EQ(session_.ghost().size(), 16u);
  EXPECT_EQ(session_.ghost()[1].x, 6);
  press({"enter"});
  EXPECT_EQ(session_.selected_vertices(), at_x(6));
  EXPECT_EQ(bar().complex->n_cells(), 5u);
  press({"ctrl+z"});
  EXPECT_EQ(bar().complex->n_cells(), 4u);
}

TEST_F(SessionTest, the_mouse_extrudes_along_the_normal_so_that_the_end_follows_it) {
  select_end();
  press({"kp5"});
  session_.handle(MouseMove{pixel_of({3, 0.5, 0.5})});
  press({"e"});
  session_.handle(MouseMove{pixel_of({3.75, 0.5, 0.5})});
  EXPECT_NEAR(session_.ghost()[1].x, 3.75, 1e-9);
}

TEST_F(SessionTest, binding_says_how_many_points_are_inside_and_posing_keeps_it) {
  press({"b"});
  const auto bound = session_.scene().bound.at({path("model.obj"), path("bar.json")});
  EXPECT_EQ(bound.binding->counts().inside, 3u);
  EXPECT_EQ(bound.binding->counts().outside, 1u);
  session_.set_mode(Mode::Pose);
  select_end();
  press({"g", "y", "1", "enter"});
  EXPECT_EQ(session_.scene().bound.at({path("model.obj"), path("bar.json")}).binding,
            bound.binding);
  session_.set_mode(Mode::Lattice);
  press({"g", "y", "1", "enter"});
  EXPECT_TRUE(session_.scene().bound.empty());
}

TEST_F(SessionTest, undo_to_the_start_and_redo_save_the_same_bytes) {
  press({"b", "ctrl+3"});
  select_end();
  press({"g", "y", "1", "enter", "r", "z", "3", "0", "enter", "ctrl+s"});
  const std::string model = read_file(path("model_bent.obj"));
  const std::string lattice = read_file(path("bar_bent.json"));
  const std::string text = session_.journal().text();
  EXPECT_NE(model, kModel);
  EXPECT_FALSE(session_.journal().is_changed());
  for (int i = 0; i < 20; ++i) {
    press({"ctrl+z"});
  }
  EXPECT_TRUE(session_.scene().models.empty());
  EXPECT_TRUE(session_.scene().lattices.empty());
  EXPECT_EQ(session_.lattice(), "");
  for (int i = 0; i < 20; ++i) {
    press({"ctrl+shift+z"});
  }
  EXPECT_EQ(session_.journal().text(), text);
  press({"ctrl+s"});
  EXPECT_EQ(read_file(path("model_bent.obj")), model);
  EXPECT_EQ(read_file(path("bar_bent.json")), lattice);
}

TEST_F(SessionTest, saving_writes_the_pose_of_every_lattice_that_bends_a_model) {
  press({"b"});
  ASSERT_TRUE(
      session_.apply(parse_call("new box min=-9,-9,-9 max=9,9,9 output=" + path("second.json"))));
  session_.choose_lattice(path("second.json"));
  press({"b", "ctrl+3", "1", "a", "g", "y", "1", "enter"});
  session_.choose_lattice(path("bar.json"));
  press({"ctrl+s"});
  EXPECT_TRUE(std::filesystem::exists(path("bar_bent.json")));
  EXPECT_NE(read_file(path("second_bent.json")).find("\"pose\""), std::string::npos);
}

TEST_F(SessionTest, saving_elsewhere_spares_the_model_and_asks_before_it_replaces) {
  press({"b", "ctrl+3"});
  select_end();
  press({"g", "y", "1", "enter"});
  session_.save_as(path("model.obj"), path("model.obj"));
  EXPECT_EQ(read_file(path("model.obj")), kModel);
  EXPECT_NE(session_.messages().back().find("is the model as it was opened"), std::string::npos);
  session_.save_as(path("bar.json"), "");
  EXPECT_EQ(session_.messages().back(), "Type the name of the file to write first.");
  std::ofstream(path("other.obj")) << "mine";
  session_.save_as(path("model.obj"), path("other.obj"));
  EXPECT_EQ(read_file(path("other.obj")), "mine");
  session_.save_as(path("model.obj"), path("other.obj"));
  EXPECT_EQ(session_.messages().back(), "Saved " + path("other.obj") + ".");
  press({"ctrl+s"});
  EXPECT_EQ(read_file(path("other.obj")), read_file(path("model_bent.obj")));
}

TEST_F(SessionTest, recovery_writes_no_file_again) {
  press({"b", "ctrl+3"});
  select_end();
  press({"g", "y", "1", "enter", "ctrl+s"});
  const std::string text = session_.journal().text();
  std::ofstream(path("model_bent.obj")) << "mine";
  Session other;
  EXPECT_TRUE(other.recover(text));
  EXPECT_EQ(read_file(path("model_bent.obj")), "mine");
  EXPECT_EQ(other.scene().bound.size(), 1u);
}

TEST_F(SessionTest, a_lock_holds_while_points_are_dragged_and_in_what_is_saved) {
  press({"b", "ctrl+3", "1", "a"});
  const Arguments lock(
      {{"model", path("model.obj")}, {"lattice", path("bar.json")}, {"lock", std::string("C0")}});
  ASSERT_TRUE(session_.apply({"set lock", lock})) << session_.messages().back();
  const auto& model = [&]() -> const BentModel& {
    return session_.bent_models().all().at(path("model.obj"));
  };
  const std::vector<std::string> steps[] = {{"g", "x", ".", "5"}, {"r", "z", "5"}};
  for (const auto& step : steps) {
    press(step);
    const std::vector<glm::vec3> dragged(model().positions().begin(), model().positions().end());
    press({"enter"});
    for (std::size_t i = 0; i < dragged.size(); ++i) {
      EXPECT_LE(glm::length(dragged[i] - model().positions()[i]), 1e-5F) << i;
    }
  }
  press({"ctrl+s"});
  Arguments how({{"model", path("model.obj")},
                 {"lattice", path("bar.json")},
                 {"output", std::string("locked")}});
  const auto points = [&](const std::string& option) {
    how.set("lock", option);
    const Scene deformed = apply({"deform", how}, session_.scene());
    const auto& moved = model_in(deformed, "locked").points();
    return std::vector<glm::dvec3>(moved.begin(), moved.end());
  };
  const auto saved = apply({"open", Arguments({{"path", path("model_bent.obj")}})}, Scene());
  const auto written = model_in(saved, path("model_bent.obj")).points();
  const std::vector<glm::dvec3> locked = points("C0");
  ASSERT_EQ(written.size(), locked.size());
  for (std::size_t i = 0; i < locked.size(); ++i) {
    EXPECT_LE(glm::length(written[i] - locked[i]), 1e-6) << i;
  }
  ASSERT_TRUE(
      session_.run_line("pose move lattice=\"" + path("bar.json") + "\" about=0,0,0 by=0,0.3,0"));
  EXPECT_NE(points("C0"), points("none"));
}

TEST_F(SessionTest, what_a_lock_keeps_does_not_move_on_the_screen_either) {
  press({"b", "ctrl+3", "1", "a"});
  const std::string names =
      "model=\"" + path("model.obj") + "\" lattice=\"" + path("bar.json") + "\"";
  ASSERT_TRUE(session_.run_line("set lock " + names + " lock=C0"));
  const Selection locked = session_.locked();
  ASSERT_FALSE(locked.empty());
  const auto expect_kept = [&] {
    for (std::size_t i = 0; i < bar().rest.size(); ++i) {
      EXPECT_EQ(session_.shown_points()[i] == bar().rest[i],
                locked.contains(static_cast<std::int32_t>(i)));
    }
  };
  press({"g", "x", "0", ".", "2"});
  expect_kept();
  press({"enter"});
  expect_kept();
  press({"ctrl+z", "s", "3", "-"});  // stopped: space would fold
  EXPECT_LT(session_.done_fraction(), 1);
  for (const std::int32_t control : locked) {
    const auto i = static_cast<std::size_t>(control);
    EXPECT_EQ(session_.shown_points()[i], bar().rest[i]);
  }
  press({"escape"});
  // Poses move them, but they do not count.
  ASSERT_TRUE(
      session_.run_line("pose move lattice=\"" + path("bar.json") + "\" about=0,0,0 by=0,0.3,0"));
  expect_kept();
  press({"alt+a"});
  press({"kp1", "kp5"});
  const glm::dvec2 margin(30, 30);
  session_.handle(MousePress{MouseButton::Left, pixel_of({0, 1, 1}) - margin, {}});
  session_.handle(MouseMove{pixel_of({3, 1, 1}) + margin});
  session_.handle(MouseRelease{MouseButton::Left, pixel_of({3, 1, 1}) + margin});
  ASSERT_EQ(session_.selection(), locked);
  press({"g"});
  EXPECT_FALSE(session_.transform());
  EXPECT_NE(session_.messages().back().find("lock keeps"), std::string::npos);
  ASSERT_TRUE(session_.run_line("set lock " + names + " lock=none"));
  EXPECT_TRUE(session_.locked().empty());
}

TEST_F(SessionTest, binding_again_keeps_the_lock_and_how_it_was_bound) {
  const std::string names =
      "model=\"" + path("model.obj") + "\" lattice=\"" + path("bar.json") + "\"";
  ASSERT_TRUE(session_.run_line("bind " + names + " freeze=uniform:2 outside=falloff:2"));
  ASSERT_TRUE(session_.run_line("set lock " + names + " lock=C1"));
  press({"ctrl+1", "1", "a", "g", "z", "0", ".", "1", "enter"});  // unties it
  ASSERT_TRUE(session_.scene().bound.empty());
  press({"b"});
  ASSERT_EQ(session_.scene().bound.size(), 1u);
  const BoundModel& bound = session_.scene().bound.begin()->second;
  EXPECT_EQ(bound.freeze, "uniform:2");
  EXPECT_EQ(bound.outside, "falloff:2");
  EXPECT_EQ(bound.lock.option, "C1");
  EXPECT_FALSE(bound.lock.controls.empty());
  const std::string journal = session_.journal().text();
  Journal replayed;
  replay(journal, replayed);
  EXPECT_EQ(replayed.scene().bound.begin()->second.lock.option, "C1");
  ASSERT_TRUE(session_.run_line("set lock " + names + " lock=none"));
  press({"b"});
  EXPECT_EQ(session_.scene().bound.begin()->second.lock.option, "none");
}

TEST_F(SessionTest, a_lock_needs_a_binding) {
  EXPECT_FALSE(session_.apply(
      {"set lock", Arguments({{"model", path("model.obj")}, {"lattice", path("bar.json")}})}));
  EXPECT_NE(session_.messages().back().find("bind it first"), std::string::npos);
}

TEST_F(SessionTest, a_journal_replays_to_the_same_scene) {
  press({"b", "ctrl+3"});
  select_end();
  press({"o", "g", "y", "1", "enter", "ctrl+s"});
  const std::string model = read_file(path("model_bent.obj"));
  const std::string lattice = read_file(path("bar_bent.json"));
  std::filesystem::remove(path("model_bent.obj"));
  std::filesystem::remove(path("bar_bent.json"));
  Session other;
  EXPECT_TRUE(other.recover(session_.journal().text())) << other.messages().front();
  EXPECT_FALSE(std::filesystem::exists(path("model_bent.obj")));
  EXPECT_EQ(other.journal().text() + "save deformed model=" + path("model.obj") +
                " path=" + path("model_bent.obj") + "\nsave name=" + path("bar.json") +
                " path=" + path("bar_bent.json") + "\n",
            session_.journal().text());
  other.save();
  EXPECT_EQ(read_file(path("model_bent.obj")), model);
  EXPECT_EQ(read_file(path("bar_bent.json")), lattice);
}

TEST_F(SessionTest, what_cannot_be_done_is_a_message_and_changes_nothing) {
  const std::string before = session_.journal().text();
  EXPECT_FALSE(session_.open(path("nothing.obj")));
  ASSERT_EQ(session_.messages().size(), 1u);
  EXPECT_NE(session_.messages().front().find("nothing.obj"), std::string::npos);
  press({"g"});
  EXPECT_EQ(session_.messages().size(), 2u);
  press({"g"});  // said again, listed once
  EXPECT_EQ(session_.messages().size(), 2u);
  select_end();
  press({"g", "x", "-", "5", "enter"});  // the last cell would be turned inside out
  EXPECT_EQ(session_.messages().size(), 3u);
  EXPECT_EQ(session_.journal().text(), before);
}

TEST_F(SessionTest, n_puts_a_box_round_the_models_and_chooses_it) {
  press({"n", "n"});
  EXPECT_EQ(session_.lattice(), path("lattice2.json"));
  EXPECT_EQ(session_.selection().size(), 8u);
  const Box box = box_of(lattice_in(session_.scene(), path("lattice.json")).rest_points());
  for (const glm::dvec3& point : model_in(session_.scene(), path("model.obj")).points()) {
    EXPECT_TRUE(box.grown(-0.1).contains(point));
  }
}

TEST_F(SessionTest, the_mouse_turns_shifts_and_zooms_the_view) {
  const auto drag = [&](MouseButton button, const Modifiers& held) {
    session_.handle(MousePress{button, {100, 100}, held});
    session_.handle(MouseMove{{150, 130}});
    session_.handle(MouseRelease{button, {150, 130}});
  };
  press({"kp1", "kp5"});
  const glm::dvec2 before = pixel_of({0, 0, 0});
  drag(MouseButton::Middle, {.shift = true});
  EXPECT_LE(glm::length(pixel_of({0, 0, 0}) - before - glm::dvec2(50, 30)), 1e-9);
  drag(MouseButton::Middle, {});
  EXPECT_NEAR(session_.view().camera.angles.azimuth, -20, 1e-9);
  EXPECT_NEAR(session_.view().camera.angles.elevation, 12, 1e-9);
  drag(MouseButton::Left, {.alt = true});
  EXPECT_NEAR(session_.view().camera.angles.azimuth, -40, 1e-9);
  const double size = session_.view().pixel_size({0, 0, 0});
  session_.handle(Scroll{1});
  EXPECT_NEAR(session_.view().pixel_size({0, 0, 0}), 0.88 * size, 1e-12);
  press({"ctrl+kp3", "home"});
  EXPECT_EQ(session_.view().camera.backward(), glm::dvec3(-1, 0, 0));
}

TEST(Commands, every_key_means_one_thing) {
  std::set<std::string> chords;
  for (const Command& command : commands()) {
    std::istringstream words(command.keys);
    for (std::string chord; words >> chord;) {
      EXPECT_TRUE(chords.insert(chord).second) << chord;
    }
  }
}

TEST(Journal, saving_is_no_step_of_undo) {
  Journal journal;
  replay("new box output=a.json\n# a comment\n\nset pose lattice=a.json\n", journal);
  EXPECT_TRUE(journal.is_changed());
  journal.mark_saved();
  const std::string path = ::testing::TempDir() + "/espalier_journal.json";
  journal.apply(parse_call("save name=a.json path=" + path));
  EXPECT_FALSE(journal.is_changed());
  EXPECT_TRUE(journal.undo());
  EXPECT_EQ(journal.text(), "new box output=a.json\n");
  EXPECT_TRUE(journal.is_changed());
  EXPECT_TRUE(journal.redo());
  EXPECT_FALSE(journal.is_changed());
  EXPECT_FALSE(journal.redo());
}

TEST(Journal, names_the_line_that_cannot_be_done_and_keeps_those_before) {
  Journal journal;
  try {
    replay("new box output=a.json\nnew box output=b.json cells=0,1,1\n", journal);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "line 2: 'cells' must be three numbers from 1 to 100000");
  }
  EXPECT_EQ(journal.scene().lattices.size(), 1u);
}

}  // namespace
}  // namespace espalier::viewer
