#pragma once

/// The innermost loops of evaluation: many points of one patch at a time, once per instruction set.

#include <cstddef>
#include <cstdint>

#include "deform/evaluate/axis_polynomial.h"
#include "lattice/core/instruction_set.h"

namespace espalier {

/// Points that kernels read together: their numbers stand in rows of this length, one row after the
/// other (u of eight points, v of eight points, …), then the next eight points. The last of a
/// patch's blocks is filled up with copies of its last point.
inline constexpr std::size_t kBlock = 8;

/// Rows of a block of each array.
inline constexpr std::size_t kPlaceRows = 6;   ///< u, v, w, then the rest point x, y, z
inline constexpr std::size_t kSlopeRows = 10;  ///< R = ∂x/∂(u,v,w) at rest by columns, 1 / det R
inline constexpr std::size_t kVectorRows = 3;  ///< a vector

/// Numbers between neighbours in v, and between neighbours in w, u in a patch's powers: v fastest,
/// filled up to an even number, then w, then u; each x, y, z and a number without meaning.
[[nodiscard]] constexpr std::size_t powers_in_v(int degree_v) {
  return (static_cast<std::size_t>(degree_v) + 2) / 2 * 2;
}
inline constexpr std::size_t kMaxPowers =
    4 * (kMaxKernelDegree + 1) * (kMaxKernelDegree + 1) * (kMaxKernelDegree + 1);

/// The points of one patch. What a kernel does not read or write may be null.
template <class Real>
struct PatchPoints {
  const Real* powers = nullptr;  ///< of the rest points minus the moved ones
  std::size_t n_points = 0;

  const Real* places = nullptr;    ///< blocks of kPlaceRows
  const Real* slopes = nullptr;    ///< blocks of kSlopeRows
  const Real* normals = nullptr;   ///< blocks of kVectorRows: Rᵀ n / det R
  const Real* tangents = nullptr;  ///< blocks of kVectorRows: R⁻¹ t

  Real* moved_points = nullptr;    ///< #points × 3
  Real* gradients = nullptr;       ///< #points × 9, column by column
  Real* determinants = nullptr;    ///< #points
  Real* moved_normals = nullptr;   ///< #points × 3
  Real* moved_tangents = nullptr;  ///< #points × 3
};

template <class Real>
struct EvaluationKernels {
  /// The powers of a patch. values: four numbers a point; block: the patch's points, u fastest;
  /// powers: kMaxPowers.
  void (*find_powers)(const Real* values, const std::int32_t* block,
                      const AxisPolynomial<Real>* const (&axes)[3], Real* powers);

  using Evaluate = void (*)(const PatchPoints<Real>&);
  static constexpr std::size_t kDegrees = kMaxKernelDegree;
  /// By the degrees less one along u, v, w: the moved points only.
  Evaluate points[kDegrees][kDegrees][kDegrees];
  /// Whatever is not null; needs slopes.
  Evaluate frames[kDegrees][kDegrees][kDegrees];
};

/// Real: float or double.
template <class Real>
[[nodiscard]] const EvaluationKernels<Real>& evaluation_kernels(InstructionSet set);

namespace baseline {
extern const EvaluationKernels<float> kFloatKernels;
extern const EvaluationKernels<double> kDoubleKernels;
}  // namespace baseline
namespace avx2 {
extern const EvaluationKernels<float> kFloatKernels;
extern const EvaluationKernels<double> kDoubleKernels;
}  // namespace avx2

}  // namespace espalier
