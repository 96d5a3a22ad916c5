#pragma once

/// Cells of a grid, and which neighbours among them hold together.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "deform/fit/element_grid.h"
#include "lattice/build/cell_mesh.h"

namespace espalier {

/// Cells of a grid as a lattice with what it takes to shape it further.
struct GridCells {
  CellMesh mesh;                      ///< cells as the set's, vertices apart where cells are
  std::vector<std::size_t> elements;  ///< #cells: the grid's element
  std::vector<std::array<std::int32_t, 8>> corners;  ///< #cells, as in index_order.h
  std::vector<char> is_fixed;  ///< #vertices: not the only one of its node, or where a slit ends
  std::vector<char>
      is_sharp;  ///< #vertices: all boundary edges there must be sharp, see make_cells
};

/// A set of cells, and of faces through which neighbours are joined. Neighbours that are not joined
/// there may yet share vertices, where a way leads from one to the other round the vertex.
class CellSet {
 public:
  /// The cells that are touched or inside; neighbours are joined where the surface passes their
  /// face, or it is inside.
  explicit CellSet(const ElementGrid& grid);

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] bool has(const ElementPlace& place) const {
    return frame_.contains(place) && has_[frame_.index(place)] != 0;
  }

  /// Makes the eight cells round a node cells of the set, joined with each other. Whether that
  /// changes anything.
  bool fill_around(const ElementPlace& node);

  /// The cells as hexahedra, each copy of a vertex drawn back from the others by `gap` steps.
  ///
  /// At some vertices the volume with automatic tags is folded: where cells meet only in an edge,
  /// where three cells stand on three faces of a fourth, and at the corners of slits. Checked for
  /// all arrangements of eight cells: with all boundary edges at these vertices sharp none folds.
  [[nodiscard]] GridCells make_cells(double gap) const;

 private:
  /// Which of the eight cells round a node, bit q = i + 2j + 4k, hold together there.
  struct Fan {
    unsigned cells = 0;
    bool has_slit = false;         ///< neighbours that are not joined
    bool has_corner_slit = false;  ///< other than straight through
  };
  [[nodiscard]] ElementPlace cell_round(const ElementPlace& node, unsigned q) const;
  /// The fan that cell q belongs to.
  [[nodiscard]] Fan fan_of(const ElementPlace& node, unsigned q) const;
  [[nodiscard]] bool is_joined(const ElementPlace& node, unsigned q, unsigned axis) const;

  GridFrame frame_;
  std::vector<char> has_;  // #elements: cells of the set, and faces through which they are joined
};

}  // namespace espalier
