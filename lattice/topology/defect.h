#pragma once

/// What can be wrong with a lattice.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// Kinds of defects, structural ones (no coordinates needed) first.
enum class DefectKind {
  NoCells,
  IndexOutOfRange,
  FaceTooSmall,       ///< fewer than three vertices
  FaceRepeatsVertex,  ///< so one of its edges has coinciding ends, or it touches itself
  DuplicateFace,      ///< two faces with the same vertices
  CellTooSmall,       ///< fewer than four faces
  CellRepeatsFace,    ///< one face twice in a cell
  FaceUsedTooOften,   ///< by three cells or more
  CellNotClosed,      ///< an edge of the cell without two of its faces
  CellNotSphere,      ///< more than one shell, a handle, or a shell that touches itself
  CellsOnOneSide,     ///< two cells on the same side of their face: no orientation exists
  UnusedFace,
  UnusedVertex,
  TooFewFacesAtEdge,  ///< an inner edge with two faces
  EdgeEnclosedTwice,  ///< a ring of cells round an edge, and more cells at it
  NotFinite,          ///< a coordinate that is no number, infinite or beyond 1e18
  ZeroLengthEdge,     ///< an edge whose ends coincide
  SelfTouchingCell,   ///< two vertices of one cell at the same place
  InvertedCell,       ///< no volume, or a negative one
  VertexInsideEdge,   ///< a vertex inside an edge that does not contain it
  VertexInsideFace,   ///< a vertex inside a face that does not contain it
  IntersectingCells,
};

/// The kind's name in reports, such as "cell-not-closed".
[[nodiscard]] std::string_view name_of(DefectKind kind);

/// One defect of one element.
struct Defect {
  DefectKind kind{};
  std::string element;      ///< "cell", "face", "edge" or "vertex"
  std::int64_t index = -1;  ///< of the element in its table; -1 for an edge, named in the message
  std::string message;      ///< one sentence: "cell 3: its edge 4-7 has one face, needs two"
};

/// Throws LatticeError with the first defect's message and the number of others, if there are any.
void throw_if_defective(const std::vector<Defect>& defects);

}  // namespace espalier
