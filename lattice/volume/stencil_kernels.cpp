#include "lattice/volume/stencil_kernels.h"

namespace espalier {

template <>
SumRows<float> stencil_kernel(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kSumFloatRows : baseline::kSumFloatRows;
}

template <>
SumRows<double> stencil_kernel(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kSumDoubleRows : baseline::kSumDoubleRows;
}

}  // namespace espalier
