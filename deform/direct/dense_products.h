#pragma once

/// Products of dense matrices, once per instruction set.

#include <cstddef>

#include "lattice/core/instruction_set.h"

namespace espalier {

/// A part of a column-major matrix.
template <class Number>
struct MatrixPart {
  Number* values = nullptr;
  std::size_t n_rows = 0;
  std::size_t n_columns = 0;
  std::size_t stride = 0;  ///< from a column to the next
};

/// C must not overlap A or B. On one thread, so that the bits are the same on any number of them.
struct DenseProducts {
  /// C += factor · A B.
  void (*add)(MatrixPart<const double> A, MatrixPart<const double> B, double factor,
              MatrixPart<double> C);
  /// C += factor · Aᵀ B.
  void (*add_transposed)(MatrixPart<const double> A, MatrixPart<const double> B, double factor,
                         MatrixPart<double> C);
};

[[nodiscard]] const DenseProducts& dense_products(InstructionSet set);

namespace baseline {
extern const DenseProducts kDenseProducts;
}  // namespace baseline
namespace avx2 {
extern const DenseProducts kDenseProducts;
}  // namespace avx2

}  // namespace espalier
