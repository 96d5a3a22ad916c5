#pragma once

/// A grid round a model, all its elements in one array, and what of the model each meets.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {

/// Place of an element: twice its lower corner along each axis, plus 1 where it has a length. So
/// cells are odd on three axes, faces on two, edges on one, nodes on none.
using ElementPlace = std::array<int, 3>;

/// Cubes side by side.
struct GridFrame {
  glm::dvec3 origin{0};
  double step = 1;             ///< of a cube, model units
  std::array<int, 3> cells{};  ///< #cubes along each axis

  [[nodiscard]] int n_places(int axis) const {
    return 2 * cells[static_cast<std::size_t>(axis)] + 1;
  }
  [[nodiscard]] std::size_t n_elements() const {
    return static_cast<std::size_t>(n_places(0)) * static_cast<std::size_t>(n_places(1)) *
           static_cast<std::size_t>(n_places(2));
  }
  [[nodiscard]] bool contains(const ElementPlace& place) const {
    return place[0] >= 0 && place[1] >= 0 && place[2] >= 0 && place[0] < n_places(0) &&
           place[1] < n_places(1) && place[2] < n_places(2);
  }
  /// x fastest. place: inside.
  [[nodiscard]] std::size_t index(const ElementPlace& place) const {
    const auto [x, y, z] = place;
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(n_places(0)) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(n_places(1)) * static_cast<std::size_t>(z));
  }
  [[nodiscard]] ElementPlace place(std::size_t index) const;
  [[nodiscard]] glm::dvec3 center(const ElementPlace& place) const {
    return origin + 0.5 * step * glm::dvec3(place[0], place[1], place[2]);
  }
  /// The cell that holds a point, or the nearest.
  [[nodiscard]] ElementPlace cell_at(const glm::dvec3& point) const;
};

/// What the elements of a grid have of a model.
struct ElementGrid {
  GridFrame frame;
  std::vector<char> is_touched;  ///< #elements: the surface passes within the margin, axis by axis
  std::vector<char> is_inside;   ///< #elements: not touched, and the model encloses it
};

/// The elements that a surface touches or comes as near to as `margin` steps, and those it
/// encloses: what cannot be reached from outside without crossing touched elements and, if the
/// surface is closed, has a winding number other than 0. So the insides of open models count where
/// their holes are narrower than a cell. triangles: inside the frame, farther from its sides than
/// the margin. The same for any number of threads. O(#elements + #triangles · pockets).
[[nodiscard]] ElementGrid classify_elements(const GridFrame& frame,
                                            std::span<const Triangle> triangles, bool is_closed,
                                            double margin, const Progress& progress = {});

}  // namespace espalier
