/// What a session selects and hides.

#include <utility>

#include "viewer/interact/picking.h"
#include "viewer/interact/session.h"

namespace espalier::viewer {
namespace {

/// What is hidden is not selected along with the rest.
Selection visible_among(const Selection& elements, const std::vector<bool>& is_visible) {
  Selection visible;
  for (const std::int32_t element : elements) {
    if (is_visible[static_cast<std::size_t>(element)]) {
      visible.insert(element);
    }
  }
  return visible;
}

}  // namespace

/// What is selected stays so as far as the new kind can say it.
void Session::set_element_kind(ElementKind kind) {
  selection_ = visible_among(elements_.within(kind, selected_vertices()), visible_.of(kind));
  kind_ = kind;
}

void Session::select_all(bool is_selected) {
  selection_.clear();
  for (std::size_t i = 0; is_selected && i < elements_.count(kind_); ++i) {
    if (visible_.of(kind_)[i]) {
      selection_.insert(static_cast<std::int32_t>(i));
    }
  }
}

void Session::select_connected() {
  selection_ = visible_among(elements_.connected(kind_, selection_), visible_.of(kind_));
}

void Session::invert_selection() {
  const Selection before = std::exchange(selection_, {});
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(elements_.count(kind_)); ++i) {
    if (!before.contains(i) && visible_.of(kind_)[static_cast<std::size_t>(i)]) {
      selection_.insert(i);
    }
  }
}

void Session::hide_selected() {
  Show show = show_;
  if (kind_ == ElementKind::Cell) {
    show.hidden_cells.insert(selection_.begin(), selection_.end());
  } else {
    const Selection vertices = selected_vertices();
    show.hidden_vertices.insert(vertices.begin(), vertices.end());
  }
  selection_.clear();
  set_show(show);
}

void Session::reveal() {
  Show show = show_;
  show.hidden_cells.clear();
  show.hidden_vertices.clear();
  set_show(show);
}

std::optional<std::int32_t> Session::picked(ElementKind kind, const glm::dvec2& at) const {
  return pick(view_, {elements_, shown_points(), kind, handling_.is_through, &visible_}, at);
}

void Session::click(const glm::dvec2& at) {
  const auto found = picked(kind_, at);
  if (!held_.shift) {
    selection_.clear();
  }
  if (found && !selection_.erase(*found)) {
    selection_.insert(*found);
    last_selected_ = elements_.vertices(kind_, Selection{*found});
  }
}

/// The loop of the edge that was clicked: its vertices, its edges, or what lies between them.
void Session::click_loop(const glm::dvec2& at) {
  const auto edge = picked(ElementKind::Edge, at);
  if (!held_.shift) {
    selection_.clear();
  }
  if (edge) {
    const Selection loop = visible_among(
        elements_.within(kind_, elements_.vertices(ElementKind::Edge, elements_.loop(*edge))),
        visible_.of(kind_));
    selection_.insert(loop.begin(), loop.end());
  }
}

void Session::select_box(const Rubber& box) {
  const Selection found = pick_box(
      view_, {elements_, shown_points(), kind_, handling_.is_through, &visible_}, box.from, box.to);
  if (!held_.shift) {
    selection_.clear();
  }
  selection_.insert(found.begin(), found.end());
}

}  // namespace espalier::viewer
