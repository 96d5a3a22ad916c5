#include "deform/direct/tall_qr.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "deform/direct/dense_products.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kPanel = 64;   // columns
constexpr Index kChunk = 128;  // columns that a thread takes at a time
constexpr Index kRowChunk = 256;

template <class Matrix>
MatrixPart<const double> part(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.rows()),
          static_cast<std::size_t>(matrix.cols()), static_cast<std::size_t>(matrix.outerStride())};
}

MatrixPart<double> changed(Eigen::Ref<MatrixXd> matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.rows()),
          static_cast<std::size_t>(matrix.cols()), static_cast<std::size_t>(matrix.outerStride())};
}

/// Calls body(begin, n) for parts of [0, n).
template <class Body>
void for_chunks(Index n, Index chunk, const Body& body) {
  parallel_for(
      static_cast<std::size_t>((n + chunk - 1) / chunk),
      [&](std::size_t i) {
        const Index begin = static_cast<Index>(i) * chunk;
        body(begin, std::min(chunk, n - begin));
      },
      1);
}

/// Reflections I − V T Vᵀ of the rows from `begin` on; V stands in the matrix's panel.
struct Panel {
  Index begin = 0;
  Index width = 0;
  MatrixXd T;
};

class Factorisation {
 public:
  Factorisation(MatrixXd matrix, const Progress& progress)
      : matrix_(std::move(matrix)), progress_(progress) {}

  [[nodiscard]] TallQr run() {
    const Index n = matrix_.cols();
    R_ = MatrixXd::Zero(n, n);
    for (Index begin = 0; begin < n; begin += kPanel) {
      tell(0.5 * done(begin));
      factorise(begin, std::min(kPanel, n - begin));
    }
    MatrixXd Q = MatrixXd::Identity(matrix_.rows(), n);
    for (std::size_t i = panels_.size(); i-- > 0;) {
      // Columns before the panel are still those of the identity, above its rows.
      const Index begin = panels_[i].begin;
      reflect<false>(panels_[i], Q.bottomRightCorner(Q.rows() - begin, n - begin));
      tell(1 - 0.5 * done(begin));
    }
    return {std::move(Q), std::move(R_)};
  }

 private:
  [[nodiscard]] double done(Index column) const {
    const double left = 1 - static_cast<double>(column) / static_cast<double>(matrix_.cols());
    return 1 - left * left;
  }
  void tell(double fraction) const { progress_.update("factorise", fraction); }

  [[nodiscard]] Eigen::Block<MatrixXd> rows_of(const Panel& panel) {
    return matrix_.block(panel.begin, panel.begin, matrix_.rows() - panel.begin, panel.width);
  }

  void factorise(Index begin, Index width) {
    Panel panel{begin, width, MatrixXd::Zero(width, width)};
    auto V = rows_of(panel);
    const Eigen::HouseholderQR<MatrixXd> qr(V);
    R_.block(begin, begin, width, width) =
        qr.matrixQR().topRows(width).triangularView<Eigen::Upper>();
    V = qr.matrixQR().triangularView<Eigen::UnitLower>();
    MatrixXd gram = MatrixXd::Zero(width, width);
    products_.add_transposed(part(V), part(V), 1, changed(gram));
    for (Index i = 0; i < width; ++i) {
      const double tau = qr.hCoeffs()[i];
      panel.T(i, i) = tau;
      panel.T.col(i).head(i) = -tau * (panel.T.topLeftCorner(i, i) * gram.col(i).head(i)).eval();
    }
    const Index rest = matrix_.cols() - begin - width;
    auto right = matrix_.block(begin, begin + width, matrix_.rows() - begin, rest);
    reflect<true>(panel, right);
    R_.block(begin, begin + width, width, rest) = right.topRows(width);
    panels_.push_back(std::move(panel));
  }

  /// C − V T Vᵀ C, or with Tᵀ.
  template <bool kIsTransposed>
  void reflect(const Panel& panel, Eigen::Ref<MatrixXd> C) {
    const auto V = rows_of(panel);
    for_chunks(C.cols(), kChunk, [&](Index begin, Index n) {
      auto columns = C.middleCols(begin, n);
      MatrixXd W = MatrixXd::Zero(panel.width, n);
      products_.add_transposed(part(V), part(columns), 1, changed(W));
      MatrixXd TW = MatrixXd::Zero(panel.width, n);
      (kIsTransposed ? products_.add_transposed : products_.add)(part(panel.T), part(W), 1,
                                                                 changed(TW));
      products_.add(part(V), part(TW), -1, changed(columns));
    });
  }

  MatrixXd matrix_;
  const Progress& progress_;
  const DenseProducts& products_ = dense_products(instruction_set());
  MatrixXd R_;
  std::vector<Panel> panels_;
};

}  // namespace

TallQr tall_qr(MatrixXd matrix, const Progress& progress) {
  return Factorisation(std::move(matrix), progress).run();
}

MatrixXd thin_product(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd result(A.rows(), B.cols());
  for_chunks(A.rows(), kRowChunk, [&](Index begin, Index n) {
    for (Index column = 0; column < B.cols(); ++column) {
      result.col(column).segment(begin, n).noalias() = A.middleRows(begin, n) * B.col(column);
    }
  });
  return result;
}

MatrixXd thin_transposed_product(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd result(A.cols(), B.cols());
  for_chunks(A.cols(), kPanel, [&](Index begin, Index n) {
    for (Index column = 0; column < B.cols(); ++column) {
      result.col(column).segment(begin, n).noalias() =
          A.middleCols(begin, n).transpose() * B.col(column);
    }
  });
  return result;
}

}  // namespace espalier
