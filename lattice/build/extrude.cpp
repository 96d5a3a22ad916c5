#include "lattice/build/extrude.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "lattice/build/offsets.h"
#include "lattice/build/prism.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr int kMostLayers = 10000;

void check_faces(const CompressedRows<std::int32_t>& faces, std::size_t n_points,
                 const std::string& name) {
  if (faces.empty()) {
    throw ParameterError(name + ": the mesh has no faces");
  }
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    if (faces[face].size() < 3) {
      throw ParameterError(name + ": face " + std::to_string(face) + " has " +
                           std::to_string(faces[face].size()) + " points, needs three or more");
    }
    for (const std::int32_t point : faces[face]) {
      if (point < 0 || static_cast<std::size_t>(point) >= n_points) {
        throw ParameterError(name + ": face " + std::to_string(face) + ": point " +
                             std::to_string(point) + " does not exist, there are " +
                             std::to_string(n_points));
      }
    }
  }
}

void check_distinct_points(const CompressedRows<std::int32_t>& faces, const std::string& name) {
  VertexLoop sorted;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    sorted.assign(faces[face].begin(), faces[face].end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      throw LatticeError(fmt::format(
          "{}: face {} has point {} twice; the points of a face must differ: remove the face, or "
          "make two of it",
          name, face, *twice));
    }
  }
}

/// New numbers for the points that faces use, in their order; -1 for the others.
std::vector<std::int32_t> number_used(std::size_t n_points,
                                      const CompressedRows<std::int32_t>& faces) {
  std::vector<std::int32_t> number(n_points, -1);
  for (const std::int32_t point : faces.values()) {
    number[static_cast<std::size_t>(point)] = 0;
  }
  std::int32_t n_used = 0;
  for (std::int32_t& one : number) {
    one = one < 0 ? -1 : n_used++;
  }
  return number;
}

/// The points that faces use, and the faces by these.
struct UsedPart {
  std::vector<glm::dvec3> points;
  CompressedRows<std::int32_t> faces;
};

UsedPart used_part(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces) {
  const std::vector<std::int32_t> number = number_used(points.size(), faces);
  UsedPart used;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] >= 0) {
      used.points.push_back(points[i]);
    }
  }
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    VertexLoop loop(faces[face].begin(), faces[face].end());
    for (std::int32_t& point : loop) {
      point = number[static_cast<std::size_t>(point)];
    }
    used.faces.push_back(loop);
  }
  return used;
}

/// Points of `layers` + 1 steps, each moved by its offset in all.
std::vector<glm::dvec3> points_of_steps(std::span<const glm::dvec3> points,
                                        std::span<const glm::dvec3> offsets, int layers) {
  std::vector<glm::dvec3> result;
  result.reserve(points.size() * (static_cast<std::size_t>(layers) + 1));
  for (int layer = 0; layer <= layers; ++layer) {
    const double t = static_cast<double>(layer) / layers;
    for (std::size_t i = 0; i < points.size(); ++i) {
      result.push_back(points[i] + offsets[i] * t);
    }
  }
  return result;
}

/// The edges of loops in their directions, sorted: smaller vertex, larger, whether it runs up.
std::vector<std::array<std::int32_t, 3>> directed_edges(const CompressedRows<std::int32_t>& faces) {
  std::vector<std::array<std::int32_t, 3>> edges;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto loop = faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t from = loop[i];
      const std::int32_t to = loop[(i + 1) % loop.size()];
      edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : 0});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Throws if no edge belongs to one face only.
void check_open(const CompressedRows<std::int32_t>& faces) {
  const auto edges = directed_edges(faces);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1]) {
      ++end;
    }
    if (end == i + 1) {
      return;
    }
    i = end;
  }
  throw ParameterError(
      "extrude: the mesh is closed, only an open surface can be extruded: draw the section of the "
      "lattice, or cut the mesh open");
}

void check_consistent(const CompressedRows<std::int32_t>& faces) {
  const auto edges = directed_edges(faces);
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end()) {
    throw LatticeError(fmt::format(
        "thicken: two faces run along edge {}-{} in the same direction; the mesh needs one outside",
        (*twice)[0], (*twice)[1]));
  }
}

void check_closed(const CompressedRows<std::int32_t>& faces) {
  const auto edges = directed_edges(faces);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1]) {
      ++end;
    }
    if (end - i != 2) {
      throw LatticeError(
          fmt::format("solid: the mesh is not closed: edge {}-{} has {} face{}, needs two",
                      edges[i][0], edges[i][1], end - i, end - i == 1 ? "" : "s"));
    }
    i = end;
  }
}

}  // namespace

void check_layers(int layers, std::size_t n_values) {
  if (layers < 1 || layers > kMostLayers) {
    throw ParameterError("extrude: layers is " + std::to_string(layers) + ", must be 1 to " +
                         std::to_string(kMostLayers));
  }
  // Beyond this the tables of half-faces need more than 31 bits.
  if (n_values * static_cast<std::size_t>(layers) > 200'000'000) {
    throw ParameterError("extrude: more than 200 million faces; use fewer layers");
  }
}

void check_direction(const glm::dvec3& direction) {
  const bool is_finite =
      std::isfinite(direction.x) && std::isfinite(direction.y) && std::isfinite(direction.z);
  if (!is_finite || direction == glm::dvec3(0)) {
    throw ParameterError("extrude: the direction must be finite and not zero");
  }
}

CellMesh stack(std::vector<glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
               std::size_t n_steps, bool is_closed) {
  const std::size_t n = points.size() / n_steps;
  CellLoops cells{static_cast<std::int32_t>(points.size()), {}, {0}};
  for (std::size_t step = 0; step + (is_closed ? 0 : 1) < n_steps; ++step) {
    const auto lower_shift = static_cast<std::int32_t>(step * n);
    const auto upper_shift = static_cast<std::int32_t>((step + 1) % n_steps * n);
    for (std::size_t face = 0; face < faces.n_rows(); ++face) {
      VertexLoop lower(faces[face].begin(), faces[face].end());
      VertexLoop upper = lower;
      for (std::size_t i = 0; i < lower.size(); ++i) {
        lower[i] += lower_shift;
        upper[i] += upper_shift;
      }
      for (const VertexLoop& loop : prism_loops(lower, upper)) {
        cells.loops.push_back(loop);
      }
      cells.cells.push_back(static_cast<std::uint32_t>(cells.loops.n_rows()));
    }
  }
  CellMesh mesh{match_faces(std::move(cells)), std::move(points)};
  orient(mesh.cells, mesh.points);
  return mesh;
}

CellMesh extrude(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
                 const glm::dvec3& direction, int layers) {
  check_faces(faces, points.size(), "extrude");
  check_layers(layers, faces.n_values());
  check_direction(direction);
  check_distinct_points(faces, "extrude");
  check_open(faces);
  const UsedPart used = used_part(points, faces);
  const std::vector<glm::dvec3> offsets(used.points.size(), direction);
  return stack(points_of_steps(used.points, offsets, layers), used.faces,
               static_cast<std::size_t>(layers) + 1);
}

CellMesh thicken(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
                 double thickness, int layers) {
  check_faces(faces, points.size(), "thicken");
  check_layers(layers, faces.n_values());
  if (!std::isfinite(thickness) || thickness == 0) {
    throw ParameterError("thicken: the thickness must be finite and not zero");
  }
  check_distinct_points(faces, "thicken");
  check_consistent(faces);
  const UsedPart used = used_part(points, faces);
  const std::vector<glm::dvec3> offsets = offsets_along_normals(used.points, used.faces, thickness);
  return stack(points_of_steps(used.points, offsets, layers), used.faces,
               static_cast<std::size_t>(layers) + 1);
}

CellMesh solid(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces) {
  check_faces(faces, points.size(), "solid");
  if (faces.n_rows() > kMostSolidFaces) {
    throw ParameterError(fmt::format(
        "solid: the mesh has {} faces, one cell may have at most {}: draw a coarser cage, or make "
        "many cells: --wrap N round the whole mesh, --thicken t along its surface",
        faces.n_rows(), kMostSolidFaces));
  }
  check_distinct_points(faces, "solid");
  check_closed(faces);
  UsedPart used = used_part(points, faces);
  const auto n_faces = static_cast<std::uint32_t>(used.faces.n_rows());
  CellMesh mesh{
      match_faces(
          {static_cast<std::int32_t>(used.points.size()), std::move(used.faces), {0, n_faces}}),
      std::move(used.points)};
  orient(mesh.cells, mesh.points);
  return mesh;
}

}  // namespace espalier
