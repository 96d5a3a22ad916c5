#pragma once

/// A face of a Bézier hexahedron, and where it is closest to a point.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "lattice/core/box.h"
#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// A Bézier surface over [0,1]².
class BoundaryFace {
 public:
  /// Face `face` of index_order.h.
  BoundaryFace(const BezierView& patch, int face);

  struct Closest {
    glm::dvec2 st{0};
    glm::dvec3 point{0};
    double distance = 0;
    /// ∂s/∂x and ∂t/∂x as x moves; zero for a parameter that is held at the face's edge.
    std::array<glm::dvec3, 2> slopes{};
  };
  /// The point of the face closest to x, by damped Newton steps clamped to [0,1]² from the closest
  /// sample.
  [[nodiscard]] Closest closest(const glm::dvec3& x) const;

  [[nodiscard]] Box hull_box() const;
  /// The parameters of the hexahedron that s and t are.
  [[nodiscard]] const std::array<int, 2>& axes() const { return axes_; }
  [[nodiscard]] glm::dvec3 uvw(const glm::dvec2& st) const;

 private:
  /// A point of the surface with its derivatives.
  struct Jet {
    glm::dvec3 value, s, t, ss, st, tt;
  };
  [[nodiscard]] Jet jet(const glm::dvec2& st) const;
  /// Of Σ B points; points: as many as the face has points.
  [[nodiscard]] Jet polynomial_jet(const std::vector<glm::dvec3>& points,
                                   const glm::dvec2& st) const;
  /// Whether a step from a point at `from` relative to x, with `slope` there, leads nearer: by
  /// distance, or by the slope where distances differ only by round-off.
  [[nodiscard]] static bool is_better(const glm::dvec3& from, const glm::dvec2& slope,
                                      const Jet& there, const glm::dvec3& x,
                                      const glm::bvec2& is_free);
  [[nodiscard]] glm::dvec2 closest_sample(const glm::dvec3& x) const;

  [[nodiscard]] int n_samples(int axis) const { return degree_[axis] + 2; }

  int face_;
  std::array<int, 2> axes_;
  std::array<int, 2> degree_;
  std::vector<glm::dvec3> points_;   // s fastest; numerators if there are weights
  std::vector<glm::dvec3> weights_;  // of a rational face, each in all three components; or empty
  std::vector<glm::dvec3> samples_;  // a grid of n_samples() each way, s fastest
};

}  // namespace espalier
