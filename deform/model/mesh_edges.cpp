#include "deform/model/mesh_edges.h"

#include <algorithm>

namespace espalier {

MeshEdges::MeshEdges(const DenseMesh& mesh) {
  struct Use {
    std::array<std::int32_t, 2> ends;
    std::int32_t corner;
  };
  std::vector<Use> uses;
  uses.reserve(mesh.faces.n_values());
  first_corner_.push_back(0);
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const auto loop = mesh.faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = loop[i].point;
      const std::int32_t b = loop[(i + 1) % loop.size()].point;
      uses.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(uses.size())});
    }
    first_corner_.push_back(uses.size());
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.corner < b.corner;
  });
  of_corner_.resize(uses.size());
  for (const Use& use : uses) {
    if (ends_.empty() || ends_.back() != use.ends) {
      ends_.push_back(use.ends);
    }
    of_corner_[static_cast<std::size_t>(use.corner)] = static_cast<std::int32_t>(ends_.size()) - 1;
  }
}

}  // namespace espalier
