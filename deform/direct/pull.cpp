// Direct manipulation by least squares [HHK92].

#include "deform/direct/pull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "deform/direct/pivoted_qr.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr int kRefinements = 3;

/// What the factorisation takes for zero, relative to the first pivot.
double tolerance_of(std::size_t n) {
  return 8 * std::numeric_limits<double>::epsilon() * static_cast<double>(n);
}

/// Solves Rᵀ x = x in place; R: the first n columns of n rows of `stride` numbers.
void solve_transposed(const std::vector<double>& R, std::size_t n, std::size_t stride,
                      std::vector<glm::dvec3>& x) {
  for (std::size_t i = 0; i < n; ++i) {
    x[i] /= R[i * stride + i];
    for (std::size_t k = i + 1; k < n; ++k) {
      x[k] -= R[i * stride + k] * x[i];
    }
  }
}

/// Solves R x = x in place.
void solve_upper(const std::vector<double>& R, std::size_t n, std::size_t stride,
                 std::vector<glm::dvec3>& x) {
  for (std::size_t i = n; i-- > 0;) {
    glm::dvec3 sum = x[i];
    for (std::size_t k = i + 1; k < n; ++k) {
      sum -= R[i * stride + k] * x[k];
    }
    x[i] = sum / R[i * stride + i];
  }
}

void check_mobilities(std::span<const double> mobilities, std::size_t n_controls) {
  if (mobilities.size() != n_controls) {
    throw ParameterError("there are " + std::to_string(mobilities.size()) + " mobilities for " +
                         std::to_string(n_controls) + " control points: give one for each");
  }
  for (std::size_t i = 0; i < n_controls; ++i) {
    if (!(mobilities[i] >= 0 && std::isfinite(mobilities[i]))) {
      throw ParameterError("the mobility of control point " + std::to_string(i) + " is " +
                           std::to_string(mobilities[i]) + ", must be 0 or more");
    }
  }
}

}  // namespace

Pull::Pull(StencilTable rows, std::span<const double> mobilities)
    : rows_(std::move(rows)), mobilities_(mobilities.begin(), mobilities.end()) {
  if (mobilities_.empty()) {
    mobilities_.assign(rows_.n_controls(), 1.0);
  }
  check_mobilities(mobilities_, rows_.n_controls());
  // Only control points that some pick sees and that may move have a row of √W Rᵀ.
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> place(rows_.n_controls(), kNone);
  std::size_t n_reached = 0;
  const std::size_t n_picks = rows_.n_rows();
  for (std::size_t i = 0; i < n_picks; ++i) {
    if (rows_[i].indices.empty()) {
      throw ParameterError("pick " + std::to_string(i) +
                           " is outside the lattice: no control point moves it");
    }
    for (const std::int32_t control : rows_[i].indices) {
      const auto c = static_cast<std::size_t>(control);
      if (place[c] == kNone && mobilities_[c] > 0) {
        place[c] = n_reached++;
      }
    }
  }
  std::vector<double> columns(n_reached * n_picks, 0.0);
  for (std::size_t i = 0; i < n_picks; ++i) {
    const StencilTable::Row row = rows_[i];
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      const auto c = static_cast<std::size_t>(row.indices[k]);
      if (place[c] != kNone) {
        columns[i * n_reached + place[c]] = row.weights[k] * std::sqrt(mobilities_[c]);
      }
    }
  }
  PivotedQr qr = pivoted_qr(std::move(columns), n_reached, n_picks,
                            tolerance_of(std::max(n_reached, n_picks)));
  rank_ = qr.rank;
  order_ = std::move(qr.order);
  R_ = std::move(qr.R);
  if (rank_ < n_picks) {  // the rows of R are the columns of Rᵀ
    PivotedQr fit = pivoted_qr(R_, n_picks, rank_, 0);
    fit_ = std::move(fit.R);
    fit_order_ = std::move(fit.order);
  }
}

/// √W Rᵀ = Q R with the picks in order_, so that the smallest solution is Q z with Rᵀ z as near as
/// can be to what is wanted, and Q = √W Rᵀ R₁₁⁻¹ over the first picks.
std::vector<glm::dvec3> Pull::solve(std::span<const glm::dvec3> wanted) const {
  const std::size_t n_picks = rows_.n_rows();
  std::vector<glm::dvec3> z(rank_);
  if (rank_ == n_picks) {
    for (std::size_t i = 0; i < n_picks; ++i) {
      z[i] = wanted[order_[i]];
    }
    solve_transposed(R_, rank_, n_picks, z);
  } else {
    std::vector<glm::dvec3> ordered(rank_, glm::dvec3(0));
    for (std::size_t i = 0; i < rank_; ++i) {
      const double* row = &R_[fit_order_[i] * n_picks];
      for (std::size_t k = 0; k < n_picks; ++k) {
        ordered[i] += row[k] * wanted[order_[k]];
      }
    }
    solve_transposed(fit_, rank_, rank_, ordered);
    solve_upper(fit_, rank_, rank_, ordered);
    for (std::size_t i = 0; i < rank_; ++i) {
      z[fit_order_[i]] = ordered[i];
    }
  }
  solve_upper(R_, rank_, n_picks, z);
  std::vector<glm::dvec3> motion(rows_.n_controls(), glm::dvec3(0));
  for (std::size_t i = 0; i < rank_; ++i) {
    const StencilTable::Row row = rows_[order_[i]];
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      const auto c = static_cast<std::size_t>(row.indices[k]);
      motion[c] += mobilities_[c] * row.weights[k] * z[i];
    }
  }
  return motion;
}

PullMotion Pull::motion(std::span<const glm::dvec3> wanted) const {
  if (wanted.size() != rows_.n_rows()) {
    throw ParameterError("there are " + std::to_string(wanted.size()) + " targets for " +
                         std::to_string(rows_.n_rows()) + " picks: give one for each");
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const glm::dvec3& v = wanted[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw ParameterError("the target of pick " + std::to_string(i) + " is not finite");
    }
  }
  PullMotion result{std::vector<glm::dvec3>(rows_.n_controls(), glm::dvec3(0)),
                    {wanted.begin(), wanted.end()}};
  for (int round = 0; round < kRefinements; ++round) {
    const std::vector<glm::dvec3> more = solve(result.residuals);
    for (std::size_t i = 0; i < more.size(); ++i) {
      result.motion[i] += more[i];
    }
    const std::vector<glm::dvec3> done = rows_.apply(result.motion);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      result.residuals[i] = wanted[i] - done[i];
    }
  }
  return result;
}

}  // namespace espalier
