#include "deform/evaluate/drag_kernels.h"

namespace espalier {

template <>
const DragKernels<float>& drag_kernels(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kFloatDragKernels : baseline::kFloatDragKernels;
}

template <>
const DragKernels<double>& drag_kernels(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kDoubleDragKernels : baseline::kDoubleDragKernels;
}

}  // namespace espalier
