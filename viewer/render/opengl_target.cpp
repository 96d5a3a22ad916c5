#include "viewer/render/opengl_target.h"

#include <algorithm>
#include <string>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

constexpr GLint kSamples = 4;

void check_framebuffer() {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error("OpenGL cannot draw into sRGB pixels with depth");
  }
}

}  // namespace

OpenglTarget::OpenglTarget(int width, int height) : width_(width), height_(height) {
  GLint most_samples = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  const GLint n = std::min(kSamples, most_samples);
  glBindRenderbuffer(GL_RENDERBUFFER, color_samples_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, n, GL_SRGB8_ALPHA8, width, height);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_samples_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, n, GL_DEPTH_COMPONENT32F, width, height);
  glBindRenderbuffer(GL_RENDERBUFFER, color_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width, height);
  check_opengl("draw a picture of " + std::to_string(width) + " × " + std::to_string(height));

  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                            color_samples_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                            depth_samples_.id());
  check_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  check_framebuffer();
}

void OpenglTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
  glViewport(0, 0, width_, height_);
  glEnable(GL_FRAMEBUFFER_SRGB);
}

void OpenglTarget::resolve() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void OpenglTarget::copy_to(GLuint framebuffer) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

std::vector<std::uint8_t> OpenglTarget::pixels() const {
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width_) *
                                   static_cast<std::size_t>(height_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

}  // namespace espalier::viewer
