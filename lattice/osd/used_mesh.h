#pragma once

/// Polygon meshes as OpenSubdiv takes them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice/core/compressed_rows.h"

namespace espalier::osd {

/// The mesh of the points that faces use.
struct UsedMesh {
  std::vector<std::int32_t> points;  ///< #used: the point each number stands for
  std::vector<int> numbers;          ///< #points, -1: unused
  std::vector<int> sizes;            ///< #faces
  std::vector<int> corners;          ///< of all faces, by number
};

[[nodiscard]] UsedMesh used_mesh(std::size_t n_points, const CompressedRows<std::int32_t>& faces);

}  // namespace espalier::osd
