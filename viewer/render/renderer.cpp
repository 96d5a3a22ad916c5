#include "viewer/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw ParameterError("Renderer: " + what);
}

void check_finite(std::span<const glm::vec3> vectors, const std::string& what) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const glm::vec3& v = vectors[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      fail(what + " " + std::to_string(i) + " is not finite");
    }
  }
}

void check_count(std::size_t n, std::size_t expected, const std::string& what) {
  if (n != expected) {
    fail(std::to_string(n) + " " + what + ", it must be " + std::to_string(expected));
  }
}

void check_fraction(float value, const std::string& what) {
  if (!(value >= 0 && value <= 1)) {
    fail(what + " is " + std::to_string(value) + ", it must be in [0, 1]");
  }
}

void check_pixels(float value, const std::string& what) {
  if (!(value >= 0) || !std::isfinite(value)) {
    fail(what + " is " + std::to_string(value) + " pixels, it must be finite and not below 0");
  }
}

void check(const TriangleMesh& mesh) {
  check_count(mesh.normals.size(), mesh.positions.size(), "normals");
  check_count(mesh.places.size(),
              mesh.textures.empty() ? mesh.places.size() : mesh.positions.size(),
              "places in the texture");
  std::size_t n_textured = 0;
  for (const TextureRange& range : mesh.textures) {
    n_textured += range.n_indices;
  }
  check_count(n_textured, mesh.textures.empty() ? 0 : mesh.indices.size(), "textured indices");
  for (const glm::vec2& place : mesh.places) {
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) {
      fail("a place in the texture is not finite");
    }
  }
  check_finite(mesh.positions, "position");
  check_finite(mesh.normals, "normal");
  check_fraction(mesh.opacity, "opacity");
  if (!(mesh.unit > 0) || !std::isfinite(mesh.unit)) {
    fail("the unit is " + std::to_string(mesh.unit) + ", it must be above 0 and finite");
  }
  if (mesh.indices.size() % 3 != 0) {
    fail(std::to_string(mesh.indices.size()) + " indices, it must be three a triangle");
  }
  const auto largest = std::max_element(mesh.indices.begin(), mesh.indices.end());
  if (largest != mesh.indices.end() && *largest >= mesh.positions.size()) {
    fail("index " + std::to_string(*largest) + " in a mesh of " +
         std::to_string(mesh.positions.size()) + " vertices");
  }
}

void check(const LineSet& lines) {
  check_count(lines.points.size(), 2 * lines.colors.size(), "end points of segments");
  check_finite(lines.points, "end point");
  check_finite(lines.colors, "colour");
  check_pixels(lines.width, "line width");
  check_fraction(lines.hidden_opacity, "hidden opacity");
}

void check(const PointSet& points) {
  check_count(points.colors.size(), points.points.size(), "colours of points");
  check_finite(points.points, "point");
  check_finite(points.colors, "colour");
  check_pixels(points.diameter, "diameter");
  check_pixels(points.outline, "outline");
  check_fraction(points.hidden_opacity, "hidden opacity");
}

void check(const Camera& camera) {
  const bool is_sound = camera.distance > 0 && camera.radius > 0 && camera.field_of_view > 0 &&
                        camera.field_of_view < 180 && std::isfinite(camera.distance) &&
                        std::isfinite(camera.radius);
  if (!is_sound) {
    fail("the camera's distance, radius and field of view must be above 0 and finite");
  }
}

void check_range(std::size_t first, std::size_t n, std::size_t limit, const std::string& what) {
  if (first > limit || n > limit - first) {
    fail(what + " " + std::to_string(first) + " … " + std::to_string(first + n) +
         " (exclusive) of an item with " + std::to_string(limit));
  }
}

}  // namespace

ItemId Renderer::add(const TriangleMesh& mesh) {
  check(mesh);
  const ItemId id = keep({mesh.positions.size(), mesh.normals.size(), 0});
  do_add(id, mesh);
  return id;
}

ItemId Renderer::add(const LineSet& lines) {
  check(lines);
  const ItemId id = keep({lines.points.size(), 0, lines.colors.size()});
  do_add(id, lines);
  return id;
}

ItemId Renderer::add(const PointSet& points) {
  check(points);
  const ItemId id = keep({points.points.size(), 0, points.colors.size()});
  do_add(id, points);
  return id;
}

void Renderer::add(const Drawing& drawing) {
  for (const TriangleMesh& mesh : drawing.meshes) {
    add(mesh);
  }
  for (const LineSet& lines : drawing.lines) {
    add(lines);
  }
  for (const PointSet& points : drawing.points) {
    add(points);
  }
  set_background(drawing.background);
}

void Renderer::remove(ItemId item) {
  existing(item).is_removed = true;
  do_remove(item);
}

void Renderer::update_positions(ItemId item, std::size_t first,
                                std::span<const glm::vec3> positions) {
  check_range(first, positions.size(), existing(item).n_positions, "positions");
  check_finite(positions, "position");
  do_update_positions(item, first, positions);
}

void Renderer::update_normals(ItemId mesh, std::size_t first, std::span<const glm::vec3> normals) {
  check_range(first, normals.size(), existing(mesh).n_normals, "normals");
  check_finite(normals, "normal");
  do_update_normals(mesh, first, normals);
}

void Renderer::update_colors(ItemId item, std::size_t first, std::span<const glm::vec3> colors) {
  check_range(first, colors.size(), existing(item).n_colors, "colours");
  check_finite(colors, "colour");
  do_update_colors(item, first, colors);
}

void Renderer::set_visible(ItemId item, bool is_visible) {
  existing(item).is_visible = is_visible;
}

void Renderer::set_wireframe(ItemId mesh, bool has_wireframe) {
  static_cast<void>(existing(mesh));
  do_set_wireframe(mesh, has_wireframe);
}

void Renderer::draw(const Camera& camera, int width, int height) {
  if (width < 1 || height < 1) {
    return;  // A window that is minimised has no pixels.
  }
  do_draw(shot(camera, width, height));
}

Picture Renderer::take_picture(const Camera& camera, int width, int height) {
  Picture picture(width, height);
  do_take_picture(shot(camera, width, height), picture);
  return picture;
}

Renderer::Item& Renderer::existing(ItemId id) {
  if (!id.is_valid() || id.index() >= items_.size() || items_[id.index()].is_removed) {
    fail("there is no item " + std::to_string(id.value));
  }
  return items_[id.index()];
}

Shot Renderer::shot(const Camera& camera, int width, int height) const {
  check(camera);
  Shot shot{camera, width, height, background_, shading_, {}};
  for (const ItemId id : IdRange<ItemId>(items_.size())) {
    const Item& item = items_[id.index()];
    if (!item.is_removed && item.is_visible) {
      shot.items.push_back(id);
    }
  }
  return shot;
}

ItemId Renderer::keep(const Item& item) {
  items_.push_back(item);
  return ItemId{static_cast<std::int32_t>(items_.size() - 1)};
}

}  // namespace espalier::viewer
