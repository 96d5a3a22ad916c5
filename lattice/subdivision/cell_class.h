#pragma once

/// What the volume is over a cell of a Catmull-Clark lattice.

#include <array>
#include <vector>

#include "lattice/subdivision/hexahedra.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/sharpness.h"

namespace espalier {

/// Regular: one tricubic patch. Line: a Catmull-Clark surface across times a cubic along `axis`.
/// Other: only refinement tells.
struct CellClass {
  enum class Kind { Regular, Line, Other } kind = Kind::Other;
  int axis = -1;  ///< of a line cell, in its own directions
};

/// Classifies the cells of a complex. The sharpness must count what touches.
class CellClassifier {
 public:
  CellClassifier(const Hexahedra& hexahedra, const Sharpness& sharpness, Scheme scheme);

  [[nodiscard]] CellClass classify(CellId cell) const;

  /// Inside, 8 cells and 6 edges with 4 faces each; on a smooth boundary, 4 cells and 5 edges; on a
  /// sharp line, 2 cells with just the two edges of one cell sharp; a corner of one cell with sharp
  /// edges. Nothing of finite sharpness.
  [[nodiscard]] bool is_regular(VertexId vertex) const;

 private:
  [[nodiscard]] bool has_hexahedra_only(VertexId vertex) const;
  [[nodiscard]] bool is_on_line(VertexId vertex, EdgeId along) const;
  /// Whether boundary edges are infinitely sharp where one cell only has them, else smooth.
  [[nodiscard]] bool has_automatic_sharpness(VertexId vertex) const;

  const Hexahedra& hexahedra_;
  const CellComplex& complex_;
  const Sharpness& sharpness_;
  Scheme scheme_;
};

/// The control points of a regular cell.
struct RegularBlock {
  std::array<bool, 3> natural_begin{};  ///< no points beyond the cell at 0, by axis
  std::array<bool, 3> natural_end{};    ///< the same at 1
  std::array<int, 3> size{};            ///< 4, 3 or 2 points an axis
  std::vector<VertexId> points;         ///< u fastest
};

/// The block of a regular cell in the directions of its frame.
[[nodiscard]] RegularBlock regular_block(const Hexahedra& hexahedra, const Frame& frame);

}  // namespace espalier
