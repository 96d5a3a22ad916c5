/// Winding numbers after A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", 1983.

#include "lattice/topology/cell_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace espalier {
namespace {

/// Half-spaces that bound a cell at most: of cells with more faces the hull is larger than need be.
constexpr std::size_t kMostHalfSpaces = 64;

SurfaceTriangle make_surface_triangle(const Triangle& corners, FaceId face, double tolerance) {
  SurfaceTriangle triangle{corners, face};
  double longest2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.box.add(corners[i]);
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    longest2 = std::max(longest2, glm::dot(edge, edge));
  }
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(normal);
  if (length > 0) {
    triangle.normal = normal / length;
    triangle.slack = tolerance + 1e-15 * longest2 / length;  // a sliver's normal is uncertain
  }
  return triangle;
}

}  // namespace

void CellSurface::gather_loop(FaceId face) {
  loop_.clear();
  for (const VertexId vertex : complex_.vertices(face)) {
    loop_.push_back(points_[vertex.index()]);
  }
}

void CellSurface::load(CellId cell) {
  cell_ = cell;
  box_ = {};
  centroid_ = glm::dvec3(0);
  vertices_.clear();
  triangles_.clear();
  for (const VertexId vertex : complex_.vertices(cell)) {
    const glm::dvec3& point = points_[vertex.index()];
    vertices_.push_back(point);
    box_.add(point);
    centroid_ += point;
  }
  centroid_ /= static_cast<double>(vertices_.size());
  has_hull_ = false;
}

void CellSurface::make_hull() {
  hull_.clear();
  has_hull_ = true;
  const auto half_faces = complex_.half_faces(cell_);
  for (std::size_t i = 0; i < std::min(half_faces.size(), kMostHalfSpaces); ++i) {
    gather_loop(half_faces[i].face());
    const glm::dvec3 area = half_faces[i].side() == 0 ? area_vector(loop_) : -area_vector(loop_);
    const double length = glm::length(area);
    if (length > 0) {
      const glm::dvec3 normal = area / length;
      double last = -std::numeric_limits<double>::infinity();
      for (const glm::dvec3& vertex : vertices_) {
        last = std::max(last, glm::dot(normal, vertex));
      }
      hull_.push_back({normal, last});
    }
  }
}

const std::vector<SurfaceTriangle>& CellSurface::triangles() {
  if (triangles_.empty()) {
    for (const HalfFaceId half_face : complex_.half_faces(cell_)) {
      gather_loop(half_face.face());
      face_triangles_.clear();
      append_face_triangles(loop_, face_triangles_);
      for (Triangle& corners : face_triangles_) {
        if (half_face.side() == 1) {
          std::swap(corners[1], corners[2]);
        }
        triangles_.push_back(make_surface_triangle(corners, half_face.face(), tolerance_));
      }
    }
  }
  return triangles_;
}

bool CellSurface::has_face(FaceId face) const {
  return complex_.cell(HalfFaceId(face, 0)) == cell_ || complex_.cell(HalfFaceId(face, 1)) == cell_;
}

bool CellSurface::is_off_border(const glm::dvec3& point, FaceId face, double distance) const {
  const auto loop = complex_.vertices(face);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const VertexId next = loop[i + 1 < loop.size() ? i + 1 : 0];
    if (distance_to_segment(point, points_[loop[i].index()], points_[next.index()]) <= distance) {
      return false;
    }
  }
  return true;
}

bool CellSurface::is_beyond(std::span<const glm::dvec3> points, double depth) {
  if (!has_hull_) {
    make_hull();
  }
  return std::any_of(hull_.begin(), hull_.end(), [&](const HalfSpace& half_space) {
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
      return glm::dot(half_space.normal, point) >= half_space.last - depth;
    });
  });
}

double CellSurface::winding(const glm::dvec3& point) {
  double sum = 0;
  for (const SurfaceTriangle& triangle : triangles()) {
    sum += half_angle(point, triangle.corners);
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace espalier
