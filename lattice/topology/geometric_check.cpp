#include "lattice/topology/geometric_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "lattice/core/box_tree.h"
#include "lattice/core/text_scanner.h"
#include "lattice/topology/defect_collection.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {
namespace {

/// A cell's volume counts as none below this part of its box's diagonal cubed.
constexpr double kVolumeRounding = 1e-12;

VertexId vertex_id(std::size_t i) {
  return VertexId{static_cast<std::int32_t>(i)};
}

/// "vertex 7 WHAT", or "vertex 7 and 2 others WHAT".
std::string name_vertices(const std::vector<std::size_t>& vertices, std::string_view what) {
  const std::size_t first = *std::min_element(vertices.begin(), vertices.end());
  if (vertices.size() == 1) {
    return fmt::format("vertex {} {}", first, what);
  }
  return fmt::format("vertex {} and {} more {}", first, vertices.size() - 1, what);
}

std::optional<Defect> check_edge(const CellComplex& complex, std::span<const glm::dvec3> points,
                                 double tolerance, const BoxTree& vertices, EdgeId edge) {
  const auto& ends = complex.vertices(edge);
  const glm::dvec3& a = points[ends[0].index()];
  const glm::dvec3& b = points[ends[1].index()];
  Box box;
  box.add(a);
  box.add(b);
  std::vector<std::size_t> inside;
  vertices.visit_overlapping(box.grown(tolerance), [&](std::size_t i) {
    const glm::dvec3& point = points[i];
    if (vertex_id(i) != ends[0] && vertex_id(i) != ends[1] &&
        distance_to_segment(point, a, b) <= tolerance && glm::distance(point, a) > tolerance &&
        glm::distance(point, b) > tolerance) {
      inside.push_back(i);
    }
  });
  if (inside.empty()) {
    return std::nullopt;
  }
  return make_edge_defect(DefectKind::VertexInsideEdge, ends[0].value, ends[1].value,
                          name_vertices(inside, "inside it, not among its ends"));
}

/// Whether a point is on a face but off its border.
bool is_inside_face(const glm::dvec3& point, std::span<const glm::dvec3> loop,
                    const std::vector<Triangle>& triangles, double tolerance) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3& next = loop[i + 1 < loop.size() ? i + 1 : 0];
    if (distance_to_segment(point, loop[i], next) <= tolerance) {
      return false;
    }
  }
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& triangle) {
    return distance_to_triangle(point, triangle) <= tolerance;
  });
}

std::optional<Defect> check_face(const CellComplex& complex, std::span<const glm::dvec3> points,
                                 double tolerance, const BoxTree& vertices, FaceId face) {
  const auto corners = complex.vertices(face);
  Box box;
  for (const VertexId corner : corners) {
    box.add(points[corner.index()]);
  }
  std::vector<glm::dvec3> loop;  // filled for the first candidate
  std::vector<Triangle> triangles;
  std::vector<std::size_t> inside;
  vertices.visit_overlapping(box.grown(tolerance), [&](std::size_t i) {
    if (std::find(corners.begin(), corners.end(), vertex_id(i)) != corners.end()) {
      return;
    }
    if (loop.empty()) {
      for (const VertexId corner : corners) {
        loop.push_back(points[corner.index()]);
      }
      append_face_triangles(loop, triangles);
    }
    if (is_inside_face(points[i], loop, triangles, tolerance)) {
      inside.push_back(i);
    }
  });
  if (inside.empty()) {
    return std::nullopt;
  }
  return make_defect(DefectKind::VertexInsideFace, "face", face.index(),
                     name_vertices(inside, "inside it, not among its corners"));
}

/// The first pair of points within `tolerance` that no edge joins, found by a sweep along x.
std::optional<std::pair<VertexId, VertexId>> find_coinciding(const CellComplex& complex,
                                                             std::span<const glm::dvec3> points,
                                                             CellId cell, double tolerance) {
  std::vector<VertexId> vertices(complex.vertices(cell).begin(), complex.vertices(cell).end());
  std::sort(vertices.begin(), vertices.end(), [&](VertexId a, VertexId b) {
    const double xa = points[a.index()].x;
    const double xb = points[b.index()].x;
    return xa != xb ? xa < xb : a < b;
  });
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3& point = points[vertices[i].index()];
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const glm::dvec3& other = points[vertices[j].index()];
      if (other.x - point.x > tolerance) {
        break;
      }
      if (glm::distance(point, other) <= tolerance &&
          !complex.find_edge(vertices[i], vertices[j]).is_valid()) {
        return std::minmax(vertices[i], vertices[j]);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Defect> find_bad_coordinates(std::span<const glm::dvec3> points) {
  std::vector<Defect> defects;
  const auto check = [&](std::size_t i) -> std::optional<Defect> {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(points[i][axis]) <= kLargestCoordinate)) {
        return make_defect(DefectKind::NotFinite, "vertex", i,
                           fmt::format("its {} is {}, not a finite number up to 1e18", "xyz"[axis],
                                       points[i][axis]));
      }
    }
    return std::nullopt;
  };
  collect_defects(points.size(), check, defects);
  return defects;
}

std::vector<glm::dvec3> normalized_points(std::span<const glm::dvec3> points) {
  Box box;
  for (const glm::dvec3& point : points) {
    box.add(point);
  }
  const glm::dvec3 centre = box.min + (box.max - box.min) / 2.0;
  const glm::dvec3 size = box.max - box.min;
  const double longest = std::max({size.x, size.y, size.z});
  std::vector<glm::dvec3> normalized(points.size(), glm::dvec3(0));
  if (longest > 0) {
    // Divided twice: squares of tiny sizes would vanish.
    const double diagonal = glm::length(size / longest);
    std::transform(points.begin(), points.end(), normalized.begin(),
                   [&](const glm::dvec3& point) { return (point - centre) / longest / diagonal; });
  }
  return normalized;
}

std::vector<Defect> find_zero_length_edges(const CellComplex& complex,
                                           std::span<const glm::dvec3> points, double tolerance) {
  std::vector<Defect> defects;
  const auto check = [&](std::size_t i) -> std::optional<Defect> {
    const auto& ends = complex.vertices(EdgeId{static_cast<std::int32_t>(i)});
    if (glm::distance(points[ends[0].index()], points[ends[1].index()]) > tolerance) {
      return std::nullopt;
    }
    return make_edge_defect(DefectKind::ZeroLengthEdge, ends[0].value, ends[1].value,
                            "its ends coincide");
  };
  collect_defects(complex.n_edges(), check, defects);
  return defects;
}

std::vector<Defect> find_self_touching_cells(const CellComplex& complex,
                                             std::span<const glm::dvec3> points, double tolerance) {
  std::vector<Defect> defects;
  const auto check = [&](std::size_t i) -> std::optional<Defect> {
    const CellId cell{static_cast<std::int32_t>(i)};
    const auto pair = find_coinciding(complex, points, cell, tolerance);
    if (!pair) {
      return std::nullopt;
    }
    return make_defect(DefectKind::SelfTouchingCell, "cell", i,
                       fmt::format("touches itself: its vertices {} and {} are in one place",
                                   pair->first.value, pair->second.value));
  };
  collect_defects(complex.n_cells(), check, defects);
  return defects;
}

std::vector<Defect> find_inverted_cells(const CellComplex& complex,
                                        std::span<const glm::dvec3> points) {
  const Polyhedra polyhedra = complex.polyhedra();
  std::vector<Defect> defects;
  const auto check = [&](std::size_t i) -> std::optional<Defect> {
    Box box;
    for (const VertexId vertex : complex.vertices(CellId{static_cast<std::int32_t>(i)})) {
      box.add(points[vertex.index()]);
    }
    const double size = glm::length(box.max - box.min);
    const double volume = signed_volume(polyhedra, i, points);
    if (volume > kVolumeRounding * size * size * size) {
      return std::nullopt;
    }
    const bool is_flat = volume >= -kVolumeRounding * size * size * size;
    return make_defect(DefectKind::InvertedCell, "cell", i,
                       is_flat ? "has no volume" : "is inverted: its volume is negative");
  };
  collect_defects(complex.n_cells(), check, defects);
  return defects;
}

std::vector<Defect> find_vertices_inside(const CellComplex& complex,
                                         std::span<const glm::dvec3> points, double tolerance) {
  std::vector<Box> boxes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    boxes[i].add(points[i]);
  }
  const BoxTree vertices(std::move(boxes));
  std::vector<Defect> defects;
  const auto check_one_edge = [&](std::size_t i) {
    const EdgeId edge{static_cast<std::int32_t>(i)};
    return check_edge(complex, points, tolerance, vertices, edge);
  };
  const auto check_one_face = [&](std::size_t i) {
    const FaceId face{static_cast<std::int32_t>(i)};
    return check_face(complex, points, tolerance, vertices, face);
  };
  collect_defects(complex.n_edges(), check_one_edge, defects);
  collect_defects(complex.n_faces(), check_one_face, defects);
  return defects;
}

}  // namespace espalier
