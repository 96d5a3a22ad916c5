#include "viewer/interact/grid_elements.h"

#include <algorithm>
#include <array>

namespace espalier::viewer {
namespace {

GridIndex stepped(GridIndex at, std::size_t axis) {
  ++(axis == 0 ? at.i : axis == 1 ? at.j : at.k);
  return at;
}

/// Elements by the control point at their lowest corner and the axis that an edge runs along, or a
/// face is perpendicular to; -1 where there is none.
using ByCorner = std::vector<std::array<std::int32_t, 3>>;

/// Adds the elements of a grid. control(place): the control point there, -1 for none.
template <class Control>
class GridBuilder {
 public:
  GridBuilder(LatticeElements& elements, const Control& control)
      : elements_(elements), control_(control) {
    const auto n = static_cast<std::size_t>(elements.n_vertices);
    edges_.assign(n, {-1, -1, -1});
    faces_.assign(n, {-1, -1, -1});
  }

  void add_edges(const GridIndex& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t from = control_(at);
      const std::int32_t to = control_(stepped(at, axis));
      if (to >= 0 && to != from) {
        edges_[static_cast<std::size_t>(from)][axis] =
            static_cast<std::int32_t>(elements_.edges.n_rows());
        elements_.edges.push_back(std::array{from, to});
      }
    }
  }

  void add_faces(const GridIndex& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t b = (axis + 1) % 3;
      const std::size_t c = (axis + 2) % 3;
      const std::array loop = {control_(at), control_(stepped(at, b)),
                               control_(stepped(stepped(at, b), c)), control_(stepped(at, c))};
      if (!is_whole(loop)) {
        continue;
      }
      const auto face = static_cast<std::int32_t>(elements_.faces.n_rows());
      faces_[static_cast<std::size_t>(loop[0])][axis] = face;
      elements_.faces.push_back(loop);
      for (const std::int32_t edge :
           {edge_at(loop[0], b), edge_at(loop[1], c), edge_at(loop[3], b), edge_at(loop[0], c)}) {
        edge_faces_.emplace_back(edge, face);
      }
    }
  }

  void add_cell(const GridIndex& at) {
    std::array<std::int32_t, 8> corners{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
      GridIndex place = at;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place = (corner >> axis & 1) != 0 ? stepped(place, axis) : place;
      }
      corners.at(corner) = control_(place);
    }
    if (!is_whole(corners)) {
      return;
    }
    std::array<std::int32_t, 6> faces{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      faces.at(2 * axis) = faces_[static_cast<std::size_t>(corners[0])].at(axis);
      const std::int32_t beyond = corners.at(std::size_t{1} << axis);
      faces.at(2 * axis + 1) = faces_[static_cast<std::size_t>(beyond)].at(axis);
    }
    elements_.cells.push_back(corners);
    elements_.cell_faces.push_back(faces);
  }

  /// What is known once all elements are there.
  void finish() {
    std::sort(edge_faces_.begin(), edge_faces_.end());
    std::vector<std::int32_t> row;
    auto next = edge_faces_.begin();
    for (std::int32_t edge = 0; edge < static_cast<std::int32_t>(elements_.edges.n_rows());
         ++edge) {
      row.clear();
      for (; next != edge_faces_.end() && next->first == edge; ++next) {
        row.push_back(next->second);
      }
      elements_.edge_faces.push_back(row);
    }
    std::vector<int> n_cells(elements_.faces.n_rows(), 0);
    for (const std::int32_t face : elements_.cell_faces.values()) {
      ++n_cells[static_cast<std::size_t>(face)];
    }
    for (const int n : n_cells) {
      elements_.is_outer.push_back(n < 2);
    }
    elements_.edge_sharpness.assign(elements_.edges.n_rows(), 0);
    elements_.vertex_sharpness.assign(static_cast<std::size_t>(elements_.n_vertices), 0);
  }

 private:
  /// Corners that are all there, each once: a short ring has none.
  template <std::size_t n>
  static bool is_whole(std::array<std::int32_t, n> corners) {
    std::sort(corners.begin(), corners.end());
    return corners[0] >= 0 && std::adjacent_find(corners.begin(), corners.end()) == corners.end();
  }
  [[nodiscard]] std::int32_t edge_at(std::int32_t control, std::size_t axis) const {
    return edges_[static_cast<std::size_t>(control)][axis];
  }

  LatticeElements& elements_;
  const Control& control_;
  ByCorner edges_, faces_;
  std::vector<std::pair<std::int32_t, std::int32_t>> edge_faces_;
};

/// places: of the control points, in their order, `n` of them; for one level after the other.
template <class Control>
void add_level(GridBuilder<Control>& builder, std::span<const GridIndex> places) {
  for (const GridIndex& at : places) {
    builder.add_edges(at);
  }
  for (const GridIndex& at : places) {
    builder.add_faces(at);
  }
  for (const GridIndex& at : places) {
    builder.add_cell(at);
  }
}

}  // namespace

LatticeElements grid_elements(const TensorLattice& lattice) {
  const std::array<int, 3> counts = lattice.counts();
  LatticeElements elements;
  elements.n_vertices = static_cast<std::int32_t>(lattice.n_controls());
  elements.levels.assign(lattice.n_controls(), 0);
  const auto control = [&](const GridIndex& at) {
    std::array<std::int32_t, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.at(axis) = at[axis];
      if (lattice.axes.at(axis).ends() == Ends::Periodic) {
        place.at(axis) %= counts.at(axis);
      } else if (place.at(axis) >= counts.at(axis)) {
        return -1;
      }
    }
    return place[0] + counts[0] * (place[1] + counts[1] * place[2]);
  };
  std::vector<GridIndex> places;
  for (std::int32_t k = 0; k < counts[2]; ++k) {
    for (std::int32_t j = 0; j < counts[1]; ++j) {
      for (std::int32_t i = 0; i < counts[0]; ++i) {
        places.push_back({i, j, k});
      }
    }
  }
  GridBuilder builder(elements, control);
  add_level(builder, places);
  builder.finish();
  return elements;
}

LatticeElements grid_elements(const ThbLattice& lattice) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  LatticeElements elements;
  elements.n_vertices = static_cast<std::int32_t>(hierarchy.controls().size());
  elements.n_levels = hierarchy.n_levels();
  std::vector<std::vector<GridIndex>> places(static_cast<std::size_t>(hierarchy.n_levels()));
  for (const ThbFunction& function : hierarchy.controls()) {
    places[static_cast<std::size_t>(function.level)].push_back(function.index);
    elements.levels.push_back(function.level);
  }
  std::vector<BrickGrid<std::int32_t>::Reader> numbers;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    numbers.emplace_back(hierarchy.numbers(level));
  }
  std::size_t level = 0;
  const auto control = [&](const GridIndex& at) {
    const std::int32_t function = numbers[level](at);
    return function < 0 ? -1 : hierarchy.function_controls()[static_cast<std::size_t>(function)];
  };
  GridBuilder builder(elements, control);
  for (; level < places.size(); ++level) {
    add_level(builder, places[level]);
  }
  builder.finish();
  return elements;
}

}  // namespace espalier::viewer
