#pragma once

/// What of a lattice is to be seen, and picked.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "viewer/interact/lattice_elements.h"

namespace espalier::viewer {

/// Takes away the cells whose middle lies beyond a plane across an axis.
struct Cut {
  int axis = 0;              ///< 0 x, 1 y, 2 z
  double place = 0.5;        ///< from one side of the lattice's box at rest, 0, to the other, 1
  bool keeps_upper = false;  ///< what is seen lies above the place, else below
  bool operator==(const Cut&) const = default;
};

/// A value.
struct Show {
  bool has_cage = true;      ///< control points and the lines between them
  int refined_levels = 0;    ///< the lattice refined so often, 1 to 3; 0: not shown
  bool has_surface = false;  ///< the boundary of the volume
  bool has_shrunk_cells = false;
  bool has_influence = false;  ///< how much the selection moves each point of the models
  std::optional<Cut> cut{};
  Selection hidden_vertices{};
  Selection hidden_cells{};
  std::set<std::int32_t> hidden_levels{};  ///< of a hierarchy
  bool operator==(const Show&) const = default;
};

/// For every element whether it is to be seen.
struct Visible {
  std::vector<bool> vertices, edges, faces, cells;

  [[nodiscard]] const std::vector<bool>& of(ElementKind kind) const;
};

/// A cell is hidden by itself or by the cut; a face or a vertex by all of its cells, an edge by all
/// of its faces; a vertex also by itself or its level, and with it all that it belongs to. rest:
/// #vertices. O(#elements).
[[nodiscard]] Visible visible_elements(const LatticeElements& elements,
                                       std::span<const glm::dvec3> rest, const Show& show);

}  // namespace espalier::viewer
