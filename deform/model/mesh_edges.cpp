#include "deform/model/mesh_edges.h"

#include <algorithm>

#include "deform/model/pairs.h"

namespace espalier {

MeshEdges::MeshEdges(const DenseMesh& mesh) {
  struct Use {
    std::array<std::int32_t, 2> ends;
    std::int32_t corner;
    std::int32_t face;
  };
  std::vector<Use> uses;
  uses.reserve(mesh.faces.n_values());
  first_corner_.push_back(0);
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const auto loop = mesh.faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = loop[i].point;
      const std::int32_t b = loop[(i + 1) % loop.size()].point;
      uses.push_back({{std::min(a, b), std::max(a, b)},
                      static_cast<std::int32_t>(uses.size()),
                      static_cast<std::int32_t>(face)});
    }
    first_corner_.push_back(uses.size());
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.corner < b.corner;
  });
  of_corner_.resize(uses.size());
  std::vector<std::int32_t> faces;
  std::vector<std::int32_t> ends_of_points;
  for (std::size_t i = 0; i < uses.size();) {
    faces.clear();
    std::size_t k = i;
    for (; k < uses.size() && uses[k].ends == uses[i].ends; ++k) {
      of_corner_[static_cast<std::size_t>(uses[k].corner)] =
          static_cast<std::int32_t>(ends_.size());
      faces.push_back(uses[k].face);
    }
    ends_.push_back(uses[i].ends);
    ends_of_points.insert(ends_of_points.end(), uses[i].ends.begin(), uses[i].ends.end());
    faces_.push_back(faces);
    i = k;
  }
  const CompressedRows<std::int32_t> halves = rows_by_key(ends_of_points, mesh.points.size());
  std::vector<std::int32_t> edges;
  for (std::size_t point = 0; point < halves.n_rows(); ++point) {
    edges.clear();
    for (const std::int32_t half : halves[point]) {
      edges.push_back(half / 2);
    }
    of_point_.push_back(edges);
  }
}

}  // namespace espalier
