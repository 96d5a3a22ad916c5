#pragma once

/// OpenGL without a window.

#include <memory>
#include <string>

namespace espalier::viewer {

/// An OpenGL 3.3 core context of the calling thread, current from construction to destruction.
/// It needs neither a display nor a GPU: Mesa's software rasteriser serves. Its default frame
/// buffer has no pixels; a renderer's take_picture brings its own.
class OffscreenContext {
 public:
  /// Throws Error if the system has no EGL, or none that gives OpenGL 3.3.
  OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  ~OffscreenContext();

  /// What draws, as OpenGL names it: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa …".
  [[nodiscard]] std::string description() const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace espalier::viewer
