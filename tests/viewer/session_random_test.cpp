/// Whatever hands do, a session stays whole.

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "lattice/core/file.h"
#include "viewer/app/display.h"
#include "viewer/interact/commands.h"
#include "viewer/render/null_renderer.h"

namespace espalier::viewer {
namespace {

/// Random keys, clicks and drags; the same for a seed.
class Hands {
 public:
  Hands(Session& session, unsigned seed) : session_(session), random_(seed) {
    for (const Preset preset : {Preset::Blender, Preset::Maya}) {
      for (const Command& command : commands(preset)) {
        std::istringstream words(command.keys);
        for (std::string chord; words >> chord;) {
          if (chord != "ctrl+s") {
            chords_.push_back(chord);
          }
        }
      }
    }
    for (const char* chord : {"x", "y", "z", "0", "1", "2", ".", "-", "backspace", "enter", "enter",
                              "escape", "g", "g", "r", "s", "e"}) {
      chords_.emplace_back(chord);
    }
  }

  void act() {
    switch (random_() % 6) {
      case 0:
        session_.handle(MouseMove{place()});
        break;
      case 1:
        session_.handle(MousePress{button(), place(), held()});
        break;
      case 2:
        session_.handle(MouseRelease{button(), place()});
        break;
      case 3:
        session_.handle(Scroll{random_() % 2 == 0 ? 1.0 : -1.0});
        break;
      default:
        session_.handle(KeyPress{chords_[random_() % chords_.size()]});
    }
  }

 private:
  glm::dvec2 place() { return {double(random_() % 1280), double(random_() % 800)}; }
  MouseButton button() { return static_cast<MouseButton>(random_() % 3); }
  Modifiers held() { return {random_() % 4 == 0, random_() % 4 == 0, random_() % 4 == 0}; }

  Session& session_;
  std::mt19937 random_;
  std::vector<std::string> chords_;
};

void expect_whole(const Session& session) {
  const std::size_t n = session.lattice().empty()
                            ? 0
                            : lattice_in(session.scene(), session.lattice()).rest_points().size();
  ASSERT_EQ(session.shown_points().size(), n);
  ASSERT_EQ(session.visible().vertices.size(), n);
  for (const std::int32_t element : session.selection()) {
    ASSERT_LT(static_cast<std::size_t>(element), session.elements().count(session.element_kind()));
  }
}

class SessionRandomTest : public ::testing::TestWithParam<const char*> {};

TEST_P(SessionRandomTest, keys_and_mouse_in_any_order_leave_it_whole_and_can_be_undone) {
  const std::string path = ::testing::TempDir() + "/espalier_random.obj";
  write_file(path, "v 0.2 0.2 0.5\nv 0.8 0.2 0.5\nv 0.5 0.8 0.4\nv 3 3 3\nf 1 2 3\nf 2 3 4\n");
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Session session;
    NullRenderer renderer;
    Display display(renderer);
    session.open(path);
    ASSERT_TRUE(session.run_line(GetParam())) << session.messages().back();
    session.frame_all();
    session.bind();
    session.select_all(true);
    Hands hands(session, seed);
    for (int i = 0; i < 150; ++i) {
      hands.act();
      expect_whole(session);
      display.update(session);
    }
    session.handle(KeyPress{"escape"});
    session.set_cursor(std::nullopt);
    while (session.journal().can_undo()) {
      session.undo();
      expect_whole(session);
    }
    EXPECT_TRUE(session.scene().models.empty() && session.scene().lattices.empty());
    display.update(session);
    EXPECT_TRUE(renderer.items().empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Lattices, SessionRandomTest,
                         ::testing::Values("new box output=a cells=2,2,1",
                                           "new cylinder output=a from=0,0,0 to=0,0,1 radius=1",
                                           "new nurbs output=a counts=4,4,4",
                                           "new thb output=a counts=4,4,4"));

}  // namespace
}  // namespace espalier::viewer
