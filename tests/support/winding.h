#pragma once

/// An oracle for what is inside a lattice: how often its refined boundary winds round a point.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "lattice/subdivision/refine.h"

namespace espalier::test {

/// The boundary of a lattice at rest, refined, as triangles that look outward.
class WindingOracle {
 public:
  WindingOracle(const SubdivisionLattice& lattice, int levels) {
    const SubdivisionLattice fine = refined(lattice, levels);
    for (const FaceId face : fine.complex->faces()) {
      if (!fine.complex->is_boundary(face)) {
        continue;
      }
      const auto loop = fine.complex->vertices(face);
      const bool is_reversed = fine.complex->inner_half_face(face).side() != 0;
      for (std::size_t i = 2; i < loop.size(); ++i) {
        const glm::dvec3 a = fine.rest[loop[0].index()];
        const glm::dvec3 b = fine.rest[loop[i - 1].index()];
        const glm::dvec3 c = fine.rest[loop[i].index()];
        triangles_.push_back({a, is_reversed ? c : b, is_reversed ? b : c});
      }
    }
  }

  /// 1 inside, 0 outside, between very near to the boundary: the sum of the triangles' solid angles
  /// [Van Oosterom, Strackee 1983].
  [[nodiscard]] double operator()(const glm::dvec3& x) const {
    double sum = 0;
    for (const auto& [p, q, r] : triangles_) {
      const glm::dvec3 a = p - x;
      const glm::dvec3 b = q - x;
      const glm::dvec3 c = r - x;
      const double la = glm::length(a);
      const double lb = glm::length(b);
      const double lc = glm::length(c);
      sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                               glm::dot(b, c) * la +
                                                               glm::dot(c, a) * lb);
    }
    return sum / (4 * std::numbers::pi);
  }

 private:
  struct Triangle {
    glm::dvec3 a, b, c;
  };
  std::vector<Triangle> triangles_;
};

}  // namespace espalier::test
