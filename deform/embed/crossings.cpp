/// Edges against the quadrilaterals of a boundary. After T. Möller, B. Trumbore, "Fast, minimum
/// storage ray/triangle intersection", 1997.

#include "deform/embed/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "lattice/core/box_tree.h"
#include "lattice/core/parallel.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {
namespace {

/// Edges through the line between two triangles must hit one of them.
constexpr double kRounding = 1e-9;
/// The first radius of the search for the closest quadrilateral, as a part of the boundary's size.
constexpr double kFirstRadius = 1e-3;

/// The corners of a quadrilateral's two triangles.
constexpr std::array<std::array<std::size_t, 3>, 2> kTriangles = {{{0, 1, 2}, {0, 2, 3}}};

/// A place on a quadrilateral.
struct Place {
  std::size_t quad = 0;
  std::array<double, 4> weights = {0.25, 0.25, 0.25, 0.25};  ///< of its corners
  double along = std::numeric_limits<double>::infinity();    ///< of the edge, 0 to 1
};

/// Where the segment from a by d meets a triangle: how far along, and the last two corners'
/// weights.
std::optional<glm::dvec3> meet(const glm::dvec3& a, const glm::dvec3& d, const Triangle& triangle) {
  const glm::dvec3 e1 = triangle[1] - triangle[0];
  const glm::dvec3 e2 = triangle[2] - triangle[0];
  const glm::dvec3 normal = glm::cross(d, e2);
  const double determinant = glm::dot(e1, normal);
  if (determinant == 0) {
    return std::nullopt;
  }
  const glm::dvec3 from = a - triangle[0];
  const double u = glm::dot(from, normal) / determinant;
  const glm::dvec3 other = glm::cross(from, e1);
  const double v = glm::dot(d, other) / determinant;
  const double along = glm::dot(e2, other) / determinant;
  const bool is_hit = u >= -kRounding && v >= -kRounding && u + v <= 1 + kRounding &&
                      along >= -kRounding && along <= 1 + kRounding;
  return is_hit ? std::optional(glm::dvec3(along, u, v)) : std::nullopt;
}

/// The boundary at rest.
class Boundary {
 public:
  Boundary(const BoundarySurface& surface, std::span<const glm::dvec3> controls)
      : surface_(surface),
        points_(surface.points.apply(controls)),
        size_(box_of(points_).radius()) {
    std::vector<Box> boxes(surface.quads.n_rows());
    for (std::size_t quad = 0; quad < boxes.size(); ++quad) {
      for (const std::int32_t point : surface.quads[quad]) {
        boxes[quad].add(points_[static_cast<std::size_t>(point)]);
      }
    }
    tree_ = BoxTree(std::move(boxes));
  }

  /// Where the edge from a to b leaves, or where it is closest to the boundary.
  [[nodiscard]] Place leave(const glm::dvec3& a, const glm::dvec3& b) const {
    const Place first = first_hit(a, b);
    return std::isfinite(first.along) ? first : Place{closest_quad(a, b)};
  }

 private:
  [[nodiscard]] Triangle triangle(std::size_t quad, std::size_t half) const {
    Triangle result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = points_[static_cast<std::size_t>(surface_.quads[quad][kTriangles[half][i]])];
    }
    return result;
  }

  [[nodiscard]] Place first_hit(const glm::dvec3& a, const glm::dvec3& b) const {
    Place first;
    Box box;
    box.add(a);
    box.add(b);
    tree_.visit_overlapping(box.grown(kRounding * size_), [&](std::size_t quad) {
      for (std::size_t half = 0; half < 2; ++half) {
        const auto hit = meet(a, b - a, triangle(quad, half));
        if (hit && (hit->x < first.along || (hit->x == first.along && quad < first.quad))) {
          first = {quad, {0, 0, 0, 0}, hit->x};
          first.weights[kTriangles[half][0]] = 1 - hit->y - hit->z;
          first.weights[kTriangles[half][1]] = hit->y;
          first.weights[kTriangles[half][2]] = hit->z;
        }
      }
    });
    return first;
  }

  [[nodiscard]] std::size_t closest_quad(const glm::dvec3& a, const glm::dvec3& b) const {
    for (double radius = kFirstRadius * size_;; radius *= 2) {
      std::pair<double, std::size_t> closest = {radius, surface_.quads.n_rows()};
      for (const glm::dvec3& end : {a, b}) {
        tree_.visit_overlapping(Box{end, end}.grown(radius), [&](std::size_t quad) {
          for (std::size_t half = 0; half < 2; ++half) {
            closest = std::min(closest, {distance_to_triangle(end, triangle(quad, half)), quad});
          }
        });
      }
      if (closest.second < surface_.quads.n_rows()) {
        return closest.second;
      }
    }
  }

  const BoundarySurface& surface_;
  std::vector<glm::dvec3> points_;
  double size_;
  BoxTree tree_;
};

bool is_held(PointStatus status) {
  return status == PointStatus::Inside || status == PointStatus::Border;
}

/// An edge that leaves, from its held point.
struct LeavingEdge {
  std::int32_t face;
  std::int32_t held;
  std::int32_t other;
};

std::vector<LeavingEdge> leaving_edges(const CompressedRows<std::int32_t>& faces,
                                       std::span<const PointStatus> status) {
  std::vector<LeavingEdge> edges;
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto loop = faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = loop[i];
      const std::int32_t b = loop[i + 1 < loop.size() ? i + 1 : 0];
      const bool a_is_held = is_held(status[static_cast<std::size_t>(a)]);
      if (a_is_held != is_held(status[static_cast<std::size_t>(b)])) {
        edges.push_back({static_cast<std::int32_t>(face), a_is_held ? a : b, a_is_held ? b : a});
      }
    }
  }
  return edges;
}

}  // namespace

Crossings find_crossings(const BoundarySurface& boundary, std::span<const glm::dvec3> controls,
                         std::span<const glm::dvec3> points,
                         const CompressedRows<std::int32_t>& faces,
                         std::span<const PointStatus> status) {
  const std::vector<LeavingEdge> edges = leaving_edges(faces, status);
  Crossings crossings;
  if (edges.empty()) {
    return crossings;
  }
  const Boundary at_rest(boundary, controls);
  std::vector<Place> places(edges.size());
  parallel_for(
      edges.size(),
      [&](std::size_t i) {
        places[i] = at_rest.leave(points[static_cast<std::size_t>(edges[i].held)],
                                  points[static_cast<std::size_t>(edges[i].other)]);
      },
      64);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    crossings.edges.push_back({edges[i].face, edges[i].held, boundary.faces[places[i].quad]});
  }
  crossings.points =
      StencilTable::build(edges.size(), controls.size(), [&](std::size_t i, StencilRow& row) {
        for (std::size_t corner = 0; corner < 4; ++corner) {
          const std::int32_t point = boundary.quads[places[i].quad][corner];
          const StencilTable::Row source = boundary.points[static_cast<std::size_t>(point)];
          for (std::size_t k = 0; k < source.indices.size(); ++k) {
            row.add(source.indices[k], places[i].weights[corner] * source.weights[k]);
          }
        }
      });
  return crossings;
}

}  // namespace espalier
