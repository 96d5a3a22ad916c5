#pragma once

/// Something that a renderer draws and that changes now and then.

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "viewer/render/renderer.h"

namespace espalier::viewer {

/// Uploads the values from the first to the last that differ.
template <class Upload>
void upload_difference(const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after,
                       const Upload& upload) {
  const auto first = std::mismatch(before.begin(), before.end(), after.begin()).first;
  if (first == before.end()) {
    return;
  }
  const auto last = std::mismatch(before.rbegin(), before.rend(), after.rbegin()).first.base();
  const auto begin = static_cast<std::size_t>(first - before.begin());
  const auto end = static_cast<std::size_t>(last - before.begin());
  upload(begin, std::span(after).subspan(begin, end - begin));
}

/// Lines or dots: LineSet or PointSet. Of the same number they are updated in place, and only where
/// they differ.
template <class Marks>
class ShownMarks {
 public:
  void show(Renderer& renderer, Marks marks) {
    const bool is_same_kind = item_ && marks.points.size() == shown_.points.size() &&
                              marks.colors.size() == shown_.colors.size();
    if (!is_same_kind) {
      hide(renderer);
      if (!marks.points.empty()) {
        item_ = renderer.add(marks);
        shown_ = std::move(marks);
      }
      return;
    }
    upload_difference(shown_.points, marks.points,
                      [&](std::size_t first, std::span<const glm::vec3> values) {
                        renderer.update_positions(*item_, first, values);
                      });
    upload_difference(shown_.colors, marks.colors,
                      [&](std::size_t first, std::span<const glm::vec3> values) {
                        renderer.update_colors(*item_, first, values);
                      });
    shown_ = std::move(marks);
  }

  void hide(Renderer& renderer) {
    if (item_) {
      renderer.remove(*item_);
      item_.reset();
      shown_ = Marks();
    }
  }

 private:
  std::optional<ItemId> item_;
  Marks shown_;
};

/// A mesh, as long as its triangles stay updated in place.
class ShownMesh {
 public:
  void show(Renderer& renderer, TriangleMesh mesh) {
    const bool is_same_kind =
        item_ && mesh.positions.size() == shown_.positions.size() && mesh.indices == shown_.indices;
    if (!is_same_kind) {
      hide(renderer);
      if (!mesh.indices.empty()) {
        item_ = renderer.add(mesh);
        shown_ = std::move(mesh);
      }
      return;
    }
    upload_difference(shown_.positions, mesh.positions,
                      [&](std::size_t first, std::span<const glm::vec3> values) {
                        renderer.update_positions(*item_, first, values);
                      });
    upload_difference(shown_.normals, mesh.normals,
                      [&](std::size_t first, std::span<const glm::vec3> values) {
                        renderer.update_normals(*item_, first, values);
                      });
    shown_ = std::move(mesh);
  }

  void hide(Renderer& renderer) {
    if (item_) {
      renderer.remove(*item_);
      item_.reset();
      shown_ = TriangleMesh();
    }
  }

 private:
  std::optional<ItemId> item_;
  TriangleMesh shown_;
};

}  // namespace espalier::viewer
