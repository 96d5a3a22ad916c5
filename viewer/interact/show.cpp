#include "viewer/interact/show.h"

#include <algorithm>

#include "lattice/core/box.h"

namespace espalier::viewer {
namespace {

using Rows = CompressedRows<std::int32_t>;

bool all_of(std::span<const std::int32_t> row, const std::vector<bool>& is_true) {
  return std::all_of(row.begin(), row.end(),
                     [&](std::int32_t i) { return is_true[static_cast<std::size_t>(i)]; });
}

/// Of elements that are in rows: whether one of these rows is visible, or the element is in none.
std::vector<bool> seen_through(const Rows& rows, const std::vector<bool>& is_visible,
                               std::size_t n_elements) {
  std::vector<bool> is_in_row(n_elements, false);
  std::vector<bool> is_seen(n_elements, false);
  for (std::size_t row = 0; row < rows.n_rows(); ++row) {
    for (const std::int32_t element : rows[row]) {
      is_in_row[static_cast<std::size_t>(element)] = true;
      if (is_visible[row]) {
        is_seen[static_cast<std::size_t>(element)] = true;
      }
    }
  }
  for (std::size_t i = 0; i < n_elements; ++i) {
    is_seen[i] = is_seen[i] || !is_in_row[i];
  }
  return is_seen;
}

bool is_cut_off(std::span<const std::int32_t> cell, std::span<const glm::dvec3> rest,
                const Cut& cut, const Box& box) {
  double sum = 0;
  for (const std::int32_t vertex : cell) {
    sum += rest[static_cast<std::size_t>(vertex)][cut.axis];
  }
  const double place = box.min[cut.axis] + cut.place * (box.max[cut.axis] - box.min[cut.axis]);
  const double middle = sum / static_cast<double>(cell.size());
  return cut.keeps_upper ? middle < place : middle > place;
}

}  // namespace

const std::vector<bool>& Visible::of(ElementKind kind) const {
  switch (kind) {
    case ElementKind::Vertex:
      return vertices;
    case ElementKind::Edge:
      return edges;
    case ElementKind::Face:
      return faces;
    default:
      return cells;
  }
}

Visible visible_elements(const LatticeElements& elements, std::span<const glm::dvec3> rest,
                         const Show& show) {
  const auto n_vertices = static_cast<std::size_t>(elements.n_vertices);
  std::vector<bool> is_allowed(n_vertices, true);
  for (std::size_t i = 0; i < n_vertices; ++i) {
    is_allowed[i] = !show.hidden_vertices.contains(static_cast<std::int32_t>(i)) &&
                    !show.hidden_levels.contains(elements.levels[i]);
  }
  const Box box = show.cut ? box_of(rest) : Box();
  std::vector<bool> is_cell_left;
  for (std::size_t cell = 0; cell < elements.cells.n_rows(); ++cell) {
    is_cell_left.push_back(!show.hidden_cells.contains(static_cast<std::int32_t>(cell)) &&
                           !(show.cut && is_cut_off(elements.cells[cell], rest, *show.cut, box)));
  }
  Visible visible;
  visible.vertices = seen_through(elements.cells, is_cell_left, n_vertices);
  for (std::size_t i = 0; i < n_vertices; ++i) {
    visible.vertices[i] = visible.vertices[i] && is_allowed[i];
  }
  visible.faces = seen_through(elements.cell_faces, is_cell_left, elements.faces.n_rows());
  for (std::size_t edge = 0; edge < elements.edges.n_rows(); ++edge) {
    const auto faces = elements.edge_faces[edge];
    visible.edges.push_back(
        all_of(elements.edges[edge], visible.vertices) &&
        (faces.empty() || std::any_of(faces.begin(), faces.end(), [&](std::int32_t face) {
           return visible.faces[static_cast<std::size_t>(face)];
         })));
  }
  for (std::size_t face = 0; face < elements.faces.n_rows(); ++face) {
    visible.faces[face] = visible.faces[face] && all_of(elements.faces[face], visible.vertices);
  }
  for (std::size_t cell = 0; cell < elements.cells.n_rows(); ++cell) {
    visible.cells.push_back(is_cell_left[cell] && all_of(elements.cells[cell], visible.vertices));
  }
  return visible;
}

}  // namespace espalier::viewer
