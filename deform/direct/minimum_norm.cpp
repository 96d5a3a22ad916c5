// Eigen's dense algebra is here and in tall_qr.

#include "deform/direct/minimum_norm.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "deform/direct/tall_qr.h"
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
  Eigen::ColPivHouseholderQR<MatrixXd> B;
  Complete F;
  MatrixXd followed;  // F⁺ A: what a must undo of y

  Free(const MatrixXd& transposed, const MatrixXd& free)
      : B(free.rows(), free.cols()), F(complete(free, tolerance_of(free))) {
    B.setThreshold(tolerance_of(free));
    B.compute(free);
    followed = F.solve(transposed.transpose());
  }

  [[nodiscard]] std::size_t rank() const { return static_cast<std::size_t>(B.rank()); }

  /// The columns of Aᵀ B after F's rank.
  [[nodiscard]] MatrixXd complement_of(MatrixXd transposed) const {
    transposed.applyOnTheRight(B.householderQ());
    return transposed.rightCols(transposed.cols() - B.rank());
  }
  /// The rows of Bᵀ b after it.
  [[nodiscard]] Vectors complement_of(Vectors b) const {
    b.applyOnTheLeft(B.householderQ().adjoint());
    return b.bottomRows(b.rows() - B.rank());
  }
};

/// A square R that solves equations: as it is, if its smallest singular value is far from what
/// counts as zero, else by a rank-revealing factorisation, which Eigen does column by column.
class MinimumNorm::Core {
 public:
  Core(std::shared_ptr<const TallQr> reduction, double tolerance)
      : reduction_(std::move(reduction)), largest_(R().colwise().norm().maxCoeff()) {
    if (!(least_singular_value() > kSureOfRank * tolerance * largest_)) {
      complete_ = complete(R(), tolerance);
    }
  }

  [[nodiscard]] Vectors solve(const Vectors& b) const {
    return complete_ ? Vectors(complete_->solve(b))
                     : Vectors(R().triangularView<Eigen::Upper>().solve(b));
  }
  [[nodiscard]] Vectors solve_transposed(const Vectors& b) const {
    return complete_ ? Vectors(complete_->transpose().solve(b))
                     : Vectors(R().transpose().triangularView<Eigen::Lower>().solve(b));
  }
  [[nodiscard]] std::size_t rank() const {
    return static_cast<std::size_t>(complete_ ? complete_->rank() : R().cols());
  }
  /// The largest length of a column.
  [[nodiscard]] double largest() const { return largest_; }

 private:
  static constexpr double kSureOfRank = 1e3;
  static constexpr int kIterations = 8;

  [[nodiscard]] const MatrixXd& R() const { return reduction_->R; }

  /// Estimated by inverse iteration: somewhat too large if anything.
  [[nodiscard]] double least_singular_value() const {
    if (!(R().diagonal().cwiseAbs().minCoeff() > 0)) {
      return 0;
    }
    Eigen::VectorXd x(R().cols());
    for (Index i = 0; i < x.size(); ++i) {
      constexpr double kGolden = 0.6180339887498949;
      const double turns = kGolden * static_cast<double>(i + 1);
      x[i] = 1.5 * (turns - std::floor(turns)) - 0.5;
    }
    double growth = 0;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      x /= x.norm();
      R().transpose().triangularView<Eigen::Lower>().solveInPlace(x);
      R().triangularView<Eigen::Upper>().solveInPlace(x);
      growth = x.norm();
      if (!std::isfinite(growth)) {
        return 0;
      }
    }
    return 1 / std::sqrt(growth);
  }

  std::shared_ptr<const TallQr> reduction_;
  double largest_;
  std::optional<Complete> complete_;
};

/// The longer side of A is reduced first, its square core then factorised.
struct MinimumNorm::Factors {
  std::shared_ptr<const Free> free;         // none if there is no a
  std::shared_ptr<const TallQr> reduction;  // none if nothing is left to solve
  bool is_wide = false;                     // more unknowns than equations: of Aᵀ, else of A
  Index n_unknowns = 0;
  std::shared_ptr<const Core> core;
  std::optional<Eigen::HouseholderQR<MatrixXd>> damped;  // instead of the core

  void factorise(MatrixXd transposed, const Progress& progress) {
    n_unknowns = transposed.rows();
    if (transposed.size() == 0) {
      return;
    }
    const double tolerance = tolerance_of(transposed);
    is_wide = transposed.rows() > transposed.cols();
    if (!is_wide) {
      transposed.transposeInPlace();
    }
    reduction = std::make_shared<const TallQr>(tall_qr(std::move(transposed), progress));
    core = std::make_shared<const Core>(reduction, tolerance);
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
      return is_wide ? core->solve_transposed(right) : core->solve(right);
    };
    if (is_wide) {
      return thin_product(reduction->Q, square(b));
    }
    return square(thin_transposed_product(reduction->Q, b));
  }
};

void require_solvable(const DenseMatrix& transposed) {
  if (transposed.n_rows > kMostDenseEntries / std::max<std::size_t>(transposed.n_columns, 1)) {
    throw ParameterError(fmt::format("{} picks move {} control points: at most {} picks do at once",
                                     transposed.n_columns, transposed.n_rows,
                                     kMostDenseEntries / transposed.n_rows));
  }
}

MinimumNorm::MinimumNorm(const DenseMatrix& transposed, const DenseMatrix& free,
                         const Progress& progress) {
  require_solvable(transposed);
  auto factors = std::make_shared<Factors>();
  MatrixXd matrix = matrix_of(transposed);
  if (free.n_columns > 0 && free.n_rows > 0) {
    factors->free = std::make_shared<const Free>(matrix, matrix_of(free));
    matrix = factors->free->complement_of(std::move(matrix));
  }
  factors->factorise(std::move(matrix), progress);
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
        damping * factors->core->largest() * MatrixXd::Identity(R.rows(), R.cols());
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
  const Vectors y = factors_->solve_core(free->complement_of(right));
  const Vectors a = free->F.solve(right) - thin_product(free->followed, y);
  return {points_of(y), points_of(a)};
}

std::size_t MinimumNorm::rank() const {
  return (factors_->free ? factors_->free->rank() : 0) +
         (factors_->core ? factors_->core->rank() : 0);
}

DenseMatrix MinimumNorm::independent_part(const DenseMatrix& transposed,
                                          const DenseMatrix& free) const {
  MatrixXd G = matrix_of(transposed);
  if (factors_->free && free.n_columns > 0) {
    G -= (matrix_of(free) * factors_->free->followed).transpose();
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
  return points_of(-thin_product(factors_->free->followed, vectors_of(y)));
}

}  // namespace espalier
