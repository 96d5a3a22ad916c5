// All of Eigen's dense algebra is here.

#include "deform/direct/minimum_norm.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using Complete = Eigen::CompleteOrthogonalDecomposition<MatrixXd>;

/// What counts as zero, relative to the largest pivot.
double tolerance_of(const MatrixXd& matrix) {
  return 8 * std::numeric_limits<double>::epsilon() *
         static_cast<double>(std::max<Index>({matrix.rows(), matrix.cols(), 1}));
}

Complete complete(const MatrixXd& matrix, double tolerance) {
  Complete result(matrix.rows(), matrix.cols());
  result.setThreshold(tolerance);
  result.compute(matrix);
  return result;
}

/// Orthonormal columns Q and a square R with Q R = matrix, which has more rows than columns.
struct Reduction {
  MatrixXd Q;
  MatrixXd R;

  explicit Reduction(const MatrixXd& matrix) {
    const Eigen::HouseholderQR<MatrixXd> qr(matrix);
    const Index n = matrix.cols();
    Q = qr.householderQ() * MatrixXd::Identity(matrix.rows(), n);
    R = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  }
};

MatrixXd matrix_of(const DenseMatrix& matrix) {
  return Eigen::Map<const MatrixXd>(matrix.values.data(), static_cast<Index>(matrix.n_rows),
                                    static_cast<Index>(matrix.n_columns));
}

Vectors vectors_of(std::span<const glm::dvec3> vectors) {
  Vectors result(static_cast<Index>(vectors.size()), 3);
  for (Index i = 0; i < result.rows(); ++i) {
    const glm::dvec3& v = vectors[static_cast<std::size_t>(i)];
    result.row(i) << v.x, v.y, v.z;
  }
  return result;
}

std::vector<glm::dvec3> points_of(const Vectors& vectors) {
  std::vector<glm::dvec3> result;
  result.reserve(static_cast<std::size_t>(vectors.rows()));
  for (Index i = 0; i < vectors.rows(); ++i) {
    result.emplace_back(vectors(i, 0), vectors(i, 1), vectors(i, 2));
  }
  return result;
}

}  // namespace

/// F = B [R; 0] with B orthogonal: the rows of Bᵀ A after F's rank are what y must solve alone, and
/// a then solves the others.
struct MinimumNorm::Free {
  MatrixXd A;
  MatrixXd complement;  // the columns of B after F's rank
  Complete F;
  std::size_t rank;

  Free(const MatrixXd& transposed, const MatrixXd& free)
      : A(transposed.transpose()), F(complete(free, tolerance_of(free))) {
    Eigen::ColPivHouseholderQR<MatrixXd> qr(free.rows(), free.cols());
    qr.setThreshold(tolerance_of(free));
    qr.compute(free);
    const MatrixXd B = qr.householderQ() * MatrixXd::Identity(free.rows(), free.rows());
    complement = B.rightCols(free.rows() - qr.rank());
    rank = static_cast<std::size_t>(qr.rank());
  }
};

/// The longer side of A is reduced first, its square core then factorised.
struct MinimumNorm::Factors {
  std::shared_ptr<const Free> free;            // none if there is no a
  std::shared_ptr<const Reduction> reduction;  // none if nothing is left to solve
  bool is_wide = false;                        // more unknowns than equations: of Aᵀ, else of A
  Index n_unknowns = 0;
  std::optional<Complete> core;
  std::optional<Eigen::HouseholderQR<MatrixXd>> damped;  // instead of the core

  void factorise(const MatrixXd& transposed) {
    n_unknowns = transposed.rows();
    if (transposed.size() == 0) {
      return;
    }
    is_wide = transposed.rows() > transposed.cols();
    reduction =
        std::make_shared<const Reduction>(is_wide ? transposed : MatrixXd(transposed.transpose()));
    core = complete(reduction->R, tolerance_of(transposed));
  }

  [[nodiscard]] Vectors solve_core(const Vectors& b) const {
    if (!core) {
      return Vectors::Zero(n_unknowns, 3);
    }
    const auto square = [&](const Vectors& right) -> Vectors {
      if (damped) {
        Vectors padded = Vectors::Zero(2 * right.rows(), 3);
        padded.topRows(right.rows()) = right;
        return damped->solve(padded);
      }
      if (is_wide) {
        return core->transpose().solve(right);
      }
      return core->solve(right);
    };
    if (is_wide) {
      return reduction->Q * square(b);
    }
    return square(reduction->Q.transpose() * b);
  }
};

void require_solvable(const DenseMatrix& transposed) {
  if (transposed.n_rows > kMostDenseEntries / std::max<std::size_t>(transposed.n_columns, 1)) {
    throw ParameterError(fmt::format("{} picks move {} control points: at most {} picks do at once",
                                     transposed.n_columns, transposed.n_rows,
                                     kMostDenseEntries / transposed.n_rows));
  }
}

MinimumNorm::MinimumNorm(const DenseMatrix& transposed, const DenseMatrix& free) {
  require_solvable(transposed);
  auto factors = std::make_shared<Factors>();
  const MatrixXd matrix = matrix_of(transposed);
  if (free.n_columns > 0 && free.n_rows > 0) {
    factors->free = std::make_shared<const Free>(matrix, matrix_of(free));
    factors->factorise(matrix * factors->free->complement);
  } else {
    factors->factorise(matrix);
  }
  factors_ = std::move(factors);
}

MinimumNorm::MinimumNorm(std::shared_ptr<const Factors> factors) : factors_(std::move(factors)) {}

MinimumNorm MinimumNorm::with_damping(double damping) const {
  auto factors = std::make_shared<Factors>(*factors_);
  if (factors->core) {
    const MatrixXd& R = factors->reduction->R;
    MatrixXd stacked(2 * R.rows(), R.cols());
    stacked.topRows(R.rows()) = factors->is_wide ? MatrixXd(R.transpose()) : R;
    stacked.bottomRows(R.rows()) =
        damping * factors->core->maxPivot() * MatrixXd::Identity(R.rows(), R.cols());
    factors->damped.emplace(stacked);
  }
  return MinimumNorm(std::shared_ptr<const Factors>(std::move(factors)));
}

MinimumNormSolution MinimumNorm::solve(std::span<const glm::dvec3> b) const {
  const Vectors right = vectors_of(b);
  const Free* free = factors_->free.get();
  if (free == nullptr) {
    return {points_of(factors_->solve_core(right)), {}};
  }
  const Vectors y = factors_->solve_core(free->complement.transpose() * right);
  const Vectors rest = right - free->A * y;
  return {points_of(y), points_of(free->F.solve(rest))};
}

std::size_t MinimumNorm::rank() const {
  return (factors_->free ? factors_->free->rank : 0) +
         (factors_->core ? static_cast<std::size_t>(factors_->core->rank()) : 0);
}

DenseMatrix MinimumNorm::independent_part(const DenseMatrix& transposed,
                                          const DenseMatrix& free) const {
  MatrixXd G = matrix_of(transposed);
  if (factors_->free && free.n_columns > 0) {
    const MatrixXd followed = factors_->free->F.solve(factors_->free->A);
    G -= (matrix_of(free) * followed).transpose();
  }
  if (factors_->core && factors_->is_wide) {
    const MatrixXd& Q = factors_->reduction->Q;
    G -= Q * (Q.transpose() * G).eval();
  } else if (factors_->core) {
    G.setZero();  // as many equations as unknowns: nothing is left to change
  }
  return {transposed.n_rows, transposed.n_columns, {G.data(), G.data() + G.size()}};
}

std::vector<glm::dvec3> MinimumNorm::free_change(std::span<const glm::dvec3> y) const {
  if (!factors_->free) {
    return {};
  }
  const Vectors change = factors_->free->A * vectors_of(y);
  return points_of(factors_->free->F.solve(Vectors(-change)));
}

}  // namespace espalier
