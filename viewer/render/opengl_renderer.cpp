#include "viewer/render/opengl_renderer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lattice/core/error.h"
#include "viewer/render/opengl_objects.h"
#include "viewer/render/opengl_shaders.h"
#include "viewer/render/opengl_target.h"

namespace espalier::viewer {
namespace {

/// Pictures are drawn in tiles of at most this side, so that memory does not limit their size.
constexpr int kLargestTile = 2048;
/// Lines are cut, and dots left out, this near to the eye, as a fraction of its distance.
constexpr double kNearestMark = 1e-3;

enum class Kind { Mesh, Lines, Points };

/// Indices that follow one another, drawn with a picture or without.
struct GpuTexture {
  GLsizei n;
  std::shared_ptr<const GlTexture> picture;
};

/// A mesh, line set or point set on the GPU.
struct GpuItem {
  Kind kind = Kind::Mesh;
  GLsizei n = 0;  // indices of a mesh, else instances
  glm::vec3 color{0};
  float opacity = 1;  // of a mesh
  float unit = 1;     // of a mesh
  bool has_wireframe = false;
  float hidden_opacity = 0;  // of lines and points
  float width = 0;           // or diameter
  float outline = 0;
  GlVertexArray layout;
  GlBuffer positions;
  GlBuffer normals_or_colors;
  GlBuffer indices;
  std::optional<GlBuffer> places;
  std::vector<GpuTexture> textures;
};

/// The part of a picture that is drawn at once, in pixels from its bottom left corner.
struct Tile {
  int x;
  int y;
  int width;
  int height;
};

/// How lines and points are drawn in one pass.
struct MarkPass {
  bool is_hidden = false;  // what lies behind the meshes, faintly
  bool is_core = false;    // only depth, where a mark covers all of a pixel
};

/// Reads attribute `index` of the item's layout, which is bound, as vec3 from the buffer.
void attach(GLuint index, const GlBuffer& buffer, GLsizei n_skipped, GLuint divisor,
            GLsizei n_interleaved) {
  constexpr GLsizei size = sizeof(glm::vec3);
  const auto skipped = static_cast<std::intptr_t>(n_skipped) * size;
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, n_interleaved * size,
                        reinterpret_cast<const void*>(skipped));  // NOLINT: an offset by tradition
  glVertexAttribDivisor(index, divisor);
}

/// A picture that repeats, smooth from near and far.
void store(const Picture& picture, const GlTexture& texture) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, picture.width, picture.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, picture.pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindTexture(GL_TEXTURE_2D, 0);
}

/// One picture for several ranges is stored once.
std::vector<GpuTexture> stored(const std::vector<TextureRange>& ranges) {
  std::unordered_map<const Picture*, std::shared_ptr<const GlTexture>> known;
  std::vector<GpuTexture> result;
  for (const TextureRange& range : ranges) {
    std::shared_ptr<const GlTexture>& texture = known[range.picture.get()];
    if (range.picture && !texture) {
      auto made = std::make_shared<GlTexture>();
      store(*range.picture, *made);
      texture = std::move(made);
    }
    result.push_back({static_cast<GLsizei>(range.n_indices), texture});
  }
  return result;
}

/// Enlarges a tile of the picture to all of clip space.
glm::dmat4 tile_matrix(const Tile& tile, const Shot& shot) {
  const glm::dvec3 grow(double(shot.width) / tile.width, double(shot.height) / tile.height, 1);
  const glm::dvec3 shift(grow.x - 1 - 2.0 * tile.x / tile.width,
                         grow.y - 1 - 2.0 * tile.y / tile.height, 0);
  return glm::scale(glm::translate(glm::dmat4(1), shift), grow);
}

class OpenglRenderer final : public Renderer {
 private:
  void do_add(ItemId id, const TriangleMesh& mesh) override;
  void do_add(ItemId id, const LineSet& lines) override;
  void do_add(ItemId id, const PointSet& points) override;
  void do_remove(ItemId id) override { items_.erase(id.value); }
  void do_update_positions(ItemId id, std::size_t first,
                           std::span<const glm::vec3> positions) override;
  void do_update_normals(ItemId id, std::size_t first, std::span<const glm::vec3> normals) override;
  void do_update_colors(ItemId id, std::size_t first, std::span<const glm::vec3> colors) override;
  void do_set_wireframe(ItemId id, bool has_wireframe) override {
    items_.at(id.value).has_wireframe = has_wireframe;
  }
  void do_draw(const Shot& shot) override;
  void do_take_picture(const Shot& shot, Picture& picture) override;

  const OpenglTarget& target_of(int width, int height);
  void draw_tile(const Shot& shot, const Tile& tile);
  void draw_background(const Shot& shot, const Tile& tile);
  void set_view(const GlProgram& program, const Shot& shot, const Tile& tile) const;
  void draw_meshes(const Shot& shot, bool is_opaque) const;
  void draw_triangles(const GpuItem& item) const;
  void draw_wireframe(const GpuItem& item) const;
  void draw_marks(const Shot& shot, const MarkPass& pass) const;
  void draw_lines(const GpuItem& item, const MarkPass& pass) const;
  void draw_points(const GpuItem& item, const MarkPass& pass) const;

  OpenglShaders shaders_;
  GlVertexArray no_vertices_;
  std::optional<OpenglTarget> target_;
  std::unordered_map<std::int32_t, GpuItem> items_;
};

void OpenglRenderer::do_add(ItemId id, const TriangleMesh& mesh) {
  GpuItem item;
  item.kind = Kind::Mesh;
  item.n = static_cast<GLsizei>(mesh.indices.size());
  item.color = mesh.color;
  item.opacity = mesh.opacity;
  item.unit = mesh.unit;
  upload<glm::vec3>(item.positions, mesh.positions);
  upload<glm::vec3>(item.normals_or_colors, mesh.normals);
  upload<std::uint32_t>(item.indices, mesh.indices);
  glBindVertexArray(item.layout.id());
  attach(kPositionAttribute, item.positions, 0, 0, 1);
  attach(kNormalAttribute, item.normals_or_colors, 0, 0, 1);
  if (!mesh.textures.empty()) {
    item.places.emplace();
    upload<glm::vec2>(*item.places, mesh.places);
    glBindBuffer(GL_ARRAY_BUFFER, item.places->id());
    glEnableVertexAttribArray(kPlaceAttribute);
    glVertexAttribPointer(kPlaceAttribute, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    item.textures = stored(mesh.textures);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, item.indices.id());
  glBindVertexArray(0);
  check_opengl("store a mesh");
  items_.emplace(id.value, std::move(item));
}

void OpenglRenderer::do_add(ItemId id, const LineSet& lines) {
  GpuItem item;
  item.kind = Kind::Lines;
  item.n = static_cast<GLsizei>(lines.colors.size());
  item.width = lines.width;
  item.hidden_opacity = lines.hidden_opacity;
  upload<glm::vec3>(item.positions, lines.points);
  upload<glm::vec3>(item.normals_or_colors, lines.colors);
  glBindVertexArray(item.layout.id());
  attach(kPositionAttribute, item.positions, 0, 1, 2);
  attach(kEndAttribute, item.positions, 1, 1, 2);
  attach(kColorAttribute, item.normals_or_colors, 0, 1, 1);
  glBindVertexArray(0);
  check_opengl("store lines");
  items_.emplace(id.value, std::move(item));
}

void OpenglRenderer::do_add(ItemId id, const PointSet& points) {
  GpuItem item;
  item.kind = Kind::Points;
  item.n = static_cast<GLsizei>(points.points.size());
  item.width = points.diameter;
  item.outline = points.outline;
  item.hidden_opacity = points.hidden_opacity;
  upload<glm::vec3>(item.positions, points.points);
  upload<glm::vec3>(item.normals_or_colors, points.colors);
  glBindVertexArray(item.layout.id());
  attach(kPositionAttribute, item.positions, 0, 1, 1);
  attach(kColorAttribute, item.normals_or_colors, 0, 1, 1);
  glBindVertexArray(0);
  check_opengl("store points");
  items_.emplace(id.value, std::move(item));
}

void OpenglRenderer::do_update_positions(ItemId id, std::size_t first,
                                         std::span<const glm::vec3> positions) {
  upload_range(items_.at(id.value).positions, first, positions);
}

void OpenglRenderer::do_update_normals(ItemId id, std::size_t first,
                                       std::span<const glm::vec3> normals) {
  upload_range(items_.at(id.value).normals_or_colors, first, normals);
}

void OpenglRenderer::do_update_colors(ItemId id, std::size_t first,
                                      std::span<const glm::vec3> colors) {
  upload_range(items_.at(id.value).normals_or_colors, first, colors);
}

void OpenglRenderer::do_draw(const Shot& shot) {
  GLint window = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &window);
  const OpenglTarget& target = target_of(shot.width, shot.height);
  target.begin();
  draw_tile(shot, {0, 0, shot.width, shot.height});
  target.resolve();
  target.copy_to(static_cast<GLuint>(window));
  check_opengl("draw a frame");
}

void OpenglRenderer::do_take_picture(const Shot& shot, Picture& picture) {
  const OpenglTarget& target =
      target_of(std::min(shot.width, kLargestTile), std::min(shot.height, kLargestTile));
  for (int y = 0; y < shot.height; y += target.height()) {
    for (int x = 0; x < shot.width; x += target.width()) {
      target.begin();
      draw_tile(shot, {x, y, target.width(), target.height()});
      target.resolve();
      const std::vector<std::uint8_t> pixels = target.pixels();
      const std::size_t n_columns = std::min(target.width(), shot.width - x);
      const int n_rows = std::min(target.height(), shot.height - y);
      for (int row = 0; row < n_rows; ++row) {
        const std::size_t to = static_cast<std::size_t>(shot.height - 1 - y - row) * shot.width + x;
        std::copy_n(pixels.begin() + 4 * static_cast<std::ptrdiff_t>(row) * target.width(),
                    4 * n_columns, picture.pixels.begin() + static_cast<std::ptrdiff_t>(4 * to));
      }
    }
  }
  check_opengl("draw a picture");
}

const OpenglTarget& OpenglRenderer::target_of(int width, int height) {
  if (!target_ || target_->width() != width || target_->height() != height) {
    target_.reset();
    target_.emplace(width, height);
  }
  return *target_;
}

/// First the solid meshes; then what marks they hide, faintly; then the marks in view, nearest on
/// top, which is settled by the depth of the pixels they cover entirely; last what is transparent.
void OpenglRenderer::draw_tile(const Shot& shot, const Tile& tile) {
  draw_background(shot, tile);
  for (const GlProgram* program : {&shaders_.mesh, &shaders_.lines, &shaders_.points}) {
    set_view(*program, shot, tile);
  }
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_DEPTH_CLAMP);
  glDepthFunc(GL_LEQUAL);
  draw_meshes(shot, true);

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  draw_marks(shot, {.is_hidden = true});

  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_marks(shot, {.is_core = true});
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
  draw_marks(shot, {});

  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  draw_meshes(shot, false);
  glCullFace(GL_BACK);
  draw_meshes(shot, false);

  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glBindVertexArray(0);
  glUseProgram(0);
}

void OpenglRenderer::draw_background(const Shot& shot, const Tile& tile) {
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glClearDepth(1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  const glm::vec2 edges(tile.y, tile.y + tile.height);
  shaders_.background.use();
  shaders_.background.set("top", shot.background.top);
  shaders_.background.set("bottom", shot.background.bottom);
  shaders_.background.set("heights", edges / static_cast<float>(shot.height));
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void OpenglRenderer::set_view(const GlProgram& program, const Shot& shot, const Tile& tile) const {
  const Camera& camera = shot.camera;
  const double aspect = double(shot.width) / shot.height;
  const glm::dmat4 projection = tile_matrix(tile, shot) * camera.projection_matrix(aspect);
  const bool is_perspective = camera.projection == Projection::Perspective;
  program.use();
  program.set("view", glm::mat4(camera.view_matrix()));
  program.set("projection", glm::mat4(projection));
  program.set("viewport", glm::vec2(tile.width, tile.height));
  program.set("depths",
              glm::vec2(camera.distance - camera.radius, camera.distance + camera.radius));
  program.set("least_w", is_perspective ? static_cast<float>(kNearestMark * camera.distance) : 0.F);
}

void OpenglRenderer::draw_meshes(const Shot& shot, bool is_opaque) const {
  shaders_.mesh.use();
  shaders_.mesh.set("is_matcap", shot.shading == Shading::Matcap ? 1.F : 0.F);
  for (const ItemId id : shot.items) {
    const GpuItem& item = items_.at(id.value);
    if (item.kind == Kind::Mesh && (item.opacity == 1) == is_opaque) {
      shaders_.mesh.set("color", item.color);
      shaders_.mesh.set("opacity", item.opacity);
      shaders_.mesh.set("unit", item.unit);
      draw_triangles(item);
      if (item.has_wireframe) {
        draw_wireframe(item);
      }
    }
  }
}

/// A mesh that was just drawn once more, as lines, a little nearer to the eye.
void OpenglRenderer::draw_triangles(const GpuItem& item) const {
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(item.layout.id());
  std::uintptr_t first = 0;
  const auto draw = [&](GLsizei n, const GlTexture* texture) {
    shaders_.mesh.set("has_texture", texture != nullptr ? 1.F : 0.F);
    glBindTexture(GL_TEXTURE_2D, texture != nullptr ? texture->id() : 0);
    glDrawElements(GL_TRIANGLES, n, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first));  // NOLINT: an offset by tradition
    first += static_cast<std::uintptr_t>(n) * sizeof(std::uint32_t);
  };
  for (const GpuTexture& texture : item.textures) {
    draw(texture.n, texture.picture.get());
  }
  if (item.textures.empty()) {
    draw(item.n, nullptr);
  }
}

void OpenglRenderer::draw_wireframe(const GpuItem& item) const {
  constexpr float kDarker = 0.3F;
  shaders_.mesh.set("color", kDarker * item.color);
  shaders_.mesh.set("has_texture", 0.F);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(-1, -1);
  glDrawElements(GL_TRIANGLES, item.n, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void OpenglRenderer::draw_marks(const Shot& shot, const MarkPass& pass) const {
  for (const ItemId id : shot.items) {
    if (items_.at(id.value).kind == Kind::Lines) {
      draw_lines(items_.at(id.value), pass);
    }
  }
  for (const ItemId id : shot.items) {
    if (items_.at(id.value).kind == Kind::Points) {
      draw_points(items_.at(id.value), pass);
    }
  }
}

void OpenglRenderer::draw_lines(const GpuItem& item, const MarkPass& pass) const {
  shaders_.lines.use();
  shaders_.lines.set("width", item.width);
  shaders_.lines.set("opacity", pass.is_hidden ? item.hidden_opacity : 1.F);
  shaders_.lines.set("only_core", pass.is_core ? 1.F : 0.F);
  // Round ends overlap where segments meet, which would show in what is drawn faintly.
  shaders_.lines.set("round_ends", pass.is_hidden ? 0.F : 1.F);
  glBindVertexArray(item.layout.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, item.n);
}

void OpenglRenderer::draw_points(const GpuItem& item, const MarkPass& pass) const {
  shaders_.points.use();
  shaders_.points.set("diameter", item.width);
  shaders_.points.set("outline", item.outline);
  shaders_.points.set("opacity", pass.is_hidden ? item.hidden_opacity : 1.F);
  shaders_.points.set("only_core", pass.is_core ? 1.F : 0.F);
  glBindVertexArray(item.layout.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, item.n);
}

}  // namespace

std::unique_ptr<Renderer> make_opengl_renderer() {
  if (epoxy_gl_version() < 33) {
    throw Error("cannot draw: OpenGL 3.3 is needed, this is " +
                std::to_string(epoxy_gl_version() / 10) + "." +
                std::to_string(epoxy_gl_version() % 10));
  }
  return std::make_unique<OpenglRenderer>();
}

}  // namespace espalier::viewer
