#include "lattice/build/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "lattice/build/hull.h"
#include "lattice/build/offsets.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr std::size_t kMostVertices = 64;

/// The loop of a boundary face, counter-clockwise seen from outside.
VertexLoop outward_loop(const CellMesh& mesh, std::int32_t face) {
  const auto uses = mesh.cells.cells.values();
  const auto is_of_face = [face](std::int32_t half_face) { return half_face >> 1 == face; };
  const auto n = std::count_if(uses.begin(), uses.end(), is_of_face);
  if (n != 1) {
    throw LatticeError(fmt::format(
        "attach: face {} is between two cells, only boundary faces can be attached to", face));
  }
  const auto row = mesh.cells.faces[static_cast<std::size_t>(face)];
  VertexLoop loop(row.begin(), row.end());
  if ((*std::find_if(uses.begin(), uses.end(), is_of_face) & 1) != 0) {
    std::reverse(loop.begin(), loop.end());
  }
  return loop;
}

glm::dvec3 centroid(std::span<const glm::dvec3> points, const VertexLoop& loop) {
  glm::dvec3 sum(0);
  for (const std::int32_t vertex : loop) {
    sum += points[static_cast<std::size_t>(vertex)] / static_cast<double>(loop.size());
  }
  return sum;
}

/// `vector` turned the shortest way from direction `from` to `to`; half a turn goes about the axis
/// across `from` and `hint`. from, to: unit vectors.
glm::dvec3 turned(const glm::dvec3& vector, const glm::dvec3& from, const glm::dvec3& to,
                  const glm::dvec3& hint) {
  constexpr double kOpposite = 1e-9;
  const double cosine = glm::dot(from, to);
  if (1 + cosine > kOpposite) {
    const glm::dvec3 axis = glm::cross(from, to);
    return vector * cosine + glm::cross(axis, vector) +
           axis * (glm::dot(axis, vector) / (1 + cosine));
  }
  const glm::dvec3 axis = unit_vector(glm::cross(from, hint));
  return axis * (2 * glm::dot(axis, vector)) - vector;
}

/// The second loop, turned round and rotated so that its vertices are the first's partners.
VertexLoop partners_of(std::span<const glm::dvec3> points, const VertexLoop& first,
                       VertexLoop second) {
  const glm::dvec3 from = centroid(points, first);
  const glm::dvec3 to = centroid(points, second);
  const glm::dvec3 normal = unit_vector(area_vector(points, first));
  const glm::dvec3 facing = -unit_vector(area_vector(points, second));
  std::reverse(second.begin(), second.end());
  const auto twist = [&](const VertexLoop& loop) {
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec3 arm =
          turned(points[static_cast<std::size_t>(first[i])] - from, normal, facing, to - from);
      const glm::dvec3 gap = points[static_cast<std::size_t>(loop[i])] - to - arm;
      sum += glm::dot(gap, gap);
    }
    return sum;
  };
  constexpr double kSlack = 1 - 1e-9;  // equal but for rounding: the first found stays
  VertexLoop best = second;
  double least = twist(best);
  for (std::size_t i = 1; i < second.size(); ++i) {
    std::rotate(second.begin(), second.begin() + 1, second.end());
    if (const double sum = twist(second); sum < least * kSlack) {
      least = sum;
      best = second;
    }
  }
  return best;
}

bool is_within(const VertexLoop& loop, const VertexLoop& face) {
  return std::all_of(loop.begin(), loop.end(), [&](std::int32_t vertex) {
    return std::find(face.begin(), face.end(), vertex) != face.end();
  });
}

/// Replaces the hull's faces that lie within a chosen face by it.
void put_face(const VertexLoop& face, std::int32_t number, std::vector<VertexLoop>& hull) {
  const std::size_t n_before = hull.size();
  std::erase_if(hull, [&](const VertexLoop& loop) { return is_within(loop, face); });
  if (hull.size() == n_before) {
    throw LatticeError(
        fmt::format("attach: face {} is not on the outside of what the chosen faces and vertices "
                    "span",
                    number));
  }
  hull.push_back(face);
}

}  // namespace

Edited bridge_faces(const CellMesh& mesh, std::int32_t first, std::int32_t second) {
  check_selection(std::array{first, second}, mesh.cells.faces.n_rows(), "attach: face");
  const VertexLoop lower = outward_loop(mesh, first);
  const VertexLoop upper = outward_loop(mesh, second);
  if (lower.size() != upper.size()) {
    throw ParameterError(fmt::format(
        "attach: face {} has {} vertices and face {} has {}; only faces of equal size are bridged",
        first, lower.size(), second, upper.size()));
  }
  MeshDraft draft(mesh);
  draft.add_cell(prism_loops(lower, partners_of(mesh.points, lower, upper)));
  return finished(std::move(draft));
}

Edited add_spanned_cell(const CellMesh& mesh, std::span<const std::int32_t> faces,
                        std::span<const std::int32_t> vertices) {
  VertexLoop corners;
  std::vector<VertexLoop> loops;
  if (!faces.empty() || vertices.empty()) {
    check_selection(faces, mesh.cells.faces.n_rows(), "attach: face");
  }
  if (!vertices.empty()) {
    check_selection(vertices, mesh.points.size(), "attach: vertex");
  }
  for (const std::int32_t face : faces) {
    loops.push_back(outward_loop(mesh, face));
    corners.insert(corners.end(), loops.back().begin(), loops.back().end());
  }
  corners.insert(corners.end(), vertices.begin(), vertices.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() > kMostVertices) {
    throw ParameterError(fmt::format("attach: {} vertices are chosen, a cell may have {}",
                                     corners.size(), kMostVertices));
  }
  std::vector<VertexLoop> hull = convex_hull(mesh.points, corners);
  if (hull.empty()) {
    throw LatticeError("attach: the chosen faces and vertices span no volume");
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    put_face(loops[i], faces[i], hull);
  }
  MeshDraft draft(mesh);
  draft.add_cell(std::move(hull));
  return finished(std::move(draft));
}

Edited delete_cells(const CellMesh& mesh, std::span<const std::int32_t> cells) {
  check_selection(cells, mesh.cells.cells.n_rows(), "delete: cell");
  if (cells.size() == mesh.cells.cells.n_rows()) {
    throw LatticeError("delete: no cell would be left");
  }
  MeshDraft draft(mesh);
  for (const std::int32_t cell : cells) {
    draft.cells[static_cast<std::size_t>(cell)].sides.clear();
  }
  return finished(std::move(draft));
}

}  // namespace espalier
