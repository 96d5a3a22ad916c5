#pragma once

/// The renderer that draws.

#include <memory>

#include "viewer/render/renderer.h"

namespace espalier::viewer {

/// A renderer on OpenGL 3.3 or later. The calling thread's current context must be current again
/// whenever the renderer is used, and outlive it. Throws Error if there is none, or if it is too
/// old.
[[nodiscard]] std::unique_ptr<Renderer> make_opengl_renderer();

}  // namespace espalier::viewer
