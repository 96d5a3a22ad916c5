#pragma once

/// What readers of volume meshes share: points and cells of four kinds, collected one by one.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/io/lattice_file.h"

namespace espalier {

/// Cells by their corners, in the order that MEDIT, VTK and Gmsh have in common: a base loop, then
/// the loop over it or the apex.
enum class MeshCell { Tetrahedron, Pyramid, Prism, Hexahedron };

[[nodiscard]] constexpr std::size_t n_corners(MeshCell kind) {
  constexpr std::size_t kCorners[] = {4, 5, 6, 8};
  return kCorners[static_cast<std::size_t>(kind)];
}

/// A volume mesh as it is read.
class MeshCells {
 public:
  void add_point(const glm::dvec3& point) { points_.push_back(point); }
  [[nodiscard]] std::size_t n_points() const { return points_.size(); }
  /// corners: n_corners(kind) indices of points, in range.
  void add_cell(MeshCell kind, std::span<const std::int32_t> corners);
  [[nodiscard]] bool has_cells() const { return cells_.cells.size() > 1; }

  /// The mesh as a lattice at rest with automatic tags: points no cell uses are left out, faces
  /// with the same corners shared, cells oriented.
  [[nodiscard]] RawLattice lattice() &&;

 private:
  std::vector<glm::dvec3> points_;
  CellLoops cells_{0, {}, {0}};
};

}  // namespace espalier
