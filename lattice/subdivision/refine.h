#pragma once

/// One step of Catmull-Clark refinement of a lattice: a new complex, who its elements come from,
/// and its points as combinations of the old ones.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/sharpness.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// The element of the coarser complex that a refined element lies in.
struct Parent {
  enum class Kind { Vertex, Edge, Face, Cell } kind;
  std::int32_t index;
  bool operator==(const Parent&) const = default;
};

/// Who the elements of a refined complex come from. Refined vertices are numbered vertex points,
/// edge points, face points, cell points, each in the order of the coarse elements.
class ParentMap {
 public:
  ParentMap() = default;
  ParentMap(const CellComplex& coarse, std::vector<Parent> faces, std::vector<CellId> cells);

  [[nodiscard]] VertexId vertex_point(VertexId vertex) const { return vertex; }
  [[nodiscard]] VertexId edge_point(EdgeId edge) const { return {first_edge_point_ + edge.value}; }
  [[nodiscard]] VertexId face_point(FaceId face) const { return {first_face_point_ + face.value}; }
  [[nodiscard]] VertexId cell_point(CellId cell) const { return {first_cell_point_ + cell.value}; }

  [[nodiscard]] Parent parent(VertexId refined) const;
  /// A refined edge lies in the larger of the two elements that its ends come from.
  [[nodiscard]] Parent parent(EdgeId refined, const CellComplex& refined_complex) const;
  [[nodiscard]] Parent parent(FaceId refined) const { return faces_[refined.index()]; }
  [[nodiscard]] CellId parent(CellId refined) const { return cells_[refined.index()]; }

 private:
  std::int32_t first_edge_point_ = 0;
  std::int32_t first_face_point_ = 0;
  std::int32_t first_cell_point_ = 0;
  std::vector<Parent> faces_;
  std::vector<CellId> cells_;
};

/// A refined lattice without coordinates.
struct Refinement {
  std::shared_ptr<const CellComplex> complex;
  Sharpness sharpness;
  ParentMap parents;
  StencilTable stencils;  ///< refined vertices over coarse vertices
};

/// Refines once. Each corner of a cell, of valence n in it, gives a cell with 2n faces and 2n + 2
/// vertices; the first such cell of a parent is that of its first vertex. The sharpness must count
/// what touches (with_touching_elements). O(n); throws LatticeError when an element cannot be
/// numbered with 31 bits.
[[nodiscard]] Refinement refine(const CellComplex& complex, const Sharpness& sharpness,
                                Scheme scheme);

/// `levels` refinements in sequence, the coarsest first. Tells `progress` "refine".
[[nodiscard]] std::vector<Refinement> refine(const SubdivisionLattice& lattice, int levels,
                                             const Progress& progress = {});

/// The lattice after `levels` refinements: points, pose and sharpness refined too.
[[nodiscard]] SubdivisionLattice refined(const SubdivisionLattice& lattice, int levels,
                                         const Progress& progress = {});

/// The two edges of the line that an inner vertex lies on, if it lies on one: 2n cells, n + 2 edges
/// and 3n faces, two edges with n ≠ 4 faces each and n edges with four.
[[nodiscard]] std::optional<std::array<EdgeId, 2>> line_edges(const CellComplex& complex,
                                                              VertexId vertex);

}  // namespace espalier
