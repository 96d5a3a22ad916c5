/// The boundary of a Catmull-Clark volume.

#include "lattice/subdivision/subdivision_boundary.h"

#include <algorithm>
#include <set>
#include <string>

#include "lattice/core/error.h"
#include "lattice/osd/refine_surface.h"
#include "lattice/topology/hexahedron.h"
#include "lattice/topology/sharpness.h"

namespace espalier {
namespace {

/// Refinements of the boundary: a face becomes about 16 quadrilaterals.
constexpr int kBoundaryLevels = 2;

std::vector<FaceId> boundary_faces(const CellComplex& complex) {
  std::vector<FaceId> faces;
  for (const FaceId face : complex.faces()) {
    if (complex.is_boundary(face)) {
      faces.push_back(face);
    }
  }
  return faces;
}

osd::SurfaceTags tags_of(const CellComplex& complex, const Sharpness& sharpness) {
  osd::SurfaceTags tags;
  for (const EdgeId edge : complex.edges()) {
    if (sharpness.edges[edge] > 0) {
      const auto& ends = complex.vertices(edge);
      tags.edges.push_back({ends[0].value, ends[1].value});
      tags.edge_sharpness.push_back(sharpness.edges[edge]);
    }
  }
  for (const VertexId vertex : complex.vertices()) {
    if (sharpness.vertices[vertex] > 0) {
      tags.vertices.push_back(vertex.value);
      tags.vertex_sharpness.push_back(sharpness.vertices[vertex]);
    }
  }
  return tags;
}

/// The boundary faces that share `vertex` and that the surface at `first` depends on there: those
/// before a crease, on either side. An edge with more than two boundary faces counts as a crease.
std::vector<FaceId> smooth_fan(const CellComplex& complex, const Sharpness& sharpness, FaceId first,
                               VertexId vertex) {
  std::vector<FaceId> fan = {first};
  for (std::size_t i = 0; i < fan.size(); ++i) {
    for (const EdgeId edge : complex.edges(fan[i])) {
      const auto& ends = complex.vertices(edge);
      if ((ends[0] != vertex && ends[1] != vertex) || sharpness.edges[edge] >= kInfiniteSharpness) {
        continue;
      }
      for (const HalfFaceId half_face : complex.half_faces(edge)) {
        const FaceId next = half_face.face();
        if (complex.is_boundary(next) && std::find(fan.begin(), fan.end(), next) == fan.end()) {
          fan.push_back(next);
        }
      }
    }
  }
  return fan;
}

FaceId boundary_face(const CellComplex& complex, std::int32_t face) {
  if (face < 0 || static_cast<std::size_t>(face) >= complex.n_faces()) {
    throw ParameterError("face " + std::to_string(face) + " does not exist: the lattice has " +
                         std::to_string(complex.n_faces()));
  }
  if (!complex.is_boundary(FaceId{face})) {
    throw ParameterError("face " + std::to_string(face) +
                         " lies between two cells: only boundary faces can be locked");
  }
  return FaceId{face};
}

}  // namespace

BoundarySurface boundary_surface(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  const std::vector<FaceId> faces = boundary_faces(complex);
  CompressedRows<std::int32_t> loops;
  for (const FaceId face : faces) {
    std::vector<std::int32_t> corners;
    for (const VertexId vertex : loop(complex, complex.inner_half_face(face))) {
      corners.push_back(vertex.value);
    }
    loops.push_back(corners);
  }
  const Sharpness sharpness = with_touching_elements(complex, lattice.sharpness);
  osd::SurfaceRefinement refined = osd::surface_refinement(
      complex.n_vertices(), loops, tags_of(complex, sharpness), kBoundaryLevels);
  for (std::int32_t& parent : refined.parents) {
    parent = faces[static_cast<std::size_t>(parent)].value;
  }
  return {std::move(refined.points), std::move(refined.faces), std::move(refined.parents)};
}

std::vector<std::int32_t> unmoved_controls(const SubdivisionLattice& lattice,
                                           std::span<const std::int32_t> faces,
                                           Continuity continuity) {
  const CellComplex& complex = *lattice.complex;
  const Sharpness sharpness = with_touching_elements(complex, lattice.sharpness);
  std::set<std::int32_t> controls;
  const auto add_all = [&](std::span<const VertexId> vertices) {
    for (const VertexId vertex : vertices) {
      controls.insert(vertex.value);
    }
  };
  for (const std::int32_t index : faces) {
    const FaceId face = boundary_face(complex, index);
    for (const VertexId vertex : complex.vertices(face)) {
      if (continuity == Continuity::C0) {
        for (const FaceId near : smooth_fan(complex, sharpness, face, vertex)) {
          add_all(complex.vertices(near));
        }
        continue;
      }
      for (const CellId cell : complex.cells(vertex)) {
        add_all(complex.vertices(cell));
      }
    }
  }
  return {controls.begin(), controls.end()};
}

}  // namespace espalier
