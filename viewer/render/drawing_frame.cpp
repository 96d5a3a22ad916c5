#include "viewer/render/drawing_frame.h"

#include <cmath>
#include <limits>

namespace espalier::viewer {

DrawingFrame DrawingFrame::of(const Box& box) {
  const double radius = box.radius();
  const bool has_extent = radius > std::numeric_limits<double>::min() && std::isfinite(radius);
  return {box.center(), has_extent ? 1 / radius : 1.0};
}

Box DrawingFrame::to_drawing(const Box& box) const {
  return box.is_empty() ? box : Box{to_drawing(box.min), to_drawing(box.max)};
}

}  // namespace espalier::viewer
