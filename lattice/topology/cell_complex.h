#pragma once

/// The immutable radial-edge structure of a lattice: vertices, edges, faces and cells, and every
/// incidence between them as a look-up. After K. Weiler, "The radial edge structure", 1988.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "lattice/core/ids.h"
#include "lattice/topology/polyhedra.h"

namespace espalier {

/// A valid cell complex without coordinates: any number of faces at an edge, at most two cells at
/// a face, cells with any number of faces of any size. Never changes; copying it is deep.
class CellComplex {
 public:
  CellComplex() = default;

  /// Builds from oriented tables (see orient()); faces and cells keep their order, edges are sorted
  /// by their vertices. Throws LatticeError naming the first structural defect.
  /// O(n); about 400 bytes a hexahedron.
  explicit CellComplex(Polyhedra polyhedra);

  /// The same for tables that are known to be valid, such as those of a refinement: unchecked.
  [[nodiscard]] static CellComplex from_valid(Polyhedra polyhedra);

  [[nodiscard]] std::size_t n_vertices() const { return vertex_edges_.n_rows(); }
  [[nodiscard]] std::size_t n_edges() const { return edge_vertices_.size(); }
  [[nodiscard]] std::size_t n_faces() const { return face_vertices_.n_rows(); }
  [[nodiscard]] std::size_t n_cells() const { return cell_half_faces_.n_rows(); }

  [[nodiscard]] IdRange<VertexId> vertices() const { return IdRange<VertexId>(n_vertices()); }
  [[nodiscard]] IdRange<EdgeId> edges() const { return IdRange<EdgeId>(n_edges()); }
  [[nodiscard]] IdRange<FaceId> faces() const { return IdRange<FaceId>(n_faces()); }
  [[nodiscard]] IdRange<CellId> cells() const { return IdRange<CellId>(n_cells()); }

  // Downward.

  /// The smaller vertex first.
  [[nodiscard]] const std::array<VertexId, 2>& vertices(EdgeId edge) const {
    return edge_vertices_[edge];
  }
  /// The loop of side 0.
  [[nodiscard]] std::span<const VertexId> vertices(FaceId face) const {
    return face_vertices_[face.index()];
  }
  /// Edge i joins vertices i and i + 1 of the loop.
  [[nodiscard]] std::span<const EdgeId> edges(FaceId face) const {
    return {face_edges_.data() + face_vertices_.offset(face.index()),
            face_vertices_[face.index()].size()};
  }
  /// The shell, sides facing outward.
  [[nodiscard]] std::span<const HalfFaceId> half_faces(CellId cell) const {
    return cell_half_faces_[cell.index()];
  }
  /// Ascending.
  [[nodiscard]] std::span<const VertexId> vertices(CellId cell) const {
    return cell_vertices_[cell.index()];
  }

  // Upward.

  [[nodiscard]] std::span<const EdgeId> edges(VertexId vertex) const {
    return vertex_edges_[vertex.index()];
  }
  [[nodiscard]] std::span<const FaceId> faces(VertexId vertex) const {
    return vertex_faces_[vertex.index()];
  }
  [[nodiscard]] std::span<const CellId> cells(VertexId vertex) const {
    return vertex_cells_[vertex.index()];
  }
  /// The faces at an edge in radial order, each by the side whose loop runs from the edge's first
  /// vertex to its second: the cell of that side lies between this face and the next. Where that
  /// side has no cell the fan ends, and the next face begins another. The order is cyclic.
  [[nodiscard]] std::span<const HalfFaceId> half_faces(EdgeId edge) const {
    return edge_half_faces_[edge.index()];
  }

  // Across.

  /// The cell behind one side of a face; invalid on the boundary.
  [[nodiscard]] CellId cell(HalfFaceId half_face) const { return half_face_cells_[half_face]; }
  [[nodiscard]] int n_cells(FaceId face) const {
    return static_cast<int>(cell(HalfFaceId(face, 0)).is_valid()) +
           static_cast<int>(cell(HalfFaceId(face, 1)).is_valid());
  }
  /// Cells round an edge: its faces, less one for every fan that is open.
  [[nodiscard]] int n_cells(EdgeId edge) const;
  /// Open fans round an edge: 0 inside, 1 on the boundary, more where cells meet only in the edge.
  [[nodiscard]] int n_open_fans(EdgeId edge) const;

  [[nodiscard]] bool is_boundary(FaceId face) const { return n_cells(face) < 2; }
  [[nodiscard]] bool is_boundary(EdgeId edge) const { return edge_is_boundary_[edge]; }
  [[nodiscard]] bool is_boundary(VertexId vertex) const { return vertex_is_boundary_[vertex]; }
  /// The side of a boundary face that faces its cell: its loop is the boundary's outward loop.
  [[nodiscard]] HalfFaceId inner_half_face(FaceId face) const {
    return {face, cell(HalfFaceId(face, 0)).is_valid() ? 0 : 1};
  }

  /// The edge between two vertices; invalid if there is none. O(edges at a).
  [[nodiscard]] EdgeId find_edge(VertexId a, VertexId b) const;
  /// The vertex of an edge that is not `vertex`.
  [[nodiscard]] VertexId other_end(EdgeId edge, VertexId vertex) const {
    const auto& ends = vertices(edge);
    return ends[0] == vertex ? ends[1] : ends[0];
  }
  /// Whether the side's loop runs from the edge's first vertex to its second.
  [[nodiscard]] bool runs_along(HalfFaceId half_face, EdgeId edge) const;

  /// The tables it was built from.
  [[nodiscard]] Polyhedra polyhedra() const;
  /// Heap memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void build(Polyhedra polyhedra);
  void build_edges();
  void build_cells(const CompressedRows<std::int32_t>& cells);
  void build_upward_incidences();
  void build_radial_order();
  void mark_boundary();

  CompressedRows<VertexId> face_vertices_;
  std::vector<EdgeId> face_edges_;  // rows as in face_vertices_
  IdVector<EdgeId, std::array<VertexId, 2>> edge_vertices_;
  CompressedRows<HalfFaceId> cell_half_faces_;
  CompressedRows<VertexId> cell_vertices_;
  IdVector<HalfFaceId, CellId> half_face_cells_;
  CompressedRows<EdgeId> vertex_edges_;
  CompressedRows<FaceId> vertex_faces_;
  CompressedRows<CellId> vertex_cells_;
  CompressedRows<HalfFaceId> edge_half_faces_;
  IdVector<EdgeId, bool> edge_is_boundary_;
  IdVector<VertexId, bool> vertex_is_boundary_;
};

}  // namespace espalier
