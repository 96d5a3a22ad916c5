#pragma once

/// The frame that all edits of a mesh share: a mesh taken apart into cells that each bring their
/// own faces, changed freely, and put together again with a record of what became of what.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/build/cell_mesh.h"
#include "lattice/build/prism.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

/// Where the elements of a mesh are after an edit: new indices, -1 if gone. An element that was
/// split goes to its first part. Edges follow from their vertices.
struct ElementMap {
  std::vector<std::int32_t> vertices;  ///< #old vertices
  std::vector<std::int32_t> faces;     ///< #old faces
  std::vector<std::int32_t> cells;     ///< #old cells
};

/// A share of an old vertex in a new one.
struct Source {
  std::int32_t vertex = 0;
  double weight = 1;
  bool operator==(const Source&) const = default;
};

/// A mesh after an edit. It may be no valid complex; see edited_lattice().
struct Edited {
  CellMesh mesh;
  ElementMap map;
  /// A row for each new vertex: what it was made from; weights sum to 1. A pose follows them: the
  /// displacement of a new vertex is the mean of its sources', turned.
  CompressedRows<Source> sources;
  std::vector<glm::dmat3> turns;  ///< #new vertices: how displacements turn
};

/// A vertex of a draft.
struct DraftVertex {
  glm::dvec3 point{0};
  std::vector<Source> sources;
  glm::dmat3 turn{1};
};

/// A face as one of its cells sees it.
struct DraftSide {
  VertexLoop loop;         ///< of draft vertices
  std::int32_t face = -1;  ///< the old face; -1: a new one
};

struct DraftCell {
  std::vector<DraftSide> sides;
  std::int32_t cell = -1;  ///< the old cell; -1: a new one
};

/// A mesh in the making. Begins with the old mesh's vertices and cells, loops counter-clockwise
/// seen from outside; faces are shared again in finished().
struct MeshDraft {
  explicit MeshDraft(const CellMesh& mesh);

  /// Adds a vertex and returns its index.
  std::int32_t add_vertex(const glm::dvec3& point, std::vector<Source> sources,
                          const glm::dmat3& turn = glm::dmat3(1));
  /// Adds a cell with new faces.
  void add_cell(std::vector<VertexLoop> loops);

  std::vector<DraftVertex> vertices;
  std::vector<DraftCell> cells;          ///< one without sides is gone
  std::vector<std::int32_t> vertex_map;  ///< #old vertices: which draft vertex each has become
  std::size_t n_old_faces = 0;
  std::size_t n_old_cells = 0;
};

/// The mesh of a draft: edges whose ends are one vertex vanish, then faces with fewer than three
/// vertices, cells with fewer than four faces and vertices of no cell; faces with the same
/// vertices become one; elements keep their order, new ones follow; cells are oriented. O(n log n).
[[nodiscard]] Edited finished(MeshDraft draft);

/// Throws ParameterError naming `what` ("extrude: face") if an index is not below n or given twice,
/// or none is given.
void check_selection(std::span<const std::int32_t> indices, std::size_t n, const char* what);

}  // namespace espalier
