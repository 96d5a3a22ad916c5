#include "deform/direct/dense_products.h"

namespace espalier {

const DenseProducts& dense_products(InstructionSet set) {
  return set == InstructionSet::Avx2 ? avx2::kDenseProducts : baseline::kDenseProducts;
}

}  // namespace espalier
