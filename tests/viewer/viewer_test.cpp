#include "viewer/app/viewer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lattice/core/file.h"
#include "viewer/render/offscreen_context.h"
#include "viewer/render/opengl_objects.h"

namespace espalier::viewer {
namespace {

/// A frame buffer instead of a window's.
class Canvas {
 public:
  Canvas() {
    glBindRenderbuffer(GL_RENDERBUFFER, color_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 800, 600);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  }

 private:
  GlRenderbuffer color_;
  GlFramebuffer frame_;
};

/// A square with a box of one cell round it; every task draws a frame of its own.
class ViewerTest : public ::testing::Test {
 protected:
  ViewerTest()
      : viewer_(Progress([this](std::string_view task, double fraction) {
          ++n_task_frames_;
          return !viewer_.draw_task(task, fraction);
        })) {
    const std::string path = ::testing::TempDir() + "/espalier_viewer.obj";
    write_file(path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    viewer_.handle(Resize{800, 600});
    viewer_.open(path);
    viewer_.session().run_line("new box output=a min=-1,-1,-1 max=2,2,1");
    settle();
  }

  void settle() {
    viewer_.update(0.1);
    viewer_.update(0.1);
  }
  void click(const glm::dvec2& at) {
    viewer_.handle(MouseMove{at});
    settle();
    viewer_.handle(MousePress{MouseButton::Left, at, {}});
    settle();
    viewer_.handle(MouseRelease{MouseButton::Left, at});
    settle();
  }

  OffscreenContext context_;
  Canvas canvas_;
  int n_task_frames_ = 0;
  Viewer viewer_;
};

TEST_F(ViewerTest, a_task_that_a_button_began_shows_how_far_it_is) {
  viewer_.session().set_mode(Mode::Bind);
  settle();
  for (double y = 136; y < 220 && viewer_.session().scene().bound.empty(); y += 12) {
    click({120, y});
  }
  EXPECT_FALSE(viewer_.session().scene().bound.empty());
  EXPECT_GT(n_task_frames_, 0);
}

TEST_F(ViewerTest, the_button_beside_a_progress_bar_stops_the_task) {
  const glm::dvec2 stop(400 + 130, 300 + 14);
  EXPECT_FALSE(viewer_.draw_task("freezing", 0.3));
  EXPECT_FALSE(viewer_.stops_task(MouseMove{stop}));
  EXPECT_FALSE(viewer_.draw_task("freezing", 0.3));
  EXPECT_FALSE(viewer_.stops_task(MousePress{MouseButton::Left, stop, {}}));
  EXPECT_FALSE(viewer_.draw_task("freezing", 0.3));
  EXPECT_FALSE(viewer_.stops_task(MouseRelease{MouseButton::Left, stop}));
  EXPECT_TRUE(viewer_.draw_task("freezing", 0.3));
  EXPECT_FALSE(viewer_.draw_task("freezing", 0.3));
}

TEST_F(ViewerTest, escape_stops_a_task_and_other_keys_do_not) {
  EXPECT_FALSE(viewer_.stops_task(KeyPress{"g"}));
  EXPECT_TRUE(viewer_.stops_task(KeyPress{"escape"}));
}

TEST_F(ViewerTest, a_digit_takes_an_entry_of_the_menu_that_a_key_opened) {
  viewer_.handle(KeyPress{"."});
  settle();
  viewer_.handle(KeyPress{"3"});
  settle();
  EXPECT_EQ(viewer_.session().handling().pivot, Pivot::Individual);
  viewer_.handle(KeyPress{"3"});  // faces: no menu is open
  EXPECT_EQ(viewer_.session().element_kind(), ElementKind::Face);
  viewer_.handle(KeyPress{"shift+s"});
  viewer_.handle(KeyPress{"escape"});
  viewer_.handle(KeyPress{"1"});
  EXPECT_EQ(viewer_.session().element_kind(), ElementKind::Vertex);
  EXPECT_FALSE(viewer_.session().cursor());
}

TEST_F(ViewerTest, sessions_that_did_not_end_well_are_offered_until_one_is_chosen_or_escape) {
  viewer_.offer({"yesterday   3 steps   /here", "today   1 step   /there"});
  settle();
  EXPECT_TRUE(viewer_.is_offering());
  EXPECT_FALSE(viewer_.take_recovered());
  click({400 - 640 / 2 + 30, 300 - 240 / 2 + 64});  // the second row
  const auto chosen = viewer_.take_recovered();
  ASSERT_TRUE(chosen);
  EXPECT_EQ(*chosen, 1u);
  EXPECT_FALSE(viewer_.take_recovered());
  EXPECT_FALSE(viewer_.take_thrown_away());
  click({400 - 640 / 2 + 100, 300 - 240 / 2 + 39});  // the first row's other button
  EXPECT_EQ(viewer_.take_thrown_away(), std::optional<std::size_t>(0));
  viewer_.handle(KeyPress{"escape"});
  EXPECT_FALSE(viewer_.is_offering());
}

TEST_F(ViewerTest, while_points_move_a_point_is_typed) {
  for (const char* key : {"1", "a", "g", "x", ".", "5", "enter"}) {
    viewer_.handle(KeyPress{key});
  }
  EXPECT_EQ(lattice_in(viewer_.session().scene(), "a").rest_points()[0].x, -0.5);
}

}  // namespace
}  // namespace espalier::viewer
