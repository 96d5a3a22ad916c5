#include "viewer/app/window.h"

#include <epoxy/gl.h>
// After epoxy, which brings OpenGL's names.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "viewer/app/autosave.h"
#include "viewer/app/viewer.h"
#include "viewer/interact/script.h"

namespace espalier::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array<std::pair<int, const char*>, 15> kNamedKeys{{{GLFW_KEY_ENTER, "enter"},
                                                                  {GLFW_KEY_KP_ENTER, "enter"},
                                                                  {GLFW_KEY_ESCAPE, "escape"},
                                                                  {GLFW_KEY_TAB, "tab"},
                                                                  {GLFW_KEY_BACKSPACE, "backspace"},
                                                                  {GLFW_KEY_DELETE, "delete"},
                                                                  {GLFW_KEY_HOME, "home"},
                                                                  {GLFW_KEY_END, "end"},
                                                                  {GLFW_KEY_LEFT, "left"},
                                                                  {GLFW_KEY_RIGHT, "right"},
                                                                  {GLFW_KEY_UP, "up"},
                                                                  {GLFW_KEY_DOWN, "down"},
                                                                  {GLFW_KEY_KP_DECIMAL, "kp."},
                                                                  {GLFW_KEY_MINUS, "-"},
                                                                  {GLFW_KEY_KP_SUBTRACT, "-"}}};

/// A key's name in chords; empty for keys that have none.
std::string key_name(int key, int scancode) {
  for (const auto& [code, name] : kNamedKeys) {
    if (code == key) {
      return name;
    }
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
    return "f" + std::to_string(key - GLFW_KEY_F1 + 1);
  }
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
    return "kp" + std::to_string(key - GLFW_KEY_KP_0);
  }
  const char* name = glfwGetKeyName(key, scancode);
  return name != nullptr ? name : "";
}

std::string utf8(unsigned int character) {
  std::string text;
  if (character < 0x80) {
    text += static_cast<char>(character);
  } else if (character < 0x800) {
    text += static_cast<char>(0xC0 | character >> 6);
    text += static_cast<char>(0x80 | (character & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | character >> 12);
    text += static_cast<char>(0x80 | (character >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (character & 0x3F));
  }
  return text;
}

/// GLFW from construction to destruction.
class Glfw {
 public:
  Glfw() {
    if (glfwInit() == 0) {
      const char* what = nullptr;
      glfwGetError(&what);
      throw Error("cannot open a window: " + std::string(what != nullptr ? what : "GLFW fails"));
    }
  }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  ~Glfw() { glfwTerminate(); }
};

/// A window and what happened in it since it was asked last.
class Window {
 public:
  Window(int width, int height) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(width, height, "Espalier", nullptr, nullptr);
    if (window_ == nullptr) {
      const char* what = nullptr;
      glfwGetError(&what);
      throw Error("cannot open a window with OpenGL 3.3: " +
                  std::string(what != nullptr ? what : ""));
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    set_callbacks();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window() { glfwDestroyWindow(window_); }

  /// Waits a moment for something to happen.
  void wait() { glfwWaitEventsTimeout(0.25); }
  void poll() { glfwPollEvents(); }
  void show() { glfwSwapBuffers(window_); }
  [[nodiscard]] std::vector<Event> take_events() { return std::exchange(events_, {}); }
  [[nodiscard]] std::vector<std::string> take_dropped() { return std::exchange(dropped_, {}); }
  /// Whether the user wants to close it; asks once.
  [[nodiscard]] bool takes_close() {
    const bool closes = glfwWindowShouldClose(window_) != 0;
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return closes;
  }
  [[nodiscard]] Resize size() const {
    Resize size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
  }

 private:
  static Window& of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }

  void set_callbacks() {
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int held) {
      of(w).on_key(key, scancode, action, held);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned int character) {
      of(w).events_.emplace_back(TextInput{utf8(character)});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int held) {
      of(w).on_button(button, action, held);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      of(w).cursor_ = {x, y};
      of(w).on_move();
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double steps) {
      of(w).events_.emplace_back(Scroll{steps});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int n, const char** paths) {
      of(w).dropped_.insert(of(w).dropped_.end(), paths, paths + n);
    });
  }

  void on_key(int key, int scancode, int action, int held) {
    const std::string name = key_name(key, scancode);
    if (action == GLFW_RELEASE || name.empty()) {
      return;
    }
    // The number pad's digits come with Shift where Num Lock is off.
    const bool has_shift = (held & GLFW_MOD_SHIFT) != 0 && !name.starts_with("kp");
    const std::string chord = std::string((held & GLFW_MOD_CONTROL) != 0 ? "ctrl+" : "") +
                              (has_shift ? "shift+" : "") +
                              ((held & GLFW_MOD_ALT) != 0 ? "alt+" : "") + name;
    events_.emplace_back(KeyPress{chord});
  }

  /// Only where the mouse is at the end of a frame counts.
  void on_move() {
    if (!events_.empty() && std::holds_alternative<MouseMove>(events_.back())) {
      events_.pop_back();
    }
    events_.emplace_back(MouseMove{mouse()});
  }

  void on_button(int button, int action, int held) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) {
      return;
    }
    const MouseButton which = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::Left
                              : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::Right
                                                                  : MouseButton::Middle;
    if (action == GLFW_PRESS) {
      events_.emplace_back(MousePress{which,
                                      mouse(),
                                      {(held & GLFW_MOD_CONTROL) != 0, (held & GLFW_MOD_SHIFT) != 0,
                                       (held & GLFW_MOD_ALT) != 0}});
    } else {
      events_.emplace_back(MouseRelease{which, mouse()});
    }
  }

  /// Where the mouse was at the event that is told, in pixels of the frame buffer: during a slow
  /// frame it goes on, and GLFW would ask where it is now.
  [[nodiscard]] glm::dvec2 mouse() const {
    glm::dvec2 at(0.0);
    int width = 1;
    int height = 1;
    if (cursor_) {
      at = *cursor_;
    } else {
      glfwGetCursorPos(window_, &at.x, &at.y);
    }
    glfwGetWindowSize(window_, &width, &height);
    const Resize pixels = size();
    return at * glm::dvec2(pixels.width, pixels.height) /
           glm::dvec2(std::max(width, 1), std::max(height, 1));
  }

  GLFWwindow* window_ = nullptr;
  std::optional<glm::dvec2> cursor_;  // once it moved
  std::vector<Event> events_;
  std::vector<std::string> dropped_;
};

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

bool is_button(const Event& event) {
  return std::holds_alternative<MousePress>(event) || std::holds_alternative<MouseRelease>(event);
}

/// The lines of a file; none if it cannot be read.
std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// What other windows opened comes after our own.
std::vector<std::string> merged(std::vector<std::string> recent,
                                const std::vector<std::string>& others) {
  for (const std::string& file : others) {
    if (std::find(recent.begin(), recent.end(), file) == recent.end()) {
      recent.push_back(file);
    }
  }
  constexpr std::size_t kMost = 24;
  recent.resize(std::min(recent.size(), kMost));
  return recent;
}

/// The loop's state.
class Program {
 public:
  explicit Program(const WindowOptions& options)
      : options_(options),
        autosave_(options.autosave, options.autosave_interval),
        window_(options.width, options.height),
        viewer_(Progress([this](std::string_view task, double fraction) {
          return on_progress(task, fraction);
        })) {}

  void run() {
    begin();
    while (!viewer_.may_quit()) {
      step();
    }
    autosave_.end();
  }

 private:
  void begin() {
    viewer_.handle(window_.size());
    viewer_.set_recent(lines_of(options_.recent));
    left_ = autosave_.take_leftovers();
    std::vector<std::string> files = options_.files;
    if (options_.recovers || !left_.empty()) {
      // Going on with a session goes to where it ran.
      for (std::string& file : files) {
        file = std::filesystem::absolute(file).string();
      }
    }
    if (options_.recovers && left_.empty()) {
      viewer_.session().say("There is nothing to recover: the last session ended well.");
    } else if (options_.recovers) {
      recover(0);
    }
    offer();
    for (const std::string& file : files) {
      viewer_.open(file);
    }
    viewer_.session().frame_all();
    std::istringstream lines(options_.script);
    for (std::string line; std::getline(lines, line);) {
      for (const ScriptStep& step : parse_script_line(line)) {
        if (const auto* event = std::get_if<Event>(&step)) {
          viewer_.handle(*event);
        } else if (const auto* call = std::get_if<OperationCall>(&step)) {
          viewer_.session().apply(*call);
        }
      }
    }
    draw();
    draw();
  }

  void offer() {
    std::vector<std::string> titles;
    for (const LeftJournal& left : left_) {
      titles.push_back(left.title());
    }
    viewer_.offer(std::move(titles));
  }

  /// Its file is no longer needed once our own has it.
  void recover(std::size_t which) {
    const LeftJournal left = std::move(left_[which]);
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(which));
    std::error_code failure;
    std::filesystem::current_path(left.folder, failure);
    try {
      if (viewer_.session().recover(left.text) && !autosave_.path().empty()) {
        autosave_.keep(viewer_.session().journal());
        left.remove();
        return;
      }
    } catch (const Error& error) {
      viewer_.session().say(error.what());
    }
    viewer_.session().say("What was left is still in " + left.path + ".");
  }

  /// What the panel of sessions that did not end well was told.
  void choose_left() {
    const auto recovered = viewer_.take_recovered();
    const auto thrown_away = viewer_.take_thrown_away();
    if (recovered) {
      recover(*recovered);
      offer();
    } else if (thrown_away) {
      left_[*thrown_away].remove();
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(*thrown_away));
      offer();
    } else if (!viewer_.is_offering()) {
      left_.clear();  // for another window, or the next start
    }
  }

  /// The panels see where the mouse is, and every press and release, only by drawing a frame: on a
  /// slow machine several come at once.
  void handle(const Event& event) {
    if (is_button(event) && has_mouse_news_) {
      draw();
    }
    has_mouse_news_ |= is_button(event) || std::holds_alternative<MouseMove>(event);
    task_began_ = Clock::now();
    viewer_.handle(event);
  }

  void step() {
    window_.wait();
    viewer_.handle(window_.size());
    for (const Event& event : window_.take_events()) {
      handle(event);
    }
    for (const std::string& path : window_.take_dropped()) {
      viewer_.open(path);
    }
    if (window_.takes_close()) {
      viewer_.ask_to_quit();
    }
    task_began_ = Clock::now();
    draw();
    autosave();
    choose_left();
    keep_recent();
  }

  void keep_recent() {
    if (options_.recent.empty() || viewer_.recent() == kept_recent_) {
      return;
    }
    kept_recent_ = viewer_.recent();
    std::string text;
    for (const std::string& file : merged(kept_recent_, lines_of(options_.recent))) {
      text += file + "\n";
    }
    try {
      write_file(options_.recent, text);
    } catch (const Error& error) {
      viewer_.session().say(error.what());
    }
  }

  void draw() {
    const Clock::time_point start = Clock::now();
    has_mouse_news_ = false;
    viewer_.draw(frame_seconds_);
    window_.show();
    frame_seconds_ = seconds_between(start, Clock::now());
  }

  void autosave() {
    try {
      autosave_.keep(viewer_.session().journal(), seconds_between(start_, Clock::now()));
    } catch (const Error& error) {
      viewer_.session().say(error.what());
    }
  }

  /// Shows a task that takes longer than a moment; its button and Esc stop it.
  bool on_progress(std::string_view task, double fraction) {
    constexpr double kPatience = 0.4;
    constexpr double kRedraw = 0.1;
    const Clock::time_point now = Clock::now();
    if (seconds_between(task_began_, now) < kPatience || seconds_between(drawn_, now) < kRedraw) {
      return true;
    }
    drawn_ = now;
    window_.poll();
    bool is_stopped = false;
    for (const Event& event : window_.take_events()) {
      is_stopped |= viewer_.stops_task(event);
      if (is_button(event)) {
        is_stopped |= viewer_.draw_task(task, fraction);
      }
    }
    is_stopped |= viewer_.draw_task(task, fraction);
    window_.show();
    return !is_stopped;
  }

  const WindowOptions& options_;
  Autosave autosave_;
  std::vector<LeftJournal> left_;
  Glfw glfw_;
  Window window_;
  Viewer viewer_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point task_began_ = start_;
  Clock::time_point drawn_ = start_;
  double frame_seconds_ = 0;
  bool has_mouse_news_ = false;  // that no frame has shown the panels
  std::vector<std::string> kept_recent_;
};

}  // namespace

void run_window(const WindowOptions& options) {
  Program(options).run();
}

}  // namespace espalier::viewer
