#pragma once

/// From polygons to triangles with normals: what a model's faces need to be drawn.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/compressed_rows.h"
#include "viewer/render/drawing.h"
#include "viewer/render/drawing_frame.h"

namespace espalier::viewer {

struct MeshDrawingOptions {
  DrawingFrame frame{};  ///< From the points' units to drawing units.
  /// Of corners, parallel to the faces: points whose corners differ become several vertices. Empty:
  /// there is no texture.
  std::span<const glm::vec2> corner_places{};
  /// One a face, from 0 on: triangles are drawn in the order of their groups. Empty: one group.
  std::span<const std::int32_t> face_groups{};
  double crease_angle = 40;  ///< Degrees: faces that meet at more get an edge between them.
  glm::vec3 color = kClay;
  float opacity = 1;
};

/// How the faces of one mesh are drawn, kept while its points move: the triangles, and which of
/// its points share a normal. A point where faces meet at a crease becomes several vertices.
///
/// Faces with an index out of range, a point that is not finite, or fewer than three different
/// corners are left out.
class MeshDrawing {
 public:
  /// points: #P × 3; faces: loops of indices into them. The points decide where creases are.
  /// O(corners).
  MeshDrawing(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
              const MeshDrawingOptions& options = {});

  /// The same with its vertices in another order. order: #vertices, the old number of each new one.
  [[nodiscard]] MeshDrawing reordered(std::span<const std::uint32_t> order) const;

  [[nodiscard]] std::size_t n_vertices() const { return vertex_points_.size(); }
  /// Three vertices a triangle, turning as the faces do.
  [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  /// How many of these values each group has; one of all if there are no groups.
  [[nodiscard]] const std::vector<std::size_t>& group_sizes() const { return group_sizes_; }
  /// The point each vertex is drawn at.
  [[nodiscard]] const std::vector<std::uint32_t>& vertex_points() const { return vertex_points_; }

  /// In the texture, #vertices; empty if there is none.
  [[nodiscard]] const std::vector<glm::vec2>& vertex_places() const { return vertex_places_; }

  /// #vertices × 3, drawing units, for the points as they are now (as many as at first, else
  /// ParameterError). O(#vertices).
  [[nodiscard]] std::vector<glm::vec3> positions(std::span<const glm::dvec3> points) const;
  /// #vertices × 3: unit, weighted by the angles of the corners; zero where the corners have no
  /// angle. O(corners); the same bits for any number of threads.
  [[nodiscard]] std::vector<glm::vec3> normals(std::span<const glm::dvec3> points) const;
  /// All of it, ready to be drawn.
  [[nodiscard]] TriangleMesh triangle_mesh(std::span<const glm::dvec3> points) const;

 private:
  void check_points(std::span<const glm::dvec3> points) const;
  void keep_drawable_faces(std::span<const glm::dvec3> points,
                           const CompressedRows<std::int32_t>& faces);
  void split_points_at_creases(std::span<const glm::dvec3> points);
  void triangulate_faces(std::span<const glm::dvec3> points);

  MeshDrawingOptions options_;
  std::size_t n_points_;
  CompressedRows<std::uint32_t> loops_;           // points around each face that is drawn
  std::vector<std::uint32_t> corner_vertices_;    // one a value of loops_
  CompressedRows<std::uint32_t> vertex_corners_;  // values of loops_ that share a vertex
  std::vector<std::uint32_t> vertex_points_;
  std::vector<glm::vec2> corner_places_;  // one a value of loops_, or none
  std::vector<glm::vec2> vertex_places_;
  std::vector<std::int32_t> loop_groups_;  // one a loop
  std::vector<std::uint32_t> triangles_;
  std::vector<std::size_t> group_sizes_;
};

/// Draws a mesh once. See MeshDrawing.
[[nodiscard]] TriangleMesh draw_mesh(std::span<const glm::dvec3> points,
                                     const CompressedRows<std::int32_t>& faces,
                                     const MeshDrawingOptions& options = {});

}  // namespace espalier::viewer
