#pragma once

/// A renderer without a GPU.

#include <map>
#include <set>
#include <variant>
#include <vector>

#include "viewer/render/renderer.h"

namespace espalier::viewer {

/// Draws nothing but remembers what it was told, so that whatever drives a renderer is tested
/// without a GPU.
class NullRenderer final : public Renderer {
 public:
  using Content = std::variant<TriangleMesh, LineSet, PointSet>;

  /// The items as they are now, with all updates; removed ones are gone.
  [[nodiscard]] const std::map<ItemId, Content>& items() const { return items_; }
  /// The items that are outlined.
  [[nodiscard]] const std::set<ItemId>& wireframes() const { return wireframes_; }
  /// All that was drawn, first to last.
  [[nodiscard]] const std::vector<Shot>& shots() const { return shots_; }
  /// Vectors uploaded so far: positions, normals, colours.
  [[nodiscard]] std::size_t n_uploaded() const { return n_uploaded_; }

 private:
  void do_add(ItemId id, const TriangleMesh& mesh) override;
  void do_add(ItemId id, const LineSet& lines) override;
  void do_add(ItemId id, const PointSet& points) override;
  void do_remove(ItemId id) override;
  void do_update_positions(ItemId id, std::size_t first,
                           std::span<const glm::vec3> positions) override;
  void do_update_normals(ItemId id, std::size_t first, std::span<const glm::vec3> normals) override;
  void do_update_colors(ItemId id, std::size_t first, std::span<const glm::vec3> colors) override;
  void do_set_wireframe(ItemId id, bool has_wireframe) override;
  void do_draw(const Shot& shot) override;
  void do_take_picture(const Shot& shot, Picture& picture) override;

  void replace(std::vector<glm::vec3>& all, std::size_t first, std::span<const glm::vec3> some);

  std::map<ItemId, Content> items_;
  std::set<ItemId> wireframes_;
  std::vector<Shot> shots_;
  std::size_t n_uploaded_ = 0;
};

}  // namespace espalier::viewer
