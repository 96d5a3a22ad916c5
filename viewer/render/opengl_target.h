#pragma once

/// What the OpenGL back end draws into. Only that back end includes this.

#include <cstdint>
#include <vector>

#include "viewer/render/opengl_objects.h"

namespace espalier::viewer {

/// A frame buffer of its own: several samples a pixel, sRGB colours, depth. A window's frame
/// buffer may have none of these.
class OpenglTarget {
 public:
  /// Throws Error if OpenGL has not the memory.
  OpenglTarget(int width, int height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// From here on everything is drawn into this target; colours that shaders write are linear.
  void begin() const;
  /// Averages the samples of each pixel.
  void resolve() const;
  /// Copies the resolved pixels to another frame buffer of this size.
  void copy_to(GLuint framebuffer) const;
  /// The resolved pixels, RGBA, bottom row first.
  [[nodiscard]] std::vector<std::uint8_t> pixels() const;

 private:
  int width_;
  int height_;
  GlRenderbuffer color_samples_;
  GlRenderbuffer depth_samples_;
  GlRenderbuffer color_;
  GlFramebuffer sampled_;
  GlFramebuffer resolved_;
};

}  // namespace espalier::viewer
