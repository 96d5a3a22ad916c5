#pragma once

/// One cell's geometry, laid out for comparison with another's.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/box_tree.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {

/// A triangle of a face, wound counter-clockwise seen from outside its cell.
struct SurfaceTriangle {
  Triangle corners;
  FaceId face;
  Box box{};
  glm::dvec3 normal{};  ///< unit length, or zero if the triangle has no area
  double slack = 0;     ///< how far a point must be off the plane to count as off it
};

/// The surface and a convex hull of a cell. Loading another cell reuses the memory.
class CellSurface {
 public:
  /// points: #vertices; tolerance: a length, model units.
  CellSurface(const CellComplex& complex, std::span<const glm::dvec3> points, double tolerance)
      : complex_(complex), points_(points), tolerance_(tolerance) {}

  /// Loads the vertices; hull and triangles wait until they are asked for.
  void load(CellId cell);

  [[nodiscard]] CellId cell() const { return cell_; }
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] const glm::dvec3& centroid() const { return centroid_; }
  [[nodiscard]] std::span<const glm::dvec3> vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<SurfaceTriangle>& triangles();
  [[nodiscard]] bool has_face(FaceId face) const;

  /// Whether a point is farther than `distance` from the edges of a face.
  [[nodiscard]] bool is_off_border(const glm::dvec3& point, FaceId face, double distance) const;

  /// Whether one plane of the hull has all of some points outside or, at most, `depth` inside.
  [[nodiscard]] bool is_beyond(std::span<const glm::dvec3> points, double depth);
  /// Winding number of the surface round a point: 1 inside, 0 outside.
  [[nodiscard]] double winding(const glm::dvec3& point);

 private:
  /// The cell is where dot(normal, x) ≤ last; normal has unit length.
  struct HalfSpace {
    glm::dvec3 normal;
    double last;
  };
  void gather_loop(FaceId face);
  void make_hull();

  const CellComplex& complex_;
  std::span<const glm::dvec3> points_;
  double tolerance_;
  CellId cell_;
  Box box_;
  glm::dvec3 centroid_{};
  std::vector<glm::dvec3> vertices_;
  std::vector<HalfSpace> hull_;
  bool has_hull_ = false;
  std::vector<SurfaceTriangle> triangles_;  // empty: not yet made
  std::vector<glm::dvec3> loop_;
  std::vector<Triangle> face_triangles_;
};

}  // namespace espalier
