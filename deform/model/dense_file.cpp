#include "deform/model/dense_file.h"

#include <algorithm>

namespace espalier {

FacePartition::FacePartition(const DenseMesh& before, const DenseMesh& after)
    : parts_(before.faces.n_rows()) {
  std::size_t child = 0;
  for (std::size_t face = 0; face < parts_.size(); ++face) {
    FaceParts& parts = parts_[face];
    parts.begin = child;
    while (child < after.parents.size() &&
           after.parents[child] == static_cast<std::int32_t>(face)) {
      ++child;
    }
    parts.end = child;
    parts.is_whole = parts.end - parts.begin == 1 &&
                     std::ranges::equal(after.faces[parts.begin], before.faces[face]);
  }
}

DenseMesh plain_mesh(const Model& model) {
  DenseMesh mesh;
  mesh.points.assign(model.points().begin(), model.points().end());
  std::vector<DenseCorner> corners;
  for (std::size_t face = 0; face < model.faces().n_rows(); ++face) {
    corners.clear();
    for (const std::int32_t point : model.faces()[face]) {
      corners.push_back({point});
    }
    mesh.faces.push_back(corners);
    mesh.parents.push_back(static_cast<std::int32_t>(face));
  }
  return mesh;
}

std::string_view line_end_of(std::string_view text) {
  const std::size_t at = text.find_first_of("\r\n");
  if (at == std::string_view::npos) {
    return "\n";
  }
  return text.substr(at, text.substr(at).starts_with("\r\n") ? 2 : 1);
}

}  // namespace espalier
