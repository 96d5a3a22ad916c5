/// The extrusion tool of [MJ96] section 5.

#include "lattice/build/extrude_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "lattice/build/extrude.h"
#include "lattice/build/offsets.h"
#include "lattice/core/error.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/hexahedron.h"

namespace espalier {
namespace {

constexpr double kParallel = 1e-9;

/// What is extruded: the sides of the chosen faces that face the cells behind them.
struct Front {
  std::vector<HalfFaceId> backs;
  IdVector<FaceId, HalfFaceId> back_of;  // invalid for faces that are not chosen

  [[nodiscard]] bool has(FaceId face) const { return back_of[face].is_valid(); }
};

VertexLoop loop_of(const CellComplex& complex, HalfFaceId half_face) {
  VertexLoop numbers;
  for (const VertexId vertex : loop(complex, half_face)) {
    numbers.push_back(vertex.value);
  }
  return numbers;
}

Front front_of(const CellComplex& complex, std::span<const std::int32_t> faces) {
  check_selection(faces, complex.n_faces(), "extrude: face");
  Front front{{}, IdVector<FaceId, HalfFaceId>(complex.n_faces())};
  for (const std::int32_t face : faces) {
    const bool is_boundary = complex.is_boundary(FaceId{face});
    front.backs.push_back(is_boundary ? complex.inner_half_face(FaceId{face})
                                      : HalfFaceId(FaceId{face}, 0));
    front.back_of[FaceId{face}] = front.backs.back();
  }
  return front;
}

/// Turns inner faces towards a direction.
void turn_inner_faces(const CellComplex& complex, std::span<const glm::dvec3> points,
                      const glm::dvec3& direction, Front& front) {
  for (HalfFaceId& back : front.backs) {
    if (complex.is_boundary(back.face())) {
      continue;
    }
    const glm::dvec3 normal = unit_vector(area_vector(points, loop_of(complex, back)));
    const double along = glm::dot(normal, unit_vector(direction));
    if (std::abs(along) <= kParallel) {
      throw LatticeError(
          fmt::format("extrude: inner face {} is parallel to the direction", back.face().value));
    }
    front.back_of[back.face()] = back = along > 0 ? back : back.opposite();
  }
}

/// The cells in front of the chosen faces at a vertex: those reached from them without crossing
/// one. Throws if a cell behind is among them.
std::vector<CellId> cells_in_front(const CellComplex& complex, const Front& front,
                                   VertexId vertex) {
  std::vector<CellId> reached;
  std::vector<CellId> behind;
  const auto has_reached = [&](CellId cell) {
    return std::find(reached.begin(), reached.end(), cell) != reached.end();
  };
  for (const FaceId face : complex.faces(vertex)) {
    if (front.has(face)) {
      behind.push_back(complex.cell(front.back_of[face]));
      const CellId ahead = complex.cell(front.back_of[face].opposite());
      if (ahead.is_valid() && !has_reached(ahead)) {
        reached.push_back(ahead);
      }
    }
  }
  for (std::size_t at = 0; at < reached.size(); ++at) {
    for (const FaceId face : complex.faces(vertex)) {
      const CellId a = complex.cell(HalfFaceId(face, 0));
      const CellId b = complex.cell(HalfFaceId(face, 1));
      const CellId other = a == reached[at] ? b : b == reached[at] ? a : CellId{};
      if (other.is_valid() && !front.has(face) && !has_reached(other)) {
        reached.push_back(other);
      }
    }
  }
  for (const CellId cell : behind) {
    if (has_reached(cell)) {
      throw LatticeError(fmt::format(
          "extrude: the lattice cannot be opened at vertex {}: inner faces must reach the boundary "
          "all round",
          vertex.value));
    }
  }
  return reached;
}

/// Gives the cells in front of the chosen faces at `vertex` the corner `copy` instead.
void move_cells_in_front(const CellComplex& complex, const Front& front, VertexId vertex,
                         std::int32_t copy, MeshDraft& draft) {
  for (const CellId cell : cells_in_front(complex, front, vertex)) {
    for (DraftSide& side : draft.cells[cell.index()].sides) {
      std::replace(side.loop.begin(), side.loop.end(), vertex.value, copy);
      if (side.face >= 0 && front.has(FaceId{side.face})) {
        side.face = -1;
      }
    }
  }
}

Edited extruded(const CellMesh& mesh, const CellComplex& complex, const Front& front,
                std::span<const glm::dvec3> offsets, int layers) {
  check_layers(layers, front.backs.size());
  MeshDraft draft(mesh);
  const std::size_t n = mesh.points.size();
  std::vector<VertexLoop> steps(n);  // of each vertex: itself, then one a layer
  for (const HalfFaceId back : front.backs) {
    for (const VertexId vertex : complex.vertices(back.face())) {
      VertexLoop& column = steps[vertex.index()];
      if (!column.empty()) {
        continue;
      }
      column.push_back(vertex.value);
      for (int layer = 1; layer <= layers; ++layer) {
        const glm::dvec3 offset = offsets[vertex.index()] * (static_cast<double>(layer) / layers);
        column.push_back(draft.add_vertex(mesh.points[vertex.index()] + offset, {{vertex.value}}));
      }
      move_cells_in_front(complex, front, vertex, column.back(), draft);
    }
  }
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(layers); ++layer) {
    for (const HalfFaceId back : front.backs) {
      VertexLoop lower;
      VertexLoop upper;
      for (const std::int32_t vertex : loop_of(complex, back)) {
        lower.push_back(steps[static_cast<std::size_t>(vertex)][layer]);
        upper.push_back(steps[static_cast<std::size_t>(vertex)][layer + 1]);
      }
      draft.add_cell(prism_loops(lower, upper));
    }
  }
  return finished(std::move(draft));
}

}  // namespace

Edited extrude_faces_along(const CellMesh& mesh, std::span<const std::int32_t> faces,
                           const glm::dvec3& by, int layers) {
  check_direction(by);
  const CellComplex complex(mesh.cells);
  Front front = front_of(complex, faces);
  turn_inner_faces(complex, mesh.points, by, front);
  return extruded(mesh, complex, front, std::vector<glm::dvec3>(mesh.points.size(), by), layers);
}

Edited extrude_faces_outward(const CellMesh& mesh, std::span<const std::int32_t> faces,
                             double distance, int layers) {
  if (!std::isfinite(distance) || distance == 0) {
    throw ParameterError("extrude: the distance must be finite and not zero");
  }
  const CellComplex complex(mesh.cells);
  const Front front = front_of(complex, faces);
  CompressedRows<std::int32_t> loops;
  for (const HalfFaceId back : front.backs) {
    loops.push_back(loop_of(complex, back));
  }
  return extruded(mesh, complex, front, offsets_along_normals(mesh.points, loops, distance),
                  layers);
}

Edited extrude_faces_by(const CellMesh& mesh, std::span<const std::int32_t> faces,
                        std::span<const glm::dvec3> offsets, int layers) {
  if (offsets.size() != mesh.points.size()) {
    throw ParameterError(
        fmt::format("extrude: {} offsets for {} vertices", offsets.size(), mesh.points.size()));
  }
  const CellComplex complex(mesh.cells);
  return extruded(mesh, complex, front_of(complex, faces), offsets, layers);
}

}  // namespace espalier
