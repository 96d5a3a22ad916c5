/// The program `espalier-viewer`: lattices and models in a window, or scripts without one.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/core/text_scanner.h"
#include "viewer/app/headless.h"
#include "viewer/app/window.h"

namespace espalier::viewer {
namespace {

constexpr const char* kScriptHelp =
    "A script has one step a line:\n"
    "  key G X 1 ENTER           keys, as the help (F1) names them, in lower case\n"
    "  move X Y                  the mouse, in pixels from the top left corner\n"
    "  press|release BUTTON X Y  left, middle or right; after press also ctrl, shift, alt\n"
    "  click BUTTON X Y          both\n"
    "  scroll STEPS              the wheel\n"
    "  type TEXT                 into a field\n"
    "  picture NAME              takes one: --screenshot leg-{}.png writes leg-NAME.png\n"
    "  OPERATION NAME=VALUE ...  as in a journal: new box cells=1,1,3 output=box.json\n"
    "Lines that begin with # are skipped.";

struct Options {
  std::vector<std::string> files;
  std::string script;
  std::string screenshot;
  std::string size = "1280x800";
  double autosave = 2;
  bool recovers = false;
};

/// Throws ParameterError unless the text is WIDTHxHEIGHT.
void parse_size(const std::string& text, int& width, int& height) {
  const std::size_t cross = text.find('x');
  std::int64_t w = 0;
  std::int64_t h = 0;
  if (cross == std::string::npos || !parse_integer(text.substr(0, cross), w) ||
      !parse_integer(text.substr(cross + 1), h) || w < 1 || h < 1 || w > kLargestPictureSide ||
      h > kLargestPictureSide) {
    throw ParameterError("--size is '" + text + "', must be WIDTHxHEIGHT with sides from 1 to " +
                         std::to_string(kLargestPictureSide));
  }
  width = static_cast<int>(w);
  height = static_cast<int>(h);
}

/// Where the program keeps a file from session to session; "" if there is no such place.
std::string state_path(const std::string& name) {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state == nullptr && home == nullptr) {
    return "";
  }
  const std::filesystem::path folder =
      (state != nullptr ? std::filesystem::path(state)
                        : std::filesystem::path(home) / ".local" / "state") /
      "espalier";
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  return failure ? "" : (folder / name).string();
}

/// The last one, or where {} stands for a name one at every line of the script that says so.
void take_pictures(const Options& options, HeadlessOptions headless) {
  const std::size_t place = options.screenshot.find("{}");
  if (place == std::string::npos) {
    write_png(options.screenshot, run_headless(headless));
    return;
  }
  std::size_t n_pictures = 0;
  headless.on_picture = [&](const std::string& name, const Picture& picture) {
    write_png(std::string(options.screenshot).replace(place, 2, name), picture);
    ++n_pictures;
  };
  static_cast<void>(run_headless(headless));
  if (n_pictures == 0) {
    throw ParameterError("--screenshot has {}, but no line of the script says 'picture NAME'");
  }
}

void run(const Options& options) {
  int width = 0;
  int height = 0;
  parse_size(options.size, width, height);
  const std::string script = options.script.empty() ? "" : read_file(options.script);
  if (!options.screenshot.empty()) {
    take_pictures(options, {options.files, script, options.script, width, height});
    return;
  }
  run_window({options.files, script, width, height, state_path("journal"), options.autosave,
              state_path("recent"), options.recovers});
}

}  // namespace
}  // namespace espalier::viewer

int main(int argc, char** argv) {
  espalier::viewer::Options options;
  CLI::App program("Builds lattices round models, and bends the models with them.",
                   "espalier-viewer");
  program.add_option("files", options.files, "models and lattices to open");
  program.add_option("--script", options.script, "steps to do, a file");
  program.add_option(
      "--screenshot", options.screenshot,
      "no window: do the script, write the last frame to this .png file; with {} in its "
      "name those that the script takes");
  program.add_option("--size", options.size, "WIDTHxHEIGHT in pixels (default 1280x800)");
  program
      .add_option("--autosave", options.autosave,
                  "seconds between two writes of the journal that --recover reads (default 2)")
      ->check(CLI::Range(0.0, 3600.0));
  program.add_flag("--recover", options.recovers, "go on where a session ended unexpectedly");
  program.footer(espalier::viewer::kScriptHelp);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  try {
    espalier::viewer::run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "espalier-viewer: %s\n", error.what());
    return 1;
  }
}
