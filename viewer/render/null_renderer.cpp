#include "viewer/render/null_renderer.h"

#include <algorithm>

namespace espalier::viewer {
namespace {

std::vector<glm::vec3>& positions_of(NullRenderer::Content& content) {
  if (auto* mesh = std::get_if<TriangleMesh>(&content)) {
    return mesh->positions;
  }
  auto* lines = std::get_if<LineSet>(&content);
  return lines != nullptr ? lines->points : std::get<PointSet>(content).points;
}

std::vector<glm::vec3>& colors_of(NullRenderer::Content& content) {
  auto* lines = std::get_if<LineSet>(&content);
  return lines != nullptr ? lines->colors : std::get<PointSet>(content).colors;
}

}  // namespace

void NullRenderer::do_add(ItemId id, const TriangleMesh& mesh) {
  items_.emplace(id, mesh);
  n_uploaded_ += mesh.positions.size() + mesh.normals.size();
}

void NullRenderer::do_add(ItemId id, const LineSet& lines) {
  items_.emplace(id, lines);
  n_uploaded_ += lines.points.size() + lines.colors.size();
}

void NullRenderer::do_add(ItemId id, const PointSet& points) {
  items_.emplace(id, points);
  n_uploaded_ += points.points.size() + points.colors.size();
}

void NullRenderer::do_remove(ItemId id) {
  items_.erase(id);
  wireframes_.erase(id);
}

void NullRenderer::do_update_positions(ItemId id, std::size_t first,
                                       std::span<const glm::vec3> positions) {
  replace(positions_of(items_.at(id)), first, positions);
}

void NullRenderer::do_update_normals(ItemId id, std::size_t first,
                                     std::span<const glm::vec3> normals) {
  if (auto* mesh = std::get_if<TriangleMesh>(&items_.at(id))) {
    replace(mesh->normals, first, normals);
  }
}

void NullRenderer::do_update_colors(ItemId id, std::size_t first,
                                    std::span<const glm::vec3> colors) {
  if (!colors.empty()) {
    replace(colors_of(items_.at(id)), first, colors);
  }
}

void NullRenderer::do_set_wireframe(ItemId id, bool has_wireframe) {
  if (has_wireframe) {
    wireframes_.insert(id);
  } else {
    wireframes_.erase(id);
  }
}

void NullRenderer::do_draw(const Shot& shot) {
  shots_.push_back(shot);
}

void NullRenderer::do_take_picture(const Shot& shot, Picture& /*picture*/) {
  shots_.push_back(shot);
}

void NullRenderer::replace(std::vector<glm::vec3>& all, std::size_t first,
                           std::span<const glm::vec3> some) {
  std::copy(some.begin(), some.end(), all.begin() + static_cast<std::ptrdiff_t>(first));
  n_uploaded_ += some.size();
}

}  // namespace espalier::viewer
