#pragma once

/// The QR factorisation of matrices with many rows.

#include <Eigen/Dense>

#include "lattice/core/progress.h"

namespace espalier {

/// Orthonormal columns Q and a square, upper triangular R with Q R = the matrix.
struct TallQr {
  Eigen::MatrixXd Q;
  Eigen::MatrixXd R;
};

/// By Householder reflections in panels (R. Schreiber, C. Van Loan, "A storage-efficient WY
/// representation for products of Householder transformations", 1989), which is what Eigen does,
/// too, but on one thread, without telling how far it is and for the oldest processors alone.
/// matrix: no fewer rows than columns. Tells `progress` "factorise". The same bits for any number
/// of threads. O(#rows · #columns²).
[[nodiscard]] TallQr tall_qr(Eigen::MatrixXd matrix, const Progress& progress = {});

/// A B for a matrix B of few columns, with A read once; on any number of threads.
[[nodiscard]] Eigen::MatrixXd thin_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Aᵀ B, the same.
[[nodiscard]] Eigen::MatrixXd thin_transposed_product(const Eigen::MatrixXd& A,
                                                      const Eigen::MatrixXd& B);

}  // namespace espalier
