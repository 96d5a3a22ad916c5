#include "viewer/render/mesh_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <string>
#include <tuple>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "viewer/render/polygon.h"

namespace espalier::viewer {
namespace {

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vector, or zero if there is no direction.
glm::dvec3 direction(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) {
    return glm::dvec3(0.0);
  }
  return glm::normalize(v / largest);
}

/// The corners of a face, by their place in it, without those that repeat the one before; empty if
/// it cannot be drawn.
std::vector<std::uint32_t> drawable_corners(std::span<const std::int32_t> face,
                                            std::span<const glm::dvec3> points) {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < face.size(); ++i) {
    const std::int32_t index = face[i];
    if (index < 0 || static_cast<std::size_t>(index) >= points.size() ||
        !is_finite(points[static_cast<std::size_t>(index)])) {
      return {};
    }
    if (corners.empty() || face[corners.back()] != index) {
      corners.push_back(i);
    }
  }
  while (corners.size() > 1 && face[corners.front()] == face[corners.back()]) {
    corners.pop_back();
  }
  std::vector<std::int32_t> distinct;
  for (const std::uint32_t corner : corners) {
    distinct.push_back(face[corner]);
  }
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return distinct.size() < 3 ? std::vector<std::uint32_t>() : corners;
}

/// The positions around a face.
void gather(std::span<const std::uint32_t> loop, std::span<const glm::dvec3> points,
            std::vector<glm::dvec3>& positions) {
  positions.clear();
  for (const std::uint32_t point : loop) {
    positions.push_back(points[point]);
  }
}

/// A corner of a face and one of the two points it is joined to.
struct Spoke {
  std::uint32_t point;
  std::uint32_t to;
  std::uint32_t corner;
  std::uint32_t face;
};

std::vector<Spoke> sorted_spokes(const CompressedRows<std::uint32_t>& loops) {
  std::vector<Spoke> spokes;
  spokes.reserve(2 * loops.n_values());
  for (std::uint32_t face = 0; face < loops.n_rows(); ++face) {
    const auto loop = loops[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto corner = static_cast<std::uint32_t>(loops.offset(face) + i);
      spokes.push_back({loop[i], loop[(i + 1) % loop.size()], corner, face});
      spokes.push_back({loop[i], loop[(i + loop.size() - 1) % loop.size()], corner, face});
    }
  }
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
    return std::tie(a.point, a.to, a.corner) < std::tie(b.point, b.to, b.corner);
  });
  return spokes;
}

/// Sets of corners, each named by its smallest member.
class CornerSets {
 public:
  explicit CornerSets(std::size_t n) : parents_(n) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t corner) {
    while (parents_[corner] != corner) {
      parents_[corner] = parents_[parents_[corner]];
      corner = parents_[corner];
    }
    return corner;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

/// The angle between two directions, 0 if one of them is none.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

MeshDrawing::MeshDrawing(std::span<const glm::dvec3> points,
                         const CompressedRows<std::int32_t>& faces,
                         const MeshDrawingOptions& options)
    : options_(options), n_points_(points.size()) {
  if (!options.corner_places.empty() && options.corner_places.size() != faces.n_values()) {
    throw ParameterError("MeshDrawing: " + std::to_string(options.corner_places.size()) +
                         " places in the texture given for " + std::to_string(faces.n_values()) +
                         " corners");
  }
  if (!options.face_groups.empty() && options.face_groups.size() != faces.n_rows()) {
    throw ParameterError("MeshDrawing: " + std::to_string(options.face_groups.size()) +
                         " groups given for " + std::to_string(faces.n_rows()) + " faces");
  }
  for (const std::int32_t group : options.face_groups) {
    if (group < 0) {
      throw ParameterError("MeshDrawing: a face has group " + std::to_string(group) +
                           ", they count from 0");
    }
  }
  keep_drawable_faces(points, faces);
  options_.corner_places = {};  // of the caller
  options_.face_groups = {};
  split_points_at_creases(points);
  triangulate_faces(points);
}

void MeshDrawing::check_points(std::span<const glm::dvec3> points) const {
  if (points.size() != n_points_) {
    throw ParameterError("MeshDrawing: got " + std::to_string(points.size()) +
                         " points, it was made for " + std::to_string(n_points_));
  }
}

void MeshDrawing::keep_drawable_faces(std::span<const glm::dvec3> points,
                                      const CompressedRows<std::int32_t>& faces) {
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const std::vector<std::uint32_t> corners = drawable_corners(faces[face], points);
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t corner : corners) {
      loop.push_back(static_cast<std::uint32_t>(faces[face][corner]));
      if (!options_.corner_places.empty()) {
        corner_places_.push_back(options_.corner_places[faces.offset(face) + corner]);
      }
    }
    if (!loop.empty()) {
      loops_.push_back(loop);
      loop_groups_.push_back(options_.face_groups.empty() ? 0 : options_.face_groups[face]);
    }
  }
}

/// Corners of one point whose faces meet in an edge at less than the crease angle share a vertex.
void MeshDrawing::split_points_at_creases(std::span<const glm::dvec3> points) {
  std::vector<glm::dvec3> face_normals(loops_.n_rows());
  parallel_for(loops_.n_rows(), [&](std::size_t face) {
    std::vector<glm::dvec3> loop;
    gather(loops_[face], points, loop);
    face_normals[face] = direction(area_vector(loop));
  });
  const double least_cosine = std::cos(glm::radians(options_.crease_angle));
  const std::vector<Spoke> spokes = sorted_spokes(loops_);
  CornerSets sets(loops_.n_values());
  for (std::size_t i = 1; i < spokes.size(); ++i) {
    const Spoke& a = spokes[i - 1];
    const Spoke& b = spokes[i];
    const bool is_one_place =
        corner_places_.empty() || corner_places_[a.corner] == corner_places_[b.corner];
    if (a.point == b.point && a.to == b.to && is_one_place &&
        glm::dot(face_normals[a.face], face_normals[b.face]) >= least_cosine) {
      sets.unite(a.corner, b.corner);
    }
  }
  corner_vertices_.resize(loops_.n_values());
  std::vector<std::vector<std::uint32_t>> corners;
  for (std::uint32_t corner = 0; corner < loops_.n_values(); ++corner) {
    const std::uint32_t first = sets.find(corner);
    if (first == corner) {
      corner_vertices_[corner] = static_cast<std::uint32_t>(vertex_points_.size());
      vertex_points_.push_back(loops_.values()[corner]);
      if (!corner_places_.empty()) {
        vertex_places_.push_back(corner_places_[corner]);
      }
      corners.emplace_back();
    }
    corner_vertices_[corner] = corner_vertices_[first];
    corners[corner_vertices_[corner]].push_back(corner);
  }
  for (const std::vector<std::uint32_t>& row : corners) {
    vertex_corners_.push_back(row);
  }
}

void MeshDrawing::triangulate_faces(std::span<const glm::dvec3> points) {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> order(loops_.n_rows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return loop_groups_[a] < loop_groups_[b]; });
  for (const std::size_t face : order) {
    gather(loops_[face], points, positions);
    corners.clear();
    triangulate(positions, corners);
    for (const std::uint32_t corner : corners) {
      triangles_.push_back(corner_vertices_[loops_.offset(face) + corner]);
    }
    const auto group = static_cast<std::size_t>(loop_groups_[face]);
    group_sizes_.resize(std::max(group_sizes_.size(), group + 1), 0);
    group_sizes_[group] += corners.size();
  }
  group_sizes_.resize(std::max(group_sizes_.size(), std::size_t{1}), 0);
}

MeshDrawing MeshDrawing::reordered(std::span<const std::uint32_t> order) const {
  std::vector<std::uint32_t> new_numbers(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    new_numbers[order[i]] = i;
  }
  MeshDrawing result = *this;
  for (auto* numbers : {&result.corner_vertices_, &result.triangles_}) {
    for (std::uint32_t& vertex : *numbers) {
      vertex = new_numbers[vertex];
    }
  }
  result.vertex_corners_ = {};
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.vertex_points_[i] = vertex_points_[order[i]];
    if (!vertex_places_.empty()) {
      result.vertex_places_[i] = vertex_places_[order[i]];
    }
    result.vertex_corners_.push_back(vertex_corners_[order[i]]);
  }
  return result;
}

std::vector<glm::vec3> MeshDrawing::positions(std::span<const glm::dvec3> points) const {
  check_points(points);
  std::vector<glm::vec3> positions(n_vertices());
  parallel_for(n_vertices(), [&](std::size_t i) {
    positions[i] = glm::vec3(options_.frame.to_drawing(points[vertex_points_[i]]));
  });
  return positions;
}

std::vector<glm::vec3> MeshDrawing::normals(std::span<const glm::dvec3> points) const {
  check_points(points);
  std::vector<glm::dvec3> corner_normals(loops_.n_values());
  parallel_for(loops_.n_rows(), [&](std::size_t face) {
    std::vector<glm::dvec3> loop;
    gather(loops_[face], points, loop);
    const glm::dvec3 normal = direction(area_vector(loop));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec3 next = direction(loop[(i + 1) % loop.size()] - loop[i]);
      const glm::dvec3 last = direction(loop[(i + loop.size() - 1) % loop.size()] - loop[i]);
      corner_normals[loops_.offset(face) + i] = angle_between(next, last) * normal;
    }
  });
  std::vector<glm::vec3> normals(n_vertices());
  parallel_for(n_vertices(), [&](std::size_t vertex) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t corner : vertex_corners_[vertex]) {
      sum += corner_normals[corner];
    }
    normals[vertex] = glm::vec3(direction(sum));
  });
  return normals;
}

TriangleMesh MeshDrawing::triangle_mesh(std::span<const glm::dvec3> points) const {
  return {positions(points), normals(points),  triangles_,
          options_.color,    options_.opacity, vertex_places_};
}

TriangleMesh draw_mesh(std::span<const glm::dvec3> points,
                       const CompressedRows<std::int32_t>& faces,
                       const MeshDrawingOptions& options) {
  return MeshDrawing(points, faces, options).triangle_mesh(points);
}

}  // namespace espalier::viewer
