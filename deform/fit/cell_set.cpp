#include "deform/fit/cell_set.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <utility>

namespace espalier {
namespace {

/// Whether only two cells meet at an edge from the node, across the edge.
bool has_edge_contact(unsigned cells) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned b = 1U << (axis + 1) % 3;
    const unsigned c = 1U << (axis + 2) % 3;
    for (const unsigned side : {0U, 1U << axis}) {
      const auto has = [&](unsigned q) { return (cells >> (side | q) & 1U) != 0; };
      if ((has(0) && has(b | c) && !has(b) && !has(c)) ||
          (!has(0) && !has(b | c) && has(b) && has(c))) {
        return true;
      }
    }
  }
  return false;
}

/// Whether the four cells are one and its three neighbours.
bool is_tripod(unsigned cells) {
  for (unsigned q = 0; q < 8; ++q) {
    if (cells == (1U << q | 1U << (q ^ 1U) | 1U << (q ^ 2U) | 1U << (q ^ 4U))) {
      return true;
    }
  }
  return false;
}

/// Mean direction from the node into a fan's cells, its largest coordinate 1, or zero.
glm::dvec3 middle_of(unsigned cells) {
  glm::dvec3 sum(0);
  for (unsigned q = 0; q < 8; ++q) {
    if ((cells >> q & 1U) != 0) {
      sum += glm::dvec3(q & 1U, q >> 1 & 1U, q >> 2) * 2.0 - 1.0;
    }
  }
  const glm::dvec3 size = glm::abs(sum);
  const double most = std::max({size.x, size.y, size.z});
  return most == 0 ? sum : sum / most;
}

}  // namespace

CellSet::CellSet(const ElementGrid& grid) : frame_(grid.frame), has_(grid.frame.n_elements(), 0) {
  for (std::size_t i = 0; i < has_.size(); ++i) {
    const ElementPlace place = frame_.place(i);
    const int n_odd = place[0] % 2 + place[1] % 2 + place[2] % 2;
    has_[i] = n_odd >= 2 && (grid.is_touched[i] != 0 || grid.is_inside[i] != 0) ? 1 : 0;
  }
}

ElementPlace CellSet::cell_round(const ElementPlace& node, unsigned q) const {
  ElementPlace cell = node;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell[axis] += (q >> axis & 1U) != 0 ? 1 : -1;
  }
  return cell;
}

bool CellSet::is_joined(const ElementPlace& node, unsigned q, unsigned axis) const {
  ElementPlace face = cell_round(node, q);
  face[axis] = node[axis];
  return has(cell_round(node, q)) && has(cell_round(node, q ^ 1U << axis)) && has(face);
}

CellSet::Fan CellSet::fan_of(const ElementPlace& node, unsigned q) const {
  Fan fan{1U << q};
  for (unsigned before = 0; before != fan.cells;) {
    before = fan.cells;
    for (unsigned at = 0; at < 8; ++at) {
      for (unsigned axis = 0; (before >> at & 1U) != 0 && axis < 3; ++axis) {
        fan.cells |= is_joined(node, at, axis) ? 1U << (at ^ 1U << axis) : 0;
      }
    }
  }
  // A straight slit leaves two neighbouring faces of one axis closed, all cells there.
  std::array<int, 3> n_closed{};
  unsigned ends = 0;
  for (unsigned at = 0; at < 8; ++at) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned other = at ^ 1U << axis;
      if (at < other && (fan.cells >> at & 1U) != 0 && (fan.cells >> other & 1U) != 0 &&
          !is_joined(node, at, axis)) {
        ++n_closed[axis];
        ends ^= at;
      }
    }
  }
  const int n = n_closed[0] + n_closed[1] + n_closed[2];
  const bool is_straight = n == 2 && std::max({n_closed[0], n_closed[1], n_closed[2]}) == 2 &&
                           std::has_single_bit(ends) && fan.cells == 0xFF;
  fan.has_slit = n > 0;
  fan.has_corner_slit = fan.has_slit && !is_straight;
  return fan;
}

bool CellSet::fill_around(const ElementPlace& node) {
  bool has_changed = false;
  ElementPlace at{};
  for (at[2] = node[2] - 1; at[2] <= node[2] + 1; ++at[2]) {
    for (at[1] = node[1] - 1; at[1] <= node[1] + 1; ++at[1]) {
      for (at[0] = node[0] - 1; at[0] <= node[0] + 1; ++at[0]) {
        const int n_odd = at[0] % 2 + at[1] % 2 + at[2] % 2;
        if (frame_.contains(at) && n_odd >= 2 && !has(at)) {
          has_[frame_.index(at)] = 1;
          has_changed = true;
        }
      }
    }
  }
  return has_changed;
}

GridCells CellSet::make_cells(double gap) const {
  GridCells result;
  std::vector<std::int32_t> vertices(frame_.n_elements(), -1);  // at a node: of its last fan
  std::vector<std::pair<ElementPlace, unsigned>> fans;          // #vertices
  std::vector<std::int32_t> earlier;  // #vertices: the fan before at the same node
  const auto vertex_at = [&](const ElementPlace& node, unsigned q) {
    std::int32_t& last = vertices[frame_.index(node)];
    for (std::int32_t v = last; v >= 0; v = earlier[static_cast<std::size_t>(v)]) {
      if ((fans[static_cast<std::size_t>(v)].second >> q & 1U) != 0) {
        return v;
      }
    }
    const Fan fan = fan_of(node, q);
    earlier.push_back(last);
    last = static_cast<std::int32_t>(fans.size());
    fans.emplace_back(node, fan.cells);
    result.is_fixed.push_back(fan.has_slit ? 1 : 0);
    result.is_sharp.push_back(
        fan.has_corner_slit || has_edge_contact(fan.cells) || is_tripod(fan.cells) ? 1 : 0);
    return last;
  };
  for (std::size_t i = 0; i < has_.size(); ++i) {
    const ElementPlace cell = frame_.place(i);
    if (has_[i] == 0 || cell[0] % 2 + cell[1] % 2 + cell[2] % 2 != 3) {
      continue;
    }
    std::array<std::int32_t, 8>& corners = result.corners.emplace_back();
    for (unsigned corner = 0; corner < 8; ++corner) {
      ElementPlace node = cell;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node[axis] += (corner >> axis & 1U) != 0 ? 1 : -1;
      }
      corners[corner] = vertex_at(node, 7U - corner);
    }
    result.elements.push_back(i);
  }
  for (std::size_t v = 0; v < fans.size(); ++v) {
    const auto& [node, cells] = fans[v];
    const bool is_alone =
        earlier[v] < 0 && vertices[frame_.index(node)] == static_cast<std::int32_t>(v);
    if (!is_alone) {
      result.is_fixed[v] = 1;
    }
    const glm::dvec3 back = is_alone ? glm::dvec3(0) : middle_of(cells) * (gap * frame_.step);
    result.mesh.points.push_back(frame_.center(node) + back);
  }
  result.mesh.cells =
      match_faces(hexahedron_loops(static_cast<std::int32_t>(fans.size()), result.corners));
  return result;
}

}  // namespace espalier
