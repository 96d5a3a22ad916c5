#pragma once

/// Surfaces as models, for what is fitted to them.

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "deform/model/surface_model.h"
#include "lattice/topology/face_triangles.h"

namespace espalier::test {

/// Points and faces in the making.
struct Surface {
  std::vector<glm::dvec3> points;
  CompressedRows<std::int32_t> faces;

  [[nodiscard]] Model model() const { return make_obj_model(points, faces, "model"); }
  /// The same with another's faces.
  [[nodiscard]] Surface with(const Surface& other) const {
    Surface both = *this;
    const auto first = static_cast<std::int32_t>(points.size());
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    for (std::size_t face = 0; face < other.faces.n_rows(); ++face) {
      std::vector<std::int32_t> loop(other.faces[face].begin(), other.faces[face].end());
      for (std::int32_t& point : loop) {
        point += first;
      }
      both.faces.push_back(loop);
    }
    return both;
  }
};

/// A closed box, outward quadrilaterals.
inline Surface box_surface(const glm::dvec3& low, const glm::dvec3& high) {
  Surface box;
  for (int corner = 0; corner < 8; ++corner) {
    box.points.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                            (corner & 4) != 0 ? high.z : low.z);
  }
  box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return box;
}

/// A torus about the z axis, n × n quadrilaterals.
inline Surface torus_surface(double ring, double tube, int n) {
  Surface torus;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = 2 * std::numbers::pi * i / n;
      const double b = 2 * std::numbers::pi * j / n;
      const double out = ring + tube * std::cos(b);
      torus.points.emplace_back(out * std::cos(a), out * std::sin(a), tube * std::sin(b));
      const int k = (i + 1) % n;
      const int l = (j + 1) % n;
      torus.faces.push_back(std::array{i * n + j, k * n + j, k * n + l, i * n + l});
    }
  }
  return torus;
}

/// A sphere of 2n × n quadrilaterals and, at the poles, triangles.
inline Surface sphere_surface(const glm::dvec3& centre, double radius, int n) {
  Surface sphere;
  const int round = 2 * n;
  for (int i = 1; i < n; ++i) {
    for (int j = 0; j < round; ++j) {
      const double a = std::numbers::pi * i / n;
      const double b = 2 * std::numbers::pi * j / round;
      sphere.points.push_back(centre + radius * glm::dvec3(std::sin(a) * std::cos(b),
                                                           std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  const int north = static_cast<int>(sphere.points.size());
  sphere.points.push_back(centre + glm::dvec3(0, 0, radius));
  sphere.points.push_back(centre - glm::dvec3(0, 0, radius));
  for (int j = 0; j < round; ++j) {
    const int k = (j + 1) % round;
    sphere.faces.push_back(std::array{north, j, k});
    for (int i = 0; i + 2 < n; ++i) {
      sphere.faces.push_back(
          std::array{i * round + j, (i + 1) * round + j, (i + 1) * round + k, i * round + k});
    }
    sphere.faces.push_back(std::array{(n - 2) * round + j, north + 1, (n - 2) * round + k});
  }
  return sphere;
}

/// The sum of the areas of a model's faces, each along its normal.
inline glm::dvec3 area_of(const Model& model) {
  glm::dvec3 sum(0);
  std::vector<glm::dvec3> loop;
  for (std::size_t face = 0; face < model.faces().n_rows(); ++face) {
    loop.clear();
    for (const std::int32_t i : model.faces()[face]) {
      loop.push_back(model.points()[static_cast<std::size_t>(i)]);
    }
    sum += area_vector(loop);
  }
  return sum;
}

}  // namespace espalier::test
