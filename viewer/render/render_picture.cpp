#include "viewer/render/render_picture.h"

#include "viewer/render/offscreen_context.h"
#include "viewer/render/opengl_renderer.h"

namespace espalier::viewer {

Picture render_picture(const Drawing& drawing, const Camera& camera, int width, int height) {
  check_picture_size(width, height);
  const OffscreenContext context;
  const std::unique_ptr<Renderer> renderer = make_opengl_renderer();
  renderer->add(drawing);
  return renderer->take_picture(camera, width, height);
}

}  // namespace espalier::viewer
