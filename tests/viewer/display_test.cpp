#include "viewer/app/display.h"

#include <gtest/gtest.h>

#include "lattice/core/file.h"
#include "viewer/render/null_renderer.h"

namespace espalier::viewer {
namespace {

/// Two triangles far apart in a bar of eight cells along x; bound, in Pose mode.
class DisplayTest : public ::testing::Test {
 protected:
  DisplayTest() {
    const std::string path = ::testing::TempDir() + "/espalier_display.obj";
    write_file(path,
               "v .2 .2 .5\nv .4 .2 .5\nv .2 .4 .5\nv 7.5 .2 .5\nv 7.7 .2 .5\nv 7.5 .4 .5\n"
               "f 1 2 3\nf 4 5 6\n");
    session_.open(path);
    session_.apply({"new box", Arguments({{"cells", std::vector<std::int64_t>{8, 1, 1}},
                                          {"max", std::vector<double>{8, 1, 1}},
                                          {"output", std::string("bar")}})});
    session_.frame_all();
    session_.bind();
    session_.set_mode(Mode::Pose);
    display_.update(session_);
  }

  [[nodiscard]] const TriangleMesh& mesh() const {
    for (const auto& [id, content] : renderer_.items()) {
      if (const auto* found = std::get_if<TriangleMesh>(&content)) {
        return *found;
      }
    }
    throw std::runtime_error("no mesh");
  }

  NullRenderer renderer_;
  Display display_{renderer_};
  Session session_;
};

TEST_F(DisplayTest, uploads_nothing_while_nothing_changes) {
  const std::size_t before = renderer_.n_uploaded();
  display_.update(session_);
  EXPECT_EQ(renderer_.n_uploaded(), before);
}

TEST_F(DisplayTest, a_model_follows_its_lattice_and_only_what_moved_is_uploaded) {
  const std::vector<glm::vec3> at_rest = mesh().positions;
  const std::size_t before = renderer_.n_uploaded();
  // The end of the bar, far from the first triangle: vertex 8 is at x = 8.
  session_.apply({"move points", Arguments({{"lattice", std::string("bar")},
                                            {"points", std::vector<std::int64_t>{8}},
                                            {"by", std::vector<double>{0, 0.5, 0}}})});
  display_.update(session_);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh().positions[i], at_rest[i]);
    EXPECT_GT(mesh().positions[i + 3].y, at_rest[i + 3].y);
  }
  const SubdivisionLattice& bar = subdivision_lattice_in(session_.scene(), "bar");
  const std::size_t n_lattice = 2 * bar.complex->n_edges() + bar.rest.size();
  const std::size_t n_rest = 3 * bar.complex->n_edges();  // lines where the lattice was
  EXPECT_LE(renderer_.n_uploaded() - before, n_lattice + n_rest + 3 + 3);
}

TEST_F(DisplayTest, undo_removes_what_is_gone) {
  for (int i = 0; i < 5; ++i) {
    session_.undo();
  }
  display_.update(session_);
  EXPECT_TRUE(renderer_.items().empty());
}

TEST_F(DisplayTest, bind_mode_shows_what_the_lattice_holds) {
  const std::size_t before = renderer_.items().size();
  session_.set_mode(Mode::Bind);
  display_.update(session_);
  ASSERT_EQ(renderer_.items().size(), before + 1);
  const auto& dots = std::get<PointSet>(renderer_.items().rbegin()->second);
  EXPECT_EQ(dots.points.size(), 6u);
  for (const glm::vec3& color : dots.colors) {
    EXPECT_GT(color.g, color.r);
  }
}

TEST_F(DisplayTest, influence_is_shown_of_all_models_of_the_lattice) {
  const std::string path = ::testing::TempDir() + "/espalier_display_other.obj";
  write_file(path, "v 3.2 .2 .5\nv 3.4 .2 .5\nv 3.2 .4 .5\nf 1 2 3\n");
  session_.open(path);
  session_.bind();
  Show show = session_.show();
  show.has_influence = true;
  session_.set_show(show);
  display_.update(session_);
  std::size_t n_dots = 0;
  for (const auto& [id, content] : renderer_.items()) {
    const auto* dots = std::get_if<PointSet>(&content);
    n_dots += dots != nullptr && dots->diameter == 5 ? dots->points.size() : 0;
  }
  EXPECT_EQ(n_dots, 9u);
}

TEST_F(DisplayTest, lattices_of_every_type_are_shown_refined_where_their_points_are_dragged) {
  struct Case {
    const char* line;
    std::size_t n_lines;
  };
  // Lines of grids: of n control points along each axis 3 n² (n − 1).
  for (const Case& each :
       {Case{"new bezier output=a counts=3,3,3", 3 * 16 * 3},  // halved: 4 along each axis
        Case{"new bspline output=a counts=4,4,4 ends=open", 3 * 25 * 4},
        Case{"new thb output=a counts=4,4,4", 3 * 25 * 4}}) {
    session_ = Session();
    ASSERT_TRUE(session_.run_line(each.line)) << session_.messages().back();
    session_.frame_all();
    session_.set_mode(Mode::Pose);
    Show show;
    show.has_cage = false;
    show.refined_levels = 1;
    session_.set_show(show);
    session_.select_all(true);
    Handling handling = session_.handling();
    handling.has_gizmo = false;
    session_.set_handling(handling);
    const auto lines = [&] {
      display_.update(session_);
      std::vector<LineSet> found;
      for (const auto& [id, content] : renderer_.items()) {
        if (const auto* set = std::get_if<LineSet>(&content)) {
          found.push_back(*set);
        }
      }
      return found;
    };
    const std::vector<LineSet> before = lines();
    ASSERT_EQ(before.size(), 1u) << each.line;
    EXPECT_EQ(before[0].points.size(), 2 * each.n_lines) << each.line;
    const std::size_t n_uploaded = renderer_.n_uploaded();
    display_.update(session_);
    EXPECT_EQ(renderer_.n_uploaded(), n_uploaded);
    for (const char* key : {"g", "x", "2"}) {
      session_.handle(KeyPress{key});
    }
    const std::vector<LineSet> after = lines();
    const auto scale = static_cast<float>(session_.view().frame.scale);
    for (std::size_t i = 0; i < before[0].points.size(); ++i) {
      const glm::vec3 moved = after[0].points[i] - before[0].points[i];
      EXPECT_LE(glm::distance(moved, glm::vec3(2 * scale, 0, 0)), 1e-5F);
    }
  }
}

TEST_F(DisplayTest, levels_of_a_hierarchy_are_shown_refined_or_not) {
  session_ = Session();
  ASSERT_TRUE(session_.run_line("new thb output=a counts=5,5,5"));
  ASSERT_TRUE(session_.run_line("refine input=a box=0,0,0,0.5,1,1 output=a"));
  session_.frame_all();
  const auto n_points = [&](const std::set<std::int32_t>& hidden) {
    Show show;
    show.has_cage = false;
    show.refined_levels = 1;
    show.hidden_levels = hidden;
    session_.set_show(show);
    display_.update(session_);
    std::size_t n = 0;
    for (const auto& [id, content] : renderer_.items()) {
      if (const auto* lines = std::get_if<LineSet>(&content)) {
        n += lines->points.size();
      }
    }
    return n;
  };
  const std::size_t coarse = n_points({1});
  const std::size_t fine = n_points({0});
  EXPECT_GT(coarse, 0u);
  EXPECT_GT(fine, coarse);
  EXPECT_EQ(n_points({}), coarse + fine);
  EXPECT_EQ(n_points({0, 1}), 0u);
}

TEST_F(DisplayTest, the_cursor_is_shown_where_it_was_placed) {
  const std::size_t before = renderer_.items().size();
  session_.set_cursor(glm::dvec3(1, 2, 3));
  display_.update(session_);
  ASSERT_EQ(renderer_.items().size(), before + 1);
  const auto& lines = std::get<LineSet>(renderer_.items().rbegin()->second);
  glm::vec3 middle(0);
  for (const glm::vec3& point : lines.points) {
    middle += point / static_cast<float>(lines.points.size());
  }
  const glm::vec3 expected(session_.view().frame.to_drawing({1, 2, 3}));
  EXPECT_LE(glm::distance(middle, expected), 1e-5F);
  session_.set_cursor(std::nullopt);
  display_.update(session_);
  EXPECT_EQ(renderer_.items().size(), before);
}

}  // namespace
}  // namespace espalier::viewer
