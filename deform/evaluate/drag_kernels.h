#pragma once

/// The innermost loops of a drag by one displacement, once per instruction set.

#include <cstddef>

#include "lattice/core/instruction_set.h"

namespace espalier {

/// Points that the kernels of a drag read together: their numbers stand in rows of this length, one
/// row after the other, then the next points.
inline constexpr std::size_t kDragBlock = 16;

/// Rows of a block of each array.
inline constexpr std::size_t kDragPlaceRows =
    4;  ///< points x y z x y z …, three rows long; weights
inline constexpr std::size_t kDragTurnRows = 4;  ///< of a PackedTurn: x, y, qx, qy
inline constexpr std::size_t kDragFoldRows = 3;  ///< p: det J changes by the factor 1 + p · D

/// Whole blocks of points that follow each other. What a kernel does not read or write may be null.
template <class Real>
struct DragBlocks {
  std::size_t n_blocks = 0;
  const Real* places = nullptr;
  const Real* turns = nullptr;
  Real* points = nullptr;   ///< #points × 3
  Real* normals = nullptr;  ///< #points × 3, of length 1, or zero
};

/// displacement: D, three numbers.
template <class Real>
struct DragKernels {
  void (*move)(const DragBlocks<Real>& blocks, const Real* displacement);
  void (*turn)(const DragBlocks<Real>& blocks, const Real* displacement);
  void (*move_and_turn)(const DragBlocks<Real>& blocks, const Real* displacement);
  /// The largest −p · D, at least 0. folds: #blocks of kDragFoldRows, at least one.
  Real (*largest_fall)(const Real* folds, std::size_t n_blocks, const Real* displacement);
};

/// Real: float or double.
template <class Real>
[[nodiscard]] const DragKernels<Real>& drag_kernels(InstructionSet set);

namespace baseline {
extern const DragKernels<float> kFloatDragKernels;
extern const DragKernels<double> kDoubleDragKernels;
}  // namespace baseline
namespace avx2 {
extern const DragKernels<float> kFloatDragKernels;
extern const DragKernels<double> kDoubleDragKernels;
}  // namespace avx2

}  // namespace espalier
