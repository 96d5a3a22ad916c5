#pragma once

/// The smallest solution of dense linear equations, in the sense of least squares.

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "lattice/core/progress.h"

namespace espalier {

/// A matrix, column-major.
struct DenseMatrix {
  std::size_t n_rows = 0;
  std::size_t n_columns = 0;
  std::vector<double> values = {};
};

/// Entries that a matrix may have to be solved for.
inline constexpr std::size_t kMostDenseEntries = std::size_t{1} << 27;

/// Throws ParameterError for an Aᵀ, of this size, that has more entries than that.
void require_solvable(const DenseMatrix& transposed);

/// What solves A y + F a = b.
struct MinimumNormSolution {
  std::vector<glm::dvec3> y;
  std::vector<glm::dvec3> a;
};

/// Solves A y + F a = b for the smallest |y|, whatever a is; where there is no solution, for the
/// least |b − A y − F a|. By orthogonal factorisations alone, with a rank-revealing one of A's
/// square core, so that equations that nearly coincide keep their digits, which a Gram matrix would
/// lose.
class MinimumNorm {
 public:
  /// transposed: Aᵀ, a column an equation; free: F, a row an equation, or no columns. Throws as
  /// require_solvable(). O(#y · #equations · min of both). Tells `progress` "factorise".
  explicit MinimumNorm(const DenseMatrix& transposed, const DenseMatrix& free = {},
                       const Progress& progress = {});

  /// The same equations solved for the least |b − A y − F a|² + damping² |A|² |y|²: a small y that
  /// nearly solves them instead of a large one that does. damping: above 0. O(square core).
  [[nodiscard]] MinimumNorm with_damping(double damping) const;

  /// b: #equations; x, y and z are three right sides. The same bits for any number of threads.
  /// O(#y · #equations).
  [[nodiscard]] MinimumNormSolution solve(std::span<const glm::dvec3> b) const;

  /// How many equations are independent of the others.
  [[nodiscard]] std::size_t rank() const;

  /// What is left of other equations G y + H a for changes of y that keep these as they are; the
  /// smallest change that solves them keeps these. transposed: Gᵀ; free: H, as above.
  [[nodiscard]] DenseMatrix independent_part(const DenseMatrix& transposed,
                                             const DenseMatrix& free) const;

  /// How a changes with such a change of y.
  [[nodiscard]] std::vector<glm::dvec3> free_change(std::span<const glm::dvec3> y) const;

 private:
  class Core;
  struct Free;
  struct Factors;
  explicit MinimumNorm(std::shared_ptr<const Factors> factors);

  std::shared_ptr<const Factors> factors_;
};

}  // namespace espalier
