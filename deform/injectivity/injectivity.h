#pragma once

/// Whether a pose folds space anywhere, not only at points that were looked at ([THB18] section 3
/// keeps the points of the model from folding).
///
/// What is certified is the frozen volume, leaves included: on the closed unit cube of every patch
/// det ∂X_pose/∂(u,v,w) has the sign it has at rest, so that x → x' is locally injective there. The
/// sliver beyond a leaf's cube that it may hold points in (kLeafReach) and the seams where leaves
/// meet only nearly are not. Factors that vanish at collapsed faces, such as (1 − w)² of pyramids,
/// are divided out. Where a lattice is singular at rest, at a point of the boundary say, or where
/// rounding hides whether it is, it stays undecided. A rational patch is certified by its
/// homogeneous points, without division.

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "deform/injectivity/positivity.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Where control points are posed. Of a rational volume the weights may be others than at rest.
struct PosedControls {
  // NOLINTBEGIN(google-explicit-constructor): points are a pose.
  PosedControls(std::span<const glm::dvec3> controls, std::span<const double> point_weights = {})
      : points(controls), weights(point_weights) {}
  PosedControls(const std::vector<glm::dvec3>& controls) : points(controls) {}
  // NOLINTEND(google-explicit-constructor)

  std::span<const glm::dvec3> points;  ///< #controls, model units
  std::span<const double> weights;     ///< #points of a rational volume; empty: as at rest
};

/// A place where space is folded.
struct Fold {
  std::size_t patch;
  glm::dvec3 uvw;
  glm::dvec3 rest;     ///< the place at rest, model units
  double determinant;  ///< of ∂x'/∂x there, negative
};

/// Where the sign of the determinant was not found.
struct UndecidedBox {
  std::size_t patch;
  ParameterBox box;
  glm::dvec3 rest;  ///< the place of its middle at rest, model units
};

/// What is known of the patches of a pose.
struct LocalInjectivity {
  Verdict verdict = Verdict::Certified;
  std::size_t n_patches = 0;            ///< looked at
  std::vector<Fold> folds;              ///< at most one a patch, by patch
  std::vector<UndecidedBox> undecided;  ///< by patch
};

/// How far a motion may go.
struct SafeStep {
  double step = 0;       ///< no fold for any t below; infinite if no t folds anything
  bool is_tight = true;  ///< a fold is known at t <= (1 + tolerance) · step, if step is finite and
                         ///< below the most that was asked for
  std::size_t patch = 0;  ///< where the first fold is, if there is one
  glm::dvec3 uvw{0};
};

struct SafeStepOptions {
  double tolerance = 1e-4;                                     ///< relative
  double most_step = std::numeric_limits<double>::infinity();  ///< farther steps are of no interest
  std::size_t most_boxes = 20000;
};

/// Checks poses of one volume. Made once: O(#patches).
class InjectivityCheck {
 public:
  /// Throws LatticeError, naming the place, if the lattice at rest is folded, or flat throughout a
  /// patch by more than rounding may make it so: then there is nothing to compare with. No volume:
  /// its patches are used by every call.
  explicit InjectivityCheck(std::shared_ptr<const Volume> volume);

  /// Of all patches, or of those listed. most_boxes: parts of a patch that may be looked at. Throws
  /// ParameterError unless pose is #controls points within 1e18, with positive weights if any. A
  /// patch takes some microseconds, a rational one some tens, one that does not move nothing. The
  /// same result for any number of threads.
  [[nodiscard]] LocalInjectivity local(const PosedControls& pose,
                                       std::size_t most_boxes = 2000) const;
  [[nodiscard]] LocalInjectivity local(const PosedControls& pose,
                                       std::span<const std::int32_t> patches,
                                       std::size_t most_boxes = 2000) const;

  /// The largest t found such that pose + s · motion folds no patch that moves for 0 <= s < t:
  /// certified, as local() is; weights stay those of the pose. motion: #controls. Throws
  /// LatticeError if such a patch is folded at the start, ParameterError for values that are not
  /// finite.
  [[nodiscard]] SafeStep largest_step(const PosedControls& pose, std::span<const glm::dvec3> motion,
                                      const SafeStepOptions& options = {}) const;

  [[nodiscard]] const Volume& volume() const { return *volume_; }

 private:
  struct Frame;
  struct Workspace;
  static Workspace& workspace();
  [[nodiscard]] Frame frame_of(const PosedControls& pose) const;
  [[nodiscard]] Frame motion_of(std::span<const glm::dvec3> motion, const Frame& start) const;
  void patch_of(std::size_t i, const Frame& frame, BezierPatch& out) const;
  void find_determinant(const BezierPatch& patch, const Frame& frame, const Collapse& collapse,
                        BoundedPolynomial& out) const;
  void find_moving_determinant(std::size_t i, const Frame& start, const Frame& moves,
                               bool is_parallel) const;
  [[nodiscard]] Collapse collapse_of(std::size_t i, const Frame& pose) const;
  [[nodiscard]] glm::dvec3 rest_place(const glm::dvec3& uvw) const;
  void check_rest(std::size_t i);
  void check_patch(std::size_t i, const Frame& pose, std::size_t most_boxes,
                   LocalInjectivity& out) const;

  std::shared_ptr<const Volume> volume_;
  double rounding_ = 0;       // of a point, for control points of size 1
  bool is_mirrored_ = false;  // patches are left-handed at rest
  std::shared_ptr<const Frame> rest_;
  std::vector<char> is_rest_certain_;  // #patches: positive throughout at rest
};

}  // namespace espalier
