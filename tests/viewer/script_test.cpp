#include "viewer/interact/script.h"

#include <gtest/gtest.h>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

template <class Kind>
Kind only_event(const char* line) {
  const std::vector<ScriptStep> steps = parse_script_line(line);
  EXPECT_EQ(steps.size(), 1u) << line;
  return std::get<Kind>(std::get<Event>(steps.at(0)));
}

TEST(Script, reads_keys_one_after_the_other) {
  const std::vector<ScriptStep> steps = parse_script_line("key g shift+x enter");
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(std::get<KeyPress>(std::get<Event>(steps[1])).chord, "shift+x");
}

TEST(Script, reads_the_mouse) {
  EXPECT_EQ(only_event<MouseMove>("move 3 4.5").at, glm::dvec2(3, 4.5));
  const auto press = only_event<MousePress>("press middle 1 2 shift alt");
  EXPECT_EQ(press.button, MouseButton::Middle);
  EXPECT_TRUE(press.held.shift && press.held.alt && !press.held.ctrl);
  EXPECT_EQ(only_event<MouseRelease>("release right 5 6").at, glm::dvec2(5, 6));
  EXPECT_EQ(only_event<Scroll>("scroll -2").steps, -2);
  EXPECT_EQ(parse_script_line("click left 1 2").size(), 2u);
}

TEST(Script, reads_text_operations_and_nothing) {
  EXPECT_EQ(only_event<TextInput>("type a  b").text, "a  b");
  const std::vector<ScriptStep> steps = parse_script_line("new box output=a.json");
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(std::get<OperationCall>(steps[0]).operation, "new box");
  EXPECT_TRUE(parse_script_line("").empty());
  EXPECT_TRUE(parse_script_line("# a comment").empty());
}

TEST(Script, reads_names_of_pictures) {
  const std::vector<ScriptStep> steps = parse_script_line("picture leg");
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(std::get<PictureStep>(steps[0]).name, "leg");
}

TEST(Script, refuses_what_it_cannot_read) {
  for (const char* line : {"press nose 1 2", "move 1", "click left 1 2 meta", "scroll far", "dance",
                           "picture", "picture ../a", "new box output"}) {
    EXPECT_THROW((void)parse_script_line(line), Error) << line;
  }
}

}  // namespace
}  // namespace espalier::viewer
