#include "lattice/build/weld.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "lattice/build/offsets.h"
#include "lattice/core/box_tree.h"
#include "lattice/core/disjoint_sets.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr double kUsualTolerance = 1e-6;

void check_tolerance(double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    throw ParameterError("the tolerance must be a length, 0 or more");
  }
}

/// For each point the smallest index of those it coincides with, directly or through others.
std::vector<std::size_t> clusters_of(const std::vector<glm::dvec3>& points, double tolerance) {
  std::vector<Box> boxes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    boxes[i].add(points[i]);
  }
  const BoxTree tree(std::move(boxes));
  DisjointSets sets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    tree.visit_overlapping(tree.box(i).grown(tolerance), [&](std::size_t j) {
      if (j < i && glm::distance(points[i], points[j]) <= tolerance) {
        sets.join(i, j);
      }
    });
  }
  std::vector<std::size_t> first(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    first[i] = sets.first(i);
  }
  return first;
}

/// The mean of a vertex's sources, exact where they coincide.
glm::dvec3 mean_of(const std::vector<glm::dvec3>& points, const std::vector<Source>& sources) {
  const glm::dvec3 first = points[static_cast<std::size_t>(sources.front().vertex)];
  glm::dvec3 sum(0);
  for (const Source& source : sources) {
    sum += points[static_cast<std::size_t>(source.vertex)] - first;
  }
  return first + sum / static_cast<double>(sources.size());
}

void append_rows(CompressedRows<std::int32_t>& rows, const CompressedRows<std::int32_t>& more,
                 std::int32_t shift) {
  for (std::size_t i = 0; i < more.n_rows(); ++i) {
    std::vector<std::int32_t> row(more[i].begin(), more[i].end());
    for (std::int32_t& value : row) {
      value += shift;
    }
    rows.push_back(row);
  }
}

}  // namespace

Edited weld(const CellMesh& mesh, double tolerance) {
  check_tolerance(tolerance);
  MeshDraft draft(mesh);
  const std::vector<std::size_t> cluster = clusters_of(mesh.points, tolerance);
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    if (cluster[i] != i) {
      draft.vertex_map[i] = static_cast<std::int32_t>(cluster[i]);
      draft.vertices[cluster[i]].sources.push_back({static_cast<std::int32_t>(i)});
    }
  }
  for (DraftVertex& vertex : draft.vertices) {
    vertex.point = mean_of(mesh.points, vertex.sources);
    for (Source& source : vertex.sources) {
      source.weight = 1.0 / static_cast<double>(vertex.sources.size());
    }
  }
  for (DraftCell& cell : draft.cells) {
    for (DraftSide& side : cell.sides) {
      for (std::int32_t& vertex : side.loop) {
        vertex = draft.vertex_map[static_cast<std::size_t>(vertex)];
      }
    }
  }
  return finished(std::move(draft));
}

CellMesh side_by_side(const CellMesh& first, const CellMesh& second) {
  CellMesh both = first;
  both.points.insert(both.points.end(), second.points.begin(), second.points.end());
  both.cells.n_vertices += second.cells.n_vertices;
  append_rows(both.cells.faces, second.cells.faces, first.cells.n_vertices);
  append_rows(both.cells.cells, second.cells.cells,
              2 * static_cast<std::int32_t>(first.cells.faces.n_rows()));
  return both;
}

Edited mirror(const CellMesh& mesh, const glm::dvec3& point, const glm::dvec3& normal,
              double tolerance) {
  check_tolerance(tolerance);
  const glm::dvec3 axis = unit_vector(normal);
  if (!(glm::length(axis) > 0.5)) {  // also false for a NaN
    throw ParameterError("mirror: the normal must be finite and not zero");
  }
  const glm::dmat3 turn = glm::dmat3(1) - 2.0 * glm::outerProduct(axis, axis);
  MeshDraft draft(mesh);
  VertexLoop image(mesh.points.size());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double height = glm::dot(mesh.points[i] - point, axis);
    const auto vertex = static_cast<std::int32_t>(i);
    if (std::abs(height) <= tolerance) {
      draft.vertices[i].point -= height * axis;
      image[i] = vertex;
    } else {
      image[i] = draft.add_vertex(mesh.points[i] - 2 * height * axis, {{vertex}}, turn);
    }
  }
  for (std::size_t cell = 0; cell < draft.n_old_cells; ++cell) {
    std::vector<VertexLoop> loops;
    for (const DraftSide& side : draft.cells[cell].sides) {
      VertexLoop& loop = loops.emplace_back(side.loop.rbegin(), side.loop.rend());
      for (std::int32_t& vertex : loop) {
        vertex = image[static_cast<std::size_t>(vertex)];
      }
    }
    draft.add_cell(std::move(loops));
  }
  return finished(std::move(draft));
}

double usual_tolerance(const CellMesh& mesh) {
  return 2 * kUsualTolerance * box_of(mesh.points).radius();
}

}  // namespace espalier
