#pragma once

/// From a drawing to a picture in one call.

#include "viewer/render/camera.h"
#include "viewer/render/drawing.h"
#include "viewer/render/picture.h"

namespace espalier::viewer {

/// A picture without a window. For many pictures of one drawing keep an OffscreenContext and a
/// renderer instead. Throws ParameterError as check_picture_size and Renderer::add, and Error if
/// the system cannot draw.
[[nodiscard]] Picture render_picture(const Drawing& drawing, const Camera& camera, int width,
                                     int height);

}  // namespace espalier::viewer
