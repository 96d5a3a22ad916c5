#pragma once

/// The one door to the GPU.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/ids.h"
#include "viewer/render/camera.h"
#include "viewer/render/drawing.h"
#include "viewer/render/picture.h"

namespace espalier::viewer {

/// A mesh, line set or point set that a renderer keeps.
using ItemId = Id<struct ItemTag>;

/// One picture to be drawn.
struct Shot {
  Camera camera;
  int width;
  int height;
  Background background;
  Shading shading;
  std::vector<ItemId> items;  ///< The visible ones, in the order they were added.
};

/// Keeps items where the GPU reaches them and draws them from any camera: they are uploaded once,
/// and what changes from frame to frame is updated in place. Ids are never reused.
///
/// Every function checks what it gets, for every back end, and throws ParameterError: an item that
/// was removed, an index out of range, arrays that do not match, a number that is not finite.
class Renderer {
 public:
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  virtual ~Renderer() = default;

  ItemId add(const TriangleMesh& mesh);
  ItemId add(const LineSet& lines);
  ItemId add(const PointSet& points);
  /// All items of the drawing, visible, and its background.
  void add(const Drawing& drawing);
  void remove(ItemId item);

  /// Moves the points of an item from `first` on (two of them a segment of a line set).
  void update_positions(ItemId item, std::size_t first, std::span<const glm::vec3> positions);
  /// Turns the normals of a mesh from vertex `first` on.
  void update_normals(ItemId mesh, std::size_t first, std::span<const glm::vec3> normals);
  /// Recolours segments of a line set, or points of a point set, from `first` on.
  void update_colors(ItemId item, std::size_t first, std::span<const glm::vec3> colors);
  void set_visible(ItemId item, bool is_visible);
  /// Whether a mesh's triangles are outlined; at first they are not.
  void set_wireframe(ItemId mesh, bool has_wireframe);
  void set_background(const Background& background) { background_ = background; }
  /// At first Phong.
  void set_shading(Shading shading) { shading_ = shading; }

  /// Draws into the frame buffer of the window, width × height pixels.
  void draw(const Camera& camera, int width, int height);
  /// Draws into memory. Throws ParameterError as check_picture_size.
  [[nodiscard]] Picture take_picture(const Camera& camera, int width, int height);

 private:
  /// What back ends do. All arguments have been checked.
  virtual void do_add(ItemId id, const TriangleMesh& mesh) = 0;
  virtual void do_add(ItemId id, const LineSet& lines) = 0;
  virtual void do_add(ItemId id, const PointSet& points) = 0;
  virtual void do_remove(ItemId id) = 0;
  virtual void do_update_positions(ItemId id, std::size_t first,
                                   std::span<const glm::vec3> positions) = 0;
  virtual void do_update_normals(ItemId id, std::size_t first,
                                 std::span<const glm::vec3> normals) = 0;
  virtual void do_update_colors(ItemId id, std::size_t first,
                                std::span<const glm::vec3> colors) = 0;
  virtual void do_set_wireframe(ItemId id, bool has_wireframe) = 0;
  virtual void do_draw(const Shot& shot) = 0;
  virtual void do_take_picture(const Shot& shot, Picture& picture) = 0;

  /// What updates are checked against.
  struct Item {
    std::size_t n_positions;
    std::size_t n_normals;
    std::size_t n_colors;
    bool is_removed = false;
    bool is_visible = true;
  };
  [[nodiscard]] Item& existing(ItemId id);
  [[nodiscard]] Shot shot(const Camera& camera, int width, int height) const;
  ItemId keep(const Item& item);

  std::vector<Item> items_;  // the place is the id
  Background background_;
  Shading shading_ = Shading::Phong;
};

}  // namespace espalier::viewer
