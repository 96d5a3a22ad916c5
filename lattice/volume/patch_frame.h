#pragma once

/// The affine map that is nearest to a patch, and what it tells about where the patch is.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "lattice/core/box.h"
#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// uvw ↦ centre + axes (uvw − ½).
struct AffineMap {
  glm::dvec3 centre{0};
  glm::dmat3 axes{0};
  [[nodiscard]] glm::dvec3 value(const glm::dvec3& uvw) const {
    return centre + axes * (uvw - 0.5);
  }
};

/// The least-squares affine map of a patch's corners.
[[nodiscard]] AffineMap affine_map(const BezierView& patch);

/// Coordinates in which a patch is nearly the unit cube: a closed-form guess of where it takes a
/// value, and a tight test of whether it can. Made once a patch.
class PatchFrame {
 public:
  PatchFrame() = default;
  /// Without the test: may_hold() is always true. O(points of the patch), no allocation.
  /// Of a rational patch the frame is that of its points.
  explicit PatchFrame(const BezierView& patch);
  /// With the test. slack: a length by which values may lie beyond the patch; reach: the parameters
  /// that it may take values at, the unit cube or more.
  PatchFrame(const BezierPatch& patch, double slack, const Box& reach);

  /// Where the affine map takes the value x; the middle if it is singular.
  [[nodiscard]] glm::dvec3 local(const glm::dvec3& x) const {
    return inverse_ * (x - map_.centre) + 0.5;
  }
  /// False only if the patch takes no value, within the slack, at these local coordinates.
  [[nodiscard]] bool may_hold(const glm::dvec3& local) const { return bounds_.contains(local); }
  /// A start for Newton's method: local(x), but that a pyramid's section shrinks with 1 − w.
  [[nodiscard]] glm::dvec3 guess(const glm::dvec3& x) const { return guess_from(local(x)); }
  [[nodiscard]] glm::dvec3 guess_from(const glm::dvec3& local) const;

  /// Whether the patch is its affine map, to a few units of round-off.
  [[nodiscard]] bool is_affine() const { return is_affine_; }
  [[nodiscard]] const AffineMap& map() const { return map_; }
  /// Of map().axes; zero if they are dependent.
  [[nodiscard]] const glm::dmat3& inverse_axes() const { return inverse_; }

  /// A lower bound of the distance between two values inside the unit cube whose parameters differ
  /// by `step` along `axis` alone; 0 where nothing is known.
  [[nodiscard]] double least_distance(int axis, double step) const {
    return least_slope_[axis] * step;
  }

 private:
  /// What a rational patch does not share with the polynomial over its points.
  void forget_slopes() {
    is_affine_ = false;
    least_slope_ = glm::dvec3(0);
  }

  AffineMap map_;
  glm::dmat3 inverse_{0};
  Box bounds_{glm::dvec3(-std::numeric_limits<double>::infinity()),
              glm::dvec3(std::numeric_limits<double>::infinity())};
  glm::dvec3 least_slope_{0};
  bool is_affine_ = false;
  bool is_pyramid_ = false;
};

}  // namespace espalier
