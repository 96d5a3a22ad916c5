#include "lattice/build/extrude.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr int kMostLayers = 10000;

void check_faces(const CompressedRows<std::int32_t>& faces, std::size_t n_points) {
  if (faces.empty()) {
    throw ParameterError("extrude: the mesh has no faces");
  }
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    if (faces[face].size() < 3) {
      throw ParameterError("extrude: face " + std::to_string(face) + " has " +
                           std::to_string(faces[face].size()) + " points, needs three or more");
    }
    for (const std::int32_t point : faces[face]) {
      if (point < 0 || static_cast<std::size_t>(point) >= n_points) {
        throw ParameterError("extrude: face " + std::to_string(face) + ": point " +
                             std::to_string(point) + " does not exist, there are " +
                             std::to_string(n_points));
      }
    }
  }
}

/// Throws if no edge belongs to one face only.
void check_open(const CompressedRows<std::int32_t>& faces) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto loop = faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      edges.push_back(std::minmax({loop[i], loop[(i + 1) % loop.size()]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    const auto end =
        std::upper_bound(edges.begin() + static_cast<std::ptrdiff_t>(i), edges.end(), edges[i]) -
        edges.begin();
    if (static_cast<std::size_t>(end) == i + 1) {
      return;
    }
    i = static_cast<std::size_t>(end);
  }
  throw ParameterError(
      "extrude: the mesh is closed, only an open surface can be extruded: draw the section of the "
      "lattice, or cut the mesh open");
}

void check_steps(const CompressedRows<std::int32_t>& faces, const glm::dvec3& direction,
                 int layers) {
  if (layers < 1 || layers > kMostLayers) {
    throw ParameterError("extrude: layers is " + std::to_string(layers) + ", must be 1 to " +
                         std::to_string(kMostLayers));
  }
  const bool is_finite =
      std::isfinite(direction.x) && std::isfinite(direction.y) && std::isfinite(direction.z);
  if (!is_finite || direction == glm::dvec3(0)) {
    throw ParameterError("extrude: the direction must be finite and not zero");
  }
  // Beyond this the tables of half-faces need more than 31 bits.
  if (faces.n_values() * static_cast<std::size_t>(layers) > 200'000'000) {
    throw ParameterError("extrude: more than 200 million faces; use fewer layers");
  }
}

/// New numbers for the points that faces use, in their order; -1 for the others.
std::vector<std::int32_t> number_used(std::size_t n_points,
                                      const CompressedRows<std::int32_t>& faces,
                                      std::int32_t& n_used) {
  std::vector<std::int32_t> number(n_points, -1);
  for (const std::int32_t point : faces.values()) {
    number[static_cast<std::size_t>(point)] = 0;
  }
  n_used = 0;
  for (std::int32_t& one : number) {
    one = one < 0 ? -1 : n_used++;
  }
  return number;
}

/// Appends the prism over `base` (vertices of one step) to the step n vertices further on.
void add_prism(std::span<const std::int32_t> base, std::int32_t n, CellLoops& cells) {
  std::vector<std::int32_t> loop(base.begin(), base.end());
  std::reverse(loop.begin(), loop.end());
  cells.loops.push_back(loop);
  for (std::size_t i = 0; i < base.size(); ++i) {
    const std::int32_t a = base[i];
    const std::int32_t b = base[(i + 1) % base.size()];
    const std::array<std::int32_t, 4> side = {a, b, b + n, a + n};
    cells.loops.push_back(side);
  }
  std::transform(base.begin(), base.end(), loop.begin(), [n](std::int32_t v) { return v + n; });
  cells.loops.push_back(loop);
  cells.cells.push_back(static_cast<std::uint32_t>(cells.loops.n_rows()));
}

}  // namespace

CellMesh extrude(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
                 const glm::dvec3& direction, int layers) {
  check_faces(faces, points.size());
  check_steps(faces, direction, layers);
  check_open(faces);
  std::int32_t n = 0;
  const std::vector<std::int32_t> number = number_used(points.size(), faces, n);

  CellMesh mesh;
  for (int layer = 0; layer <= layers; ++layer) {
    const glm::dvec3 offset = direction * (static_cast<double>(layer) / layers);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (number[i] >= 0) {
        mesh.points.push_back(points[i] + offset);
      }
    }
  }
  CellLoops cells{static_cast<std::int32_t>(mesh.points.size()), {}, {0}};
  for (int layer = 0; layer < layers; ++layer) {
    for (std::size_t face = 0; face < faces.n_rows(); ++face) {
      std::vector<std::int32_t> base;
      for (const std::int32_t point : faces[face]) {
        base.push_back(number[static_cast<std::size_t>(point)] + layer * n);
      }
      add_prism(base, n, cells);
    }
  }
  mesh.cells = match_faces(std::move(cells));
  orient(mesh.cells, mesh.points);
  return mesh;
}

}  // namespace espalier
