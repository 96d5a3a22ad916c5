#pragma once

/// The innermost loop of re-posing, once per instruction set.

#include <cstddef>
#include <cstdint>

#include "lattice/core/instruction_set.h"

namespace espalier {

/// Rows that are summed up together, over one list of columns.
inline constexpr std::size_t kStencilRows = 16;

/// The weights that the rows of a block have for one column.
template <class Real>
struct alignas(64) ColumnWeights {
  Real of_rows[kStencilRows] = {};
};

/// The points of a block's rows. weights: #columns; controls: #controls × 3; points: kStencilRows
/// × 3. In double every product is rounded and added in the order of the columns, which gives the
/// same bits on every machine; in float they are fused where the set can.
template <class Real>
using SumRows = void (*)(const std::int32_t* columns, std::size_t n_columns,
                         const ColumnWeights<Real>* weights, const Real* controls, Real* points);

/// Real: float or double.
template <class Real>
[[nodiscard]] SumRows<Real> stencil_kernel(InstructionSet set);

namespace baseline {
extern const SumRows<float> kSumFloatRows;
extern const SumRows<double> kSumDoubleRows;
}  // namespace baseline
namespace avx2 {
extern const SumRows<float> kSumFloatRows;
extern const SumRows<double> kSumDoubleRows;
}  // namespace avx2

}  // namespace espalier
