#include "deform/evaluate/kernels.h"

namespace espalier {

template <>
const EvaluationKernels<float>& evaluation_kernels(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kFloatKernels : baseline::kFloatKernels;
}

template <>
const EvaluationKernels<double>& evaluation_kernels(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kDoubleKernels : baseline::kDoubleKernels;
}

}  // namespace espalier
