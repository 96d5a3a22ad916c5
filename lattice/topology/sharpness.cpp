#include "lattice/topology/sharpness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "lattice/core/error.h"

namespace espalier {
namespace {

bool is_infinitely_sharp(float sharpness) {
  return sharpness >= kInfiniteSharpness;
}

/// Makes vertices on three or more infinitely sharp edges corners.
void sharpen_crossings(const CellComplex& complex, Sharpness& sharpness) {
  for (const VertexId vertex : complex.vertices()) {
    const auto edges = complex.edges(vertex);
    const auto n_sharp = std::count_if(edges.begin(), edges.end(), [&](EdgeId edge) {
      return is_infinitely_sharp(sharpness.edges[edge]);
    });
    if (n_sharp >= 3) {
      sharpness.vertices[vertex] = kInfiniteSharpness;
    }
  }
}

/// Twice the area vector of a boundary face, pointing outward.
glm::dvec3 outward_normal(const CellComplex& complex, FaceId face,
                          std::span<const glm::dvec3> points) {
  const auto loop = complex.vertices(face);
  const glm::dvec3 origin = points[loop[0].index()];
  glm::dvec3 normal(0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    normal += glm::cross(points[loop[i].index()] - origin, points[loop[i + 1].index()] - origin);
  }
  return complex.inner_half_face(face).side() == 0 ? normal : -normal;
}

/// Angle between the normals of the two boundary faces at an edge with one open fan, degrees.
double bend(const CellComplex& complex, EdgeId edge, std::span<const glm::dvec3> points) {
  std::vector<glm::dvec3> normals;
  for (const HalfFaceId half_face : complex.half_faces(edge)) {
    if (complex.is_boundary(half_face.face())) {
      normals.push_back(glm::normalize(outward_normal(complex, half_face.face(), points)));
    }
  }
  return glm::degrees(std::atan2(glm::length(glm::cross(normals[0], normals[1])),
                                 glm::dot(normals[0], normals[1])));
}

/// The boundary faces round one vertex, connected through the edges that have one fan only.
class BoundaryFans {
 public:
  BoundaryFans(const CellComplex& complex, VertexId vertex) : complex_(complex) {
    for (const FaceId face : complex.faces(vertex)) {
      if (complex.is_boundary(face)) {
        faces_.push_back(face);
      }
    }
    is_reached_.assign(faces_.size(), false);
    for (std::size_t start = 0; start < faces_.size(); ++start) {
      if (!is_reached_[start]) {
        walk(start, vertex);
      }
    }
  }

  /// Whether the boundary is one disk round the vertex.
  [[nodiscard]] bool is_disk() const { return n_crossing_ == 0 && n_other_ == 1; }
  /// Whether every fan runs from one edge with more fans to another.
  [[nodiscard]] bool all_cross() const { return n_other_ == 0; }

 private:
  /// Reaches the whole fan of a face.
  void walk(std::size_t start, VertexId vertex) {
    std::array<EdgeId, 2> touching;
    std::vector<std::size_t> stack = {start};
    is_reached_[start] = true;
    while (!stack.empty()) {
      const FaceId face = faces_[stack.back()];
      stack.pop_back();
      for (const EdgeId edge : complex_.edges(face)) {
        const auto& ends = complex_.vertices(edge);
        if (ends[0] != vertex && ends[1] != vertex) {
          continue;
        }
        if (complex_.n_open_fans(edge) != 1) {
          touching[touching[0].is_valid() ? 1 : 0] = edge;
          continue;
        }
        for (const HalfFaceId half_face : complex_.half_faces(edge)) {
          const auto found = std::lower_bound(faces_.begin(), faces_.end(), half_face.face());
          const auto at = static_cast<std::size_t>(found - faces_.begin());
          if (at < faces_.size() && faces_[at] == half_face.face() && !is_reached_[at]) {
            is_reached_[at] = true;
            stack.push_back(at);
          }
        }
      }
    }
    ++(touching[0] != touching[1] ? n_crossing_ : n_other_);
  }

  const CellComplex& complex_;
  std::vector<FaceId> faces_;  // ascending
  std::vector<bool> is_reached_;
  int n_crossing_ = 0;  // from one touching edge to another
  int n_other_ = 0;     // closed, or from a touching edge back to it
};

}  // namespace

Sharpness smooth_sharpness(const CellComplex& complex) {
  return {IdVector<EdgeId, float>(complex.n_edges(), 0.0f),
          IdVector<VertexId, float>(complex.n_vertices(), 0.0f)};
}

Sharpness automatic_sharpness(const CellComplex& complex) {
  Sharpness sharpness = smooth_sharpness(complex);
  for (const EdgeId edge : complex.edges()) {
    if (complex.is_boundary(edge) && complex.n_cells(edge) == 1) {
      sharpness.edges[edge] = kInfiniteSharpness;
    }
  }
  for (const VertexId vertex : complex.vertices()) {
    if (complex.cells(vertex).size() == 1) {
      sharpness.vertices[vertex] = kInfiniteSharpness;
    }
  }
  sharpen_crossings(complex, sharpness);
  return sharpness;
}

Sharpness sharpness_by_angle(const CellComplex& complex, std::span<const glm::dvec3> points,
                             double degrees) {
  if (!(degrees >= 0 && degrees <= 180)) {
    throw ParameterError(
        fmt::format("sharpness_by_angle: the angle is {}, not within [0, 180] degrees", degrees));
  }
  constexpr double kRounding = 1e-9;
  Sharpness sharpness = smooth_sharpness(complex);
  for (const EdgeId edge : complex.edges()) {
    if (complex.is_boundary(edge) &&
        (complex.n_open_fans(edge) > 1 || bend(complex, edge, points) > degrees + kRounding)) {
      sharpness.edges[edge] = kInfiniteSharpness;
    }
  }
  sharpen_crossings(complex, sharpness);
  return sharpness;
}

Sharpness with_touching_elements(const CellComplex& complex, Sharpness sharpness) {
  const auto sharpen = [](float& value) { value = std::max(value, kInfiniteSharpness); };
  for (const EdgeId edge : complex.edges()) {
    if (complex.n_open_fans(edge) > 1) {
      sharpen(sharpness.edges[edge]);
    }
  }
  for (const VertexId vertex : complex.vertices()) {
    if (!complex.is_boundary(vertex)) {
      continue;
    }
    const BoundaryFans fans(complex, vertex);
    if (fans.is_disk()) {
      continue;
    }
    const auto edges = complex.edges(vertex);
    const auto n_touching = std::count_if(
        edges.begin(), edges.end(), [&](EdgeId edge) { return complex.n_open_fans(edge) > 1; });
    if (n_touching != 2 || !fans.all_cross()) {
      sharpen(sharpness.vertices[vertex]);
    }
  }
  return sharpness;
}

}  // namespace espalier
