// All of Eigen's sparse algebra is here.

#include "deform/direct/smooth_motion.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "deform/direct/table_rows.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3>;

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Which parts control points belong to that no difference connects.
class Parts {
 public:
  explicit Parts(const StencilTable& differences) : parent_(differences.n_controls()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t i = 0; i < differences.n_rows(); ++i) {
      const auto indices = differences[i].indices;
      for (std::size_t k = 1; k < indices.size(); ++k) {
        const std::size_t a = of(static_cast<std::size_t>(indices[0]));
        const std::size_t b = of(static_cast<std::size_t>(indices[k]));
        parent_[std::max(a, b)] = std::min(a, b);
      }
    }
  }

  /// By the lowest control point in it.
  [[nodiscard]] std::size_t of(std::size_t control) {
    while (parent_[control] != control) {
      parent_[control] = parent_[parent_[control]];
      control = parent_[control];
    }
    return control;
  }

 private:
  std::vector<std::size_t> parent_;
};

/// The mean stiffness of the control points of a difference that may move.
double stiffness_of(const StencilTable::Row& row, std::span<const double> mobilities) {
  double sum = 0;
  double n = 0;
  for (const std::int32_t control : row.indices) {
    const double mobility = mobilities[static_cast<std::size_t>(control)];
    if (mobility > 0) {
      sum += 1 / mobility;
      n += 1;
    }
  }
  return n > 0 ? sum / n : 0;
}

/// With P K Pᵀ = L Lᵀ for K = Σ differenceᵀ difference over the control points that are unknown,
/// the coordinates are y = Lᵀ P ΔP. In a part without pins the lowest control point is no unknown:
/// it moves by the part's a, the others by a and their own.
class SmoothMotion final : public MotionEnergy {
 public:
  SmoothMotion(const StencilTable& rows, const StencilTable& differences,
               std::vector<double> mobilities)
      : n_controls_(rows.n_controls()), unknown_(n_controls_, kNone), free_(n_controls_, kNone) {
    Parts parts(differences);
    std::vector<char> is_seen(n_controls_, 0);
    std::vector<char> is_pinned(n_controls_, 0);
    for (std::size_t i = 0; i < rows.n_rows(); ++i) {
      for (const std::int32_t control : rows[i].indices) {
        is_seen[parts.of(static_cast<std::size_t>(control))] = 1;
      }
    }
    for (std::size_t c = 0; c < n_controls_; ++c) {
      if (mobilities[c] == 0) {
        is_pinned[parts.of(c)] = 1;
      }
    }
    std::size_t n_unknowns = 0;
    for (std::size_t c = 0; c < n_controls_; ++c) {
      const std::size_t part = parts.of(c);
      if (is_seen[part] == 0) {
        continue;
      }
      if (is_pinned[part] == 0) {
        free_[c] = part == c ? n_free_++ : free_[part];
      }
      if (mobilities[c] > 0 && (is_pinned[part] != 0 || part != c)) {
        unknown_[c] = n_unknowns++;
      }
    }
    factorise(differences, mobilities, static_cast<Index>(n_unknowns));
  }

  [[nodiscard]] std::size_t n_controls() const override { return n_controls_; }

  [[nodiscard]] DenseMatrix columns(const StencilTable& rows) const override {
    const auto n = static_cast<std::size_t>(cholesky_.rows());
    DenseMatrix result{n, rows.n_rows()};
    require_solvable(result);
    result.values.assign(n * rows.n_rows(), 0.0);
    parallel_for(
        n == 0 ? 0 : rows.n_rows(),
        [&](std::size_t i) {
          VectorXd column = VectorXd::Zero(static_cast<Index>(n));
          for_each_unknown(rows[i], [&](std::size_t place, double weight) {
            column[static_cast<Index>(place)] = weight;
          });
          column = cholesky_.permutationP() * column;
          cholesky_.matrixL().solveInPlace(column);
          std::copy(column.begin(), column.end(), &result.values[i * n]);
        },
        1);
    return result;
  }

  [[nodiscard]] DenseMatrix free_columns(const StencilTable& rows) const override {
    DenseMatrix result{rows.n_rows(), n_free_};
    result.values.assign(rows.n_rows() * n_free_, 0.0);
    for (std::size_t i = 0; i < rows.n_rows(); ++i) {
      const StencilTable::Row row = rows[i];
      for (std::size_t k = 0; k < row.indices.size(); ++k) {
        const std::size_t part = free_[static_cast<std::size_t>(row.indices[k])];
        if (part != kNone) {
          result.values[part * rows.n_rows() + i] += row.weights[k];
        }
      }
    }
    return result;
  }

  [[nodiscard]] std::vector<glm::dvec3> motion(std::span<const glm::dvec3> y,
                                               std::span<const glm::dvec3> a) const override {
    Vectors own(static_cast<Index>(y.size()), 3);
    for (Index i = 0; i < own.rows(); ++i) {
      const glm::dvec3& v = y[static_cast<std::size_t>(i)];
      own.row(i) << v.x, v.y, v.z;
    }
    if (!y.empty()) {
      cholesky_.matrixU().solveInPlace(own);
      own = (cholesky_.permutationPinv() * own).eval();
    }
    std::vector<glm::dvec3> result(n_controls_, glm::dvec3(0));
    for (std::size_t c = 0; c < n_controls_; ++c) {
      if (free_[c] != kNone) {
        result[c] = a[free_[c]];
      }
      if (unknown_[c] != kNone) {
        const auto row = own.row(static_cast<Index>(unknown_[c]));
        result[c] += glm::dvec3(row[0], row[1], row[2]);
      }
    }
    return result;
  }

 private:
  template <class Visit>
  void for_each_unknown(const StencilTable::Row& row, const Visit& visit) const {
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      const std::size_t place = unknown_[static_cast<std::size_t>(row.indices[k])];
      if (place != kNone) {
        visit(place, row.weights[k]);
      }
    }
  }

  void factorise(const StencilTable& differences, std::span<const double> mobilities, Index n) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < differences.n_rows(); ++i) {
      const double scale = std::sqrt(stiffness_of(differences[i], mobilities));
      for_each_unknown(differences[i], [&](std::size_t place, double weight) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(place), scale * weight);
      });
    }
    Sparse D(static_cast<Index>(differences.n_rows()), n);
    D.setFromTriplets(entries.begin(), entries.end());
    if (n > 0) {
      cholesky_.compute(Sparse(D.transpose() * D));
      if (cholesky_.info() != Eigen::Success) {
        throw Error(
            "the lattice's net is too large, or its stiffness too uneven, to move it "
            "smoothly");
      }
    }
  }

  std::size_t n_controls_;
  std::vector<std::size_t> unknown_;  // #controls: its place among the unknowns, or kNone
  std::vector<std::size_t> free_;     // #controls: the free part that it is in, or kNone
  std::size_t n_free_ = 0;
  Eigen::SimplicialLLT<Sparse> cholesky_;
};

/// Neighbours in the blocks of a hierarchical lattice's patches, each pair once.
StencilTable block_differences(const ThbLattice& lattice, const Volume& volume) {
  struct Pair {
    std::int32_t a;
    std::int32_t b;
    int level;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  const std::vector<ThbCell> leaves = lattice.hierarchy->leaves();
  const auto& degree = lattice.hierarchy->degree();
  for (std::size_t patch = 0; patch < leaves.size(); ++patch) {
    const auto block = volume.block(patch);
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(degree[axis]) + 1;
      for (std::size_t i = 0; i < block.size(); ++i) {
        if (i / stride % n + 1 < n) {
          pairs.push_back({block[i], block[i + stride], leaves[patch].level});
        }
      }
      stride *= n;
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const StencilTable& points = volume.stencils();
  return StencilTable::build(pairs.size(), points.n_controls(), [&](std::size_t i, auto& row) {
    const double scale = std::sqrt(std::ldexp(1.0, -pairs[i].level));
    add_row(points[static_cast<std::size_t>(pairs[i].a)], scale, row);
    add_row(points[static_cast<std::size_t>(pairs[i].b)], -scale, row);
  });
}

}  // namespace

StencilTable neighbour_differences(const Lattice& lattice, const Volume& volume) {
  if (const auto* thb = lattice.as<ThbLattice>()) {
    return block_differences(*thb, volume);
  }
  const auto net = lattice.net();
  return StencilTable::build(net.size(), volume.n_controls(), [&](std::size_t i, StencilRow& row) {
    row.add(net[i][0], 1);
    row.add(net[i][1], -1);
  });
}

std::shared_ptr<const MotionEnergy> smooth_motion(const StencilTable& rows,
                                                  const StencilTable& differences,
                                                  std::span<const double> mobilities) {
  std::vector<double> all(mobilities.begin(), mobilities.end());
  if (all.empty()) {
    all.assign(rows.n_controls(), 1.0);
  }
  require_mobilities(all, rows.n_controls());
  return std::make_shared<const SmoothMotion>(rows, differences, std::move(all));
}

}  // namespace espalier
