#include "lattice/io/mesh_cells.h"

#include <utility>

#include "lattice/build/prism.h"

namespace espalier {

void MeshCells::add_cell(MeshCell kind, std::span<const std::int32_t> corners) {
  const std::size_t n_base = kind == MeshCell::Tetrahedron || kind == MeshCell::Prism ? 3 : 4;
  const auto base = corners.first(n_base);
  const auto loops = corners.size() == n_base + 1
                         ? pyramid_loops(base, corners.back())
                         : prism_loops(base, corners.subspan(n_base, n_base));
  for (const VertexLoop& loop : loops) {
    cells_.loops.push_back(loop);
  }
  cells_.cells.push_back(static_cast<std::uint32_t>(cells_.loops.n_rows()));
}

RawLattice MeshCells::lattice() && {
  std::vector<std::int32_t> number(points_.size(), -1);
  for (const std::int32_t corner : cells_.loops.values()) {
    number[static_cast<std::size_t>(corner)] = 0;
  }
  RawLattice raw;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) {
      number[i] = static_cast<std::int32_t>(raw.rest.size());
      raw.rest.push_back(points_[i]);
    }
  }
  for (std::size_t row = 0; row < cells_.loops.n_rows(); ++row) {
    for (std::int32_t& corner : cells_.loops[row]) {
      corner = number[static_cast<std::size_t>(corner)];
    }
  }
  cells_.n_vertices = static_cast<std::int32_t>(raw.rest.size());
  raw.polyhedra = match_faces(std::move(cells_));
  orient(raw.polyhedra, raw.rest);
  return raw;
}

}  // namespace espalier
