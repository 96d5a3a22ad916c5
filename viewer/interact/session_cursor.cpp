/// The place that a user puts down, and what is done from there.

#include <string>
#include <vector>

#include "viewer/interact/pivot.h"
#include "viewer/interact/session.h"
#include "viewer/interact/surface_pick.h"

namespace espalier::viewer {

/// Where there is no model: as far away as it was, or as what the camera turns about.
void Session::place_cursor(const glm::dvec2& at) {
  const auto surface = surface_point(view_, bent_, at);
  const glm::dvec3 depth = cursor_ ? *cursor_ : view_.frame.to_model(view_.camera.target);
  cursor_ = surface ? *surface : view_.point_at(at, depth);
}

void Session::cursor_to_selected() {
  if (selection_.empty()) {
    say("Select what the cursor is to go to.");
  } else {
    cursor_ = middle_of(shown_points(), selected_vertices());
  }
}

void Session::cursor_to_active() {
  if (last_selected_.empty()) {
    say("Click what the cursor is to go to.");
  } else {
    cursor_ = middle_of(shown_points(), last_selected_);
  }
}

void Session::selection_to_cursor() {
  if (!cursor_ || !may_move()) {
    if (!cursor_) {
      say("Place the cursor first: Shift and the right button.");
    }
    return;
  }
  Selection vertices = selected_vertices();
  const glm::dvec3 by = *cursor_ - middle_of(shown_points(), vertices);
  std::vector<std::int64_t> indices;
  for (const std::int32_t vertex : vertices) {
    if (!locked_.contains(vertex)) {
      indices.push_back(vertex);
    }
  }
  apply({"move points", Arguments({{"lattice", lattice_},
                                   {"points", std::move(indices)},
                                   {"by", std::vector<double>{by.x, by.y, by.z}},
                                   {"shape", shape_name()}})});
}

}  // namespace espalier::viewer
