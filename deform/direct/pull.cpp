// Direct manipulation by least squares [HHK92].

#include "deform/direct/pull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "deform/direct/table_rows.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

/// Solving once, then for what round-off left if that is more than a part of what is wanted.
constexpr int kRounds = 2;
constexpr double kRoundOff = 1e-13;
/// Of groups, while control points move too far: powers of two.
constexpr int kLeastDamping = -20;
constexpr int kMostDamping = 4;

StencilTable with_no_empty_row(StencilTable rows) {
  for (std::size_t i = 0; i < rows.n_rows(); ++i) {
    if (rows[i].indices.empty()) {
      throw ParameterError("pick " + std::to_string(i) +
                           " is outside the lattice: no control point moves it");
    }
  }
  return rows;
}

void require_targets(std::span<const glm::dvec3> wanted, std::size_t n_picks) {
  if (wanted.size() != n_picks) {
    throw ParameterError("there are " + std::to_string(wanted.size()) + " targets for " +
                         std::to_string(n_picks) + " picks: give one for each");
  }
  for (std::size_t i = 0; i < n_picks; ++i) {
    const glm::dvec3& v = wanted[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw ParameterError("the target of pick " + std::to_string(i) + " is not finite");
    }
  }
}

MinimumNorm solver_of(const StencilTable& rows, const MotionEnergy& energy,
                      const Progress& progress) {
  return MinimumNorm(energy.columns(rows), energy.free_columns(rows), progress);
}

}  // namespace

Pull::Pull(const StencilTable& rows, std::span<const double> mobilities)
    : Pull(rows, smallest_motion(rows, mobilities)) {}

Pull::Pull(StencilTable rows, std::shared_ptr<const MotionEnergy> energy, std::size_t n_of_groups,
           const Progress& progress)
    : rows_(with_no_empty_row(std::move(rows))),
      energy_(std::move(energy)),
      n_picks_(rows_.n_rows() - n_of_groups),
      picks_(solver_of(row_range(rows_, 0, n_picks_), *energy_, progress)) {
  if (n_of_groups > 0) {
    const StencilTable others = row_range(rows_, n_picks_, rows_.n_rows());
    groups_ = n_picks_ == 0 ? solver_of(others, *energy_, progress)
                            : MinimumNorm(picks_.independent_part(energy_->columns(others),
                                                                  energy_->free_columns(others)),
                                          {}, progress);
  }
}

/// Picks first, then what groups can do without them.
PullMotion Pull::solved(std::span<const glm::dvec3> wanted, const MinimumNorm* groups) const {
  PullMotion result{std::vector<glm::dvec3>(rows_.n_controls(), glm::dvec3(0)),
                    {wanted.begin(), wanted.end()}};
  const auto move = [&](std::span<const glm::dvec3> y, std::span<const glm::dvec3> a) {
    const std::vector<glm::dvec3> more = energy_->motion(y, a);
    for (std::size_t i = 0; i < more.size(); ++i) {
      result.motion[i] += more[i];
    }
    const std::vector<glm::dvec3> done = rows_.apply(result.motion);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      result.residuals[i] = wanted[i] - done[i];
    }
  };
  const double round_off = kRoundOff * longest(wanted);
  for (int round = 0; round < kRounds && longest(result.residuals) > round_off; ++round) {
    if (groups != nullptr && n_picks_ == 0) {
      const MinimumNormSolution found = groups->solve(result.residuals);
      move(found.y, found.a);
      continue;
    }
    const MinimumNormSolution found = picks_.solve(std::span(result.residuals).first(n_picks_));
    move(found.y, found.a);
    if (groups != nullptr) {
      const auto change = groups->solve(std::span(result.residuals).subspan(n_picks_)).y;
      move(change, picks_.free_change(change));
    }
  }
  return result;
}

PullMotion Pull::motion(std::span<const glm::dvec3> wanted) const {
  require_targets(wanted, rows_.n_rows());
  if (!groups_) {
    return solved(wanted, nullptr);
  }
  const double of_picks = n_picks_ > 0 ? longest(solved(wanted, nullptr).motion) : 0;
  const double most = kMostGain * longest(wanted) + of_picks;
  PullMotion result = solved(wanted, &*groups_);
  if (longest(result.motion) <= most) {
    return result;
  }
  const auto damped = [&](int power) {
    const MinimumNorm groups = groups_->with_damping(std::ldexp(1.0, power));
    return solved(wanted, &groups);
  };
  int least = kLeastDamping;
  int enough = kMostDamping;
  while (least < enough) {
    const int middle = least + (enough - least) / 2;
    if (longest(damped(middle).motion) <= most) {
      enough = middle;
    } else {
      least = middle + 1;
    }
  }
  return damped(enough);
}

/// Along the normal all points are asked for, across it only the picks: two problems, as
/// coordinates do not depend on each other.
PullMotion pull_with_plane(const StencilTable& rows, std::size_t n_of_groups,
                           std::span<const glm::dvec3> wanted, const PlaneRows& plane,
                           std::span<const double> distances,
                           const std::shared_ptr<const MotionEnergy>& energy,
                           const Progress& progress) {
  require_targets(wanted, rows.n_rows());
  const glm::dvec3& n = plane.normal;
  std::vector<glm::dvec3> across;
  std::vector<glm::dvec3> along;  // in x
  for (const glm::dvec3& v : wanted) {
    along.emplace_back(glm::dot(v, n), 0, 0);
    across.push_back(v - glm::dot(v, n) * n);
  }
  for (const double distance : distances) {
    along.emplace_back(distance, 0, 0);
  }
  const PullMotion of_normal =
      Pull(stacked_rows(rows, plane.rows), energy, n_of_groups + distances.size(), progress)
          .motion(along);
  PullMotion result{std::vector<glm::dvec3>(of_normal.motion.size(), glm::dvec3(0)), {}};
  if (rows.n_rows() > 0) {
    result = Pull(rows, energy, n_of_groups, progress).motion(across);
  }
  for (std::size_t i = 0; i < result.motion.size(); ++i) {
    result.motion[i] += of_normal.motion[i].x * n;
  }
  result.residuals.resize(of_normal.residuals.size(), glm::dvec3(0));
  for (std::size_t i = 0; i < result.residuals.size(); ++i) {
    result.residuals[i] += of_normal.residuals[i].x * n;
  }
  return result;
}

double longest(std::span<const glm::dvec3> vectors) {
  double most = 0;
  for (const glm::dvec3& v : vectors) {
    most = std::max(most, glm::length(v));
  }
  return most;
}

}  // namespace espalier
