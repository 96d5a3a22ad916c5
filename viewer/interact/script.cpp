#include "viewer/interact/script.h"

#include <algorithm>
#include <string>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier::viewer {
namespace {

MouseButton button_named(std::string_view name) {
  if (name == "left" || name == "middle" || name == "right") {
    return name == "left"     ? MouseButton::Left
           : name == "middle" ? MouseButton::Middle
                              : MouseButton::Right;
  }
  throw ParameterError("the button is " + quoted(name) + ", must be left, middle or right");
}

glm::dvec2 next_place(TextScanner& words) {
  const double x = words.next_coordinate("x");
  return {x, words.next_coordinate("y")};
}

MousePress next_press(TextScanner& words) {
  MousePress press;
  press.button = button_named(words.next_word());
  press.at = next_place(words);
  for (std::string_view word = words.next_word(); !word.empty(); word = words.next_word()) {
    if (word != "ctrl" && word != "shift" && word != "alt") {
      throw ParameterError(quoted(word) + " is no modifier, must be ctrl, shift or alt");
    }
    (word == "ctrl" ? press.held.ctrl : word == "shift" ? press.held.shift : press.held.alt) = true;
  }
  return press;
}

}  // namespace

std::vector<ScriptStep> parse_script_line(std::string_view line) {
  TextScanner words("script", line, {.comment = '#'});
  if (!words.next_line()) {
    return {};
  }
  const std::string_view what = words.next_word();
  std::vector<ScriptStep> steps;
  if (what == "key") {
    for (std::string_view key = words.next_word(); !key.empty(); key = words.next_word()) {
      steps.push_back(Event(KeyPress{std::string(key)}));
    }
  } else if (what == "move") {
    steps.push_back(Event(MouseMove{next_place(words)}));
  } else if (what == "press" || what == "click") {
    const MousePress press = next_press(words);
    steps.push_back(Event(press));
    if (what == "click") {
      steps.push_back(Event(MouseRelease{press.button, press.at}));
    }
  } else if (what == "release") {
    const MouseButton button = button_named(words.next_word());
    steps.push_back(Event(MouseRelease{button, next_place(words)}));
  } else if (what == "scroll") {
    steps.push_back(Event(Scroll{words.next_coordinate("steps")}));
  } else if (what == "type") {
    const std::size_t begin = line.find("type") + 5;
    steps.push_back(Event(TextInput{std::string(line.substr(std::min(begin, line.size())))}));
  } else if (what == "picture") {
    const std::string_view name = words.next_word();
    if (name.empty() || name.find('/') != std::string_view::npos) {
      throw ParameterError("a picture's name is " + quoted(name) + ", must be a word without '/'");
    }
    steps.emplace_back(PictureStep{std::string(name)});
  } else if (!what.empty()) {
    steps.push_back(parse_call(line));
  }
  return steps;
}

}  // namespace espalier::viewer
