#pragma once

/// The tensor-product Bézier hexahedron: the one kind of patch that volumes are made of.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lattice/core/box.h"

namespace espalier {

/// A Bézier hexahedron whose points stand elsewhere: of degree (p, q, r) per axis, with
/// (p+1)(q+1)(r+1) points, u fastest (index_order.h). Their values are positions, or displacements.
/// Degrees (1,1,1), (2,2,2), (3,3,3) and (1,1,3) have code of their own; no call allocates up to
/// degree 7.
struct BezierView {
  std::array<int, 3> degree = {1, 1, 1};
  std::span<const glm::dvec3> points;
  /// The points at w = 1 are all one, the apex, so derivatives along u and v carry a factor 1 − w.
  /// Of any degree; the derivative divided by it is regular up to the apex where the points of the
  /// layer below (at 1 − 1/r) span a proper cone with it.
  bool is_pyramid = false;
  /// Of a rational patch, one a point and positive: `points` are then numerators, positions times
  /// weights, and a value is their sum over that of the weights. Empty: a polynomial. No pyramid is
  /// rational.
  std::span<const double> weights = {};

  [[nodiscard]] bool is_rational() const { return !weights.empty(); }
  /// Point i where it stands: divided by its weight.
  [[nodiscard]] glm::dvec3 position(std::size_t i) const {
    return is_rational() ? points[i] / weights[i] : points[i];
  }

  /// uvw: in [0,1]³, or near it: the map goes on outside. Exactly zero if all points are.
  [[nodiscard]] glm::dvec3 value(const glm::dvec3& uvw) const;

  /// Derivatives along u, v, w as columns. For a pyramid the first two are divided by 1 − w, which
  /// keeps them independent up to the apex; of two patches with the same uvw that factor cancels.
  [[nodiscard]] glm::dmat3 derivative(const glm::dvec3& uvw) const;

  /// Both at once, which costs little more than the derivative.
  void evaluate(const glm::dvec3& uvw, glm::dvec3& value, glm::dmat3& derivative) const;

  /// Holds all values on [0,1]³.
  [[nodiscard]] Box hull_box() const;
};

/// A Bézier hexahedron with its points: see BezierView.
struct BezierPatch {
  std::array<int, 3> degree = {1, 1, 1};
  std::vector<glm::dvec3> points;
  bool is_pyramid = false;
  std::vector<double> weights = {};

  // NOLINTNEXTLINE(google-explicit-constructor): a patch serves wherever a view does.
  operator BezierView() const { return {degree, points, is_pyramid, weights}; }
  [[nodiscard]] BezierView view() const { return *this; }

  [[nodiscard]] glm::dvec3 value(const glm::dvec3& uvw) const { return view().value(uvw); }
  [[nodiscard]] glm::dmat3 derivative(const glm::dvec3& uvw) const {
    return view().derivative(uvw);
  }
  void evaluate(const glm::dvec3& uvw, glm::dvec3& value, glm::dmat3& derivative) const {
    view().evaluate(uvw, value, derivative);
  }
  [[nodiscard]] Box hull_box() const { return view().hull_box(); }

  /// The same map on the part [low, high] of the unit cube, by de Casteljau's algorithm per axis;
  /// low and high may lie outside it. Part of a pyramid is a pyramid, with a factor 1 − w of its
  /// own, if it ends at the apex.
  [[nodiscard]] BezierPatch part(const glm::dvec3& low, const glm::dvec3& high) const;

  /// The same map with a higher degree on an axis.
  [[nodiscard]] BezierPatch elevated(int axis, int new_degree) const;
};

}  // namespace espalier
