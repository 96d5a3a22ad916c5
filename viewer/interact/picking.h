#pragma once

/// Which of a lattice's elements are under the mouse.

#include <cstdint>
#include <optional>
#include <span>

#include "viewer/interact/lattice_elements.h"
#include "viewer/interact/show.h"
#include "viewer/interact/view.h"

namespace espalier::viewer {

/// What is looked at: elements of one kind at points (#vertices, model units).
struct PickTarget {
  const LatticeElements& lattice;
  std::span<const glm::dvec3> points;
  ElementKind kind = ElementKind::Vertex;
  bool is_through = true;            ///< also what the lattice's outer faces hide
  const Visible* visible = nullptr;  ///< only what is to be seen; null: everything is

  /// Whether an element can be picked at all.
  [[nodiscard]] bool has(ElementKind which, std::size_t element) const {
    return visible == nullptr || visible->of(which)[element];
  }
};

/// The element at a pixel: a face that covers it; else the one whose middle, or whose line if it is
/// an edge, is closest, within 12 pixels for vertices and edges and 40 for faces and cells. Of
/// those equally close the nearest to the eye. O(n), or O(n · faces) if what is hidden does not
/// count.
[[nodiscard]] std::optional<std::int32_t> pick(const View& view, const PickTarget& target,
                                               const glm::dvec2& pixel);

/// The elements whose middles are in the rectangle between two corners, in any order.
[[nodiscard]] Selection pick_box(const View& view, const PickTarget& target, const glm::dvec2& from,
                                 const glm::dvec2& to);

}  // namespace espalier::viewer
