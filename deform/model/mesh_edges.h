#pragma once

/// The edges of a polygon mesh, whatever number of faces they have.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "deform/model/dense_mesh.h"

namespace espalier {

/// Numbers edges by their ends, ascending. O(#corners log #corners).
class MeshEdges {
 public:
  explicit MeshEdges(const DenseMesh& mesh);

  [[nodiscard]] std::size_t n_edges() const { return ends_.size(); }
  /// The smaller number first.
  [[nodiscard]] const std::array<std::int32_t, 2>& ends(std::size_t edge) const {
    return ends_[edge];
  }
  /// Edge i leads from corner i to the next.
  [[nodiscard]] std::span<const std::int32_t> of_face(std::size_t face) const {
    return {of_corner_.data() + first_corner_[face], first_corner_[face + 1] - first_corner_[face]};
  }

 private:
  std::vector<std::array<std::int32_t, 2>> ends_;
  std::vector<std::int32_t> of_corner_;
  std::vector<std::size_t> first_corner_;
};

}  // namespace espalier
