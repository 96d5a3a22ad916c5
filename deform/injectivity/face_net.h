#pragma once

/// A Bézier surface that can be cut in parts, and what its control net says of all of a part.

#include <array>
#include <glm/mat2x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// Part [low, high] of [0,1]².
struct ParameterRectangle {
  glm::dvec2 low{0};
  glm::dvec2 high{1};
};

/// A Bézier surface over [0,1]²: (p+1)(q+1) points, s fastest.
class FaceNet {
 public:
  FaceNet() = default;
  /// Face `face` of index_order.h; s and t run along the patch's two other axes, the lower first.
  FaceNet(const BezierView& patch, int face);

  [[nodiscard]] int degree(int axis) const { return degree_[static_cast<std::size_t>(axis)]; }

  /// The same surface on a part of its square, by de Casteljau's algorithm.
  [[nodiscard]] FaceNet part(const ParameterRectangle& rectangle) const;

  [[nodiscard]] glm::dvec3 value(const glm::dvec2& st) const;
  /// The value, and the derivatives along s and t as columns.
  void evaluate(const glm::dvec2& st, glm::dvec3& value, glm::dmat2x3& derivative) const;

  /// The control points: the surface lies in their convex hull. `out` keeps its memory.
  void positions(std::vector<glm::dvec3>& out) const;

  /// The largest weight by the smallest; 1 of a polynomial.
  [[nodiscard]] double weight_spread() const;

  /// Vectors whose positive combinations hold the derivative along an axis everywhere: differences
  /// of control points; of a rational surface, whose derivative is Σ (B_k' B_i − B_i' B_k) C_j C_l
  /// w_ij w_kl (P_kl − P_ij) / w² over i < k, of pairs of rows. Each is off by at most twice what
  /// a control point is. Appended to `out`.
  void append_slopes(int axis, std::vector<glm::dvec3>& out) const;

 private:
  [[nodiscard]] const glm::dvec4& at(int i, int j) const {
    return points_[static_cast<std::size_t>(i + (degree_[0] + 1) * j)];
  }
  void cut(int axis, double low, double high);
  void append_rational_slopes(int axis, std::vector<glm::dvec3>& out) const;

  std::array<int, 2> degree_ = {0, 0};
  bool is_rational_ = false;
  std::vector<glm::dvec4> points_ = {glm::dvec4(0, 0, 0, 1)};  // times their weight, and the weight
};

/// The parameters of the patch at a place of its face.
[[nodiscard]] glm::dvec3 patch_place(int face, const glm::dvec2& st);

}  // namespace espalier
