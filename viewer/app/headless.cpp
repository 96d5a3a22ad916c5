#include "viewer/app/headless.h"

#include <algorithm>
#include <sstream>

#include "lattice/core/error.h"
#include "viewer/app/viewer.h"
#include "viewer/interact/script.h"
#include "viewer/render/offscreen_context.h"
#include "viewer/render/opengl_objects.h"

namespace espalier::viewer {
namespace {

/// A frame's time as scripts see it: the same on every machine.
constexpr double kFrameSeconds = 1.0 / 60;

/// A frame buffer instead of a window's, bound from construction on.
class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height) {
    glBindRenderbuffer(GL_RENDERBUFFER, color_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
    check_opengl("make a frame buffer");
  }

  [[nodiscard]] Picture picture() const {
    Picture picture(width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
    const auto row = static_cast<std::ptrdiff_t>(4) * width_;
    for (int y = 0; y < height_ / 2; ++y) {
      const auto top = picture.pixels.begin() + y * row;
      std::swap_ranges(top, top + row, picture.pixels.begin() + (height_ - 1 - y) * row);
    }
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4) {
      picture.pixels[i] = 255;
    }
    return picture;
  }

 private:
  int width_;
  int height_;
  GlRenderbuffer color_;
  GlFramebuffer frame_;
};

/// A panel that opens has its size and the keyboard in the frame after.
void settle(Viewer& viewer) {
  viewer.update(kFrameSeconds);
  viewer.update(kFrameSeconds);
}

/// As with a real mouse, the panels see it before its button goes down.
void handle(const Event& event, Viewer& viewer) {
  if (const auto* press = std::get_if<MousePress>(&event)) {
    viewer.handle(MouseMove{press->at});
    settle(viewer);
  }
  viewer.handle(event);
}

/// Without the time that a frame took.
Picture picture_of(Viewer& viewer, const Canvas& canvas) {
  viewer.draw(0);
  return canvas.picture();
}

void run_script(const HeadlessOptions& options, const Canvas& canvas, Viewer& viewer) {
  std::istringstream lines(options.script);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    std::vector<ScriptStep> steps;
    try {
      steps = parse_script_line(line);
    } catch (const Error& error) {
      throw FileError(options.script_path, number, error.what());
    }
    for (const ScriptStep& step : steps) {
      if (const auto* event = std::get_if<Event>(&step)) {
        handle(*event, viewer);
      } else if (const auto* picture = std::get_if<PictureStep>(&step)) {
        if (options.on_picture) {
          options.on_picture(picture->name, picture_of(viewer, canvas));
        }
      } else if (!viewer.session().apply(std::get<OperationCall>(step))) {
        throw FileError(options.script_path, number, viewer.session().messages().back());
      }
      settle(viewer);
    }
  }
}

}  // namespace

Picture run_headless(const HeadlessOptions& options) {
  check_picture_size(options.width, options.height);
  const OffscreenContext context;
  const Canvas canvas(options.width, options.height);
  Viewer viewer;
  viewer.handle(Resize{options.width, options.height});
  for (const std::string& file : options.files) {
    viewer.open(file);
    if (!viewer.session().messages().empty()) {
      throw Error(viewer.session().messages().back());
    }
  }
  viewer.session().frame_all();
  settle(viewer);
  run_script(options, canvas, viewer);
  return picture_of(viewer, canvas);
}

}  // namespace espalier::viewer
