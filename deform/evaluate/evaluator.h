#pragma once

/// Evaluation of bound points, frame after frame.

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "deform/evaluate/kernels.h"
#include "deform/evaluate/point_runs.h"
#include "deform/evaluate/volume_motion.h"
#include "lattice/core/instruction_set.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// What a frame is to write, each #points or empty: not wanted. Gradients, determinants, normals
/// and tangents only if BoundPoints asked for them. What is not written keeps its bits.
template <class Real>
struct MovedPoints {
  std::span<glm::vec<3, Real>> points = {};        ///< x' = x + Σ w_i (P_i − P_i at rest)
  std::span<glm::mat<3, 3, Real>> gradients = {};  ///< J = ∂x'/∂x; column b along axis b
  std::span<Real> determinants = {};               ///< det J
  std::span<glm::vec<3, Real>> normals = {};       ///< cof(J) n, of length 1, or zero
  std::span<glm::vec<3, Real>> tangents = {};      ///< J t
};

/// Which points a frame writes.
enum class Scope {
  All,
  Moved,   ///< those in patches of which some point is moved; others are at rest
  Changed  ///< those in patches of which some point changed; others are as in the frame before
};

/// Points bound to a volume, ready for any number of frames. The same bits for any number of
/// threads, any scope and whatever else is asked for; they depend on the instruction set. A point
/// that no moved control point reaches keeps the bits of its rest point (rounded to Real).
/// Real: float, with an error of about 3e-7 of the motion's extent, or double.
template <class Real>
class Evaluator {
 public:
  /// The volume must live as long. Throws as make_point_runs.
  Evaluator(const Volume& volume, const BoundPoints& points,
            InstructionSet set = instruction_set());

  [[nodiscard]] std::size_t n_points() const { return runs_.n_points; }

  /// One frame. motion: of the volume. Throws ParameterError for spans of another length, for what
  /// BoundPoints did not ask for, for a motion of another volume's size, and for one with weights
  /// if the volume has none. Allocates nothing once every thread has worked, but where weights
  /// change. O(#points written + #patches).
  void evaluate(const VolumeMotion<Real>& motion, const MovedPoints<Real>& moved,
                Scope scope = Scope::All) const;

  /// Heap memory in use.
  [[nodiscard]] std::size_t bytes() const { return runs_.bytes(); }

 private:
  const Volume* volume_;
  const EvaluationKernels<Real>* kernels_;
  PointRuns<Real> runs_;
};

}  // namespace espalier
