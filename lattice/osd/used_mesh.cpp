#include "lattice/osd/used_mesh.h"

namespace espalier::osd {

UsedMesh used_mesh(std::size_t n_points, const CompressedRows<std::int32_t>& faces) {
  UsedMesh mesh;
  mesh.numbers.assign(n_points, -1);
  for (const std::int32_t point : faces.values()) {
    mesh.numbers[static_cast<std::size_t>(point)] = 0;
  }
  for (std::size_t i = 0; i < n_points; ++i) {
    if (mesh.numbers[i] == 0) {
      mesh.numbers[i] = static_cast<int>(mesh.points.size());
      mesh.points.push_back(static_cast<std::int32_t>(i));
    }
  }
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    mesh.sizes.push_back(static_cast<int>(faces[face].size()));
  }
  for (const std::int32_t point : faces.values()) {
    mesh.corners.push_back(mesh.numbers[static_cast<std::size_t>(point)]);
  }
  return mesh;
}

}  // namespace espalier::osd
