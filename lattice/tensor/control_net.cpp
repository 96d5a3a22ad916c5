#include "lattice/tensor/control_net.h"

#include <array>

namespace espalier {
namespace {

/// Axes along which a cell extends, a bit each.
constexpr unsigned kNone = 0;
constexpr unsigned kAll = 7;

GridIndex moved(GridIndex at, unsigned axes, int by) {
  at.i += (axes & 1) != 0 ? by : 0;
  at.j += (axes & 2) != 0 ? by : 0;
  at.k += (axes & 4) != 0 ? by : 0;
  return at;
}

/// Cells from places of one grid. number_at(place): the control point there, -1 for none.
template <class NumberAt>
class CellFinder {
 public:
  explicit CellFinder(NumberAt number_at) : number_at_(std::move(number_at)) {}

  /// Adds the cells with their first corner at a control point.
  void add_cells(const GridIndex& at, ControlNet& net) {
    for (unsigned axes = kNone; axes <= kAll; ++axes) {
      if (is_cell(at, axes) && !is_part(at, axes)) {
        net.cells.push_back(corners_);
      }
    }
  }

 private:
  /// Whether all corners are control points; these are then in corners_.
  [[nodiscard]] bool is_cell(const GridIndex& at, unsigned axes) {
    corners_.clear();
    for (unsigned corner = 0; corner <= kAll; ++corner) {
      if ((corner & ~axes) == 0) {
        const std::int32_t number = number_at_(moved(at, corner, 1));
        if (number < 0) {
          return false;
        }
        corners_.push_back(number);
      }
    }
    return true;
  }

  /// Whether a cell that extends along one more axis holds this one.
  [[nodiscard]] bool is_part(const GridIndex& at, unsigned axes) {
    const std::vector<std::int32_t> own = corners_;
    bool result = false;
    for (unsigned axis = 1; axis <= kAll && !result; axis *= 2) {
      result = (axes & axis) == 0 &&
               (is_cell(at, axes | axis) || is_cell(moved(at, axis, -1), axes | axis));
    }
    corners_ = own;
    return result;
  }

  NumberAt number_at_;
  std::vector<std::int32_t> corners_;
};

}  // namespace

ControlNet control_net(const TensorLattice& lattice) {
  const std::array<int, 3> counts = lattice.counts();
  const auto number_at = [&](const GridIndex& at) {
    std::array<std::int32_t, 3> place{};
    for (std::size_t a = 0; a < 3; ++a) {
      const bool is_ring = lattice.axes[a].ends() == Ends::Periodic && counts[a] > 1;
      place[a] = is_ring ? (at[a] + counts[a]) % counts[a] : at[a];
      if (place[a] < 0 || place[a] >= counts[a]) {
        return -1;
      }
    }
    return place[0] + counts[0] * (place[1] + counts[1] * place[2]);
  };
  CellFinder finder(number_at);
  ControlNet net;
  for (std::int32_t k = 0; k < counts[2]; ++k) {
    for (std::int32_t j = 0; j < counts[1]; ++j) {
      for (std::int32_t i = 0; i < counts[0]; ++i) {
        finder.add_cells({i, j, k}, net);
      }
    }
  }
  return net;
}

ControlNet control_net(const ThbLattice& lattice) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  ControlNet net;
  std::size_t control = 0;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    BrickGrid<std::int32_t>::Reader numbers(hierarchy.numbers(level));
    const auto number_at = [&](const GridIndex& at) {
      const std::int32_t function = at.i < 0 || at.j < 0 || at.k < 0 ? -1 : numbers(at);
      return function < 0 ? -1 : hierarchy.function_controls()[static_cast<std::size_t>(function)];
    };
    CellFinder finder(number_at);
    const std::vector<ThbFunction>& controls = hierarchy.controls();
    for (; control < controls.size() && controls[control].level == level; ++control) {
      finder.add_cells(controls[control].index, net);
    }
    net.levels.resize(net.cells.n_rows(), level);
  }
  return net;
}

}  // namespace espalier
