#include "deform/direct/pull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "deform/evaluate/displace.h"
#include "deform/evaluate/weights.h"
#include "deform/injectivity/injectivity.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/tensor/tensor_lattice.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

Volume grid_volume(int n) {
  return test::spline_volume({n, n, n}, test::grid_points({n, n, n}));
}

StencilTable picks(const Volume& volume, const std::vector<glm::dvec3>& points) {
  return control_weights(volume, embed(volume, points));
}

std::vector<glm::dvec3> random_vectors(std::size_t n, double low, double high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(low, high);
  std::vector<glm::dvec3> vectors(n);
  for (glm::dvec3& v : vectors) {
    v = {number(random), number(random), number(random)};
  }
  return vectors;
}

TEST(Pull, takes_points_where_they_are_wanted_on_every_lattice) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_uniform(family.lattice, 1);
    const std::vector<glm::dvec3> points = {
        volume.bezier(0, volume.rest_points()).value({.3, .4, .5})};
    const Binding binding = embed(volume, points);
    const glm::dvec3 wanted(0.1, -0.2, 0.3);
    const PullMotion pulled = Pull(control_weights(volume, binding)).motion(std::span(&wanted, 1));
    auto pose = family.lattice.rest;
    for (std::size_t i = 0; i < pose.size(); ++i) {
      pose[i] += pulled.motion[i];
    }
    const auto moved = displaced_points(volume, binding, points, volume.displacements(pose));
    EXPECT_LT(glm::distance(moved[0], points[0] + wanted), 1e-12) << family.name;
  }
}

TEST(Pull, of_many_points_meets_all_targets_to_round_off) {
  const Volume volume = grid_volume(8);
  auto points = random_vectors(60, 0.5, 7.5, 1);
  points.push_back(points[0] + glm::dvec3(1e-5, 0, 0));  // nearly the same
  const auto wanted = random_vectors(60, -0.3, 0.3, 2);
  auto all = wanted;
  all.push_back(wanted[0] + glm::dvec3(0, 1e-6, 0));
  const Pull pull(picks(volume, points));
  EXPECT_EQ(pull.rank(), 61u);
  for (const glm::dvec3& residual : pull.motion(all).residuals) {
    EXPECT_LT(glm::length(residual), 1e-12);
  }
}

TEST(Pull, is_the_smallest_motion_that_does_it) {
  const Volume volume = grid_volume(4);
  const StencilTable rows = picks(volume, {{1.3, 2.2, 1.9}});
  const glm::dvec3 wanted(1, 2, 3);
  const PullMotion pulled = Pull(rows).motion(std::span(&wanted, 1));
  double squares = 0;
  for (const double weight : rows[0].weights) {
    squares += weight * weight;
  }
  for (std::size_t k = 0; k < rows[0].indices.size(); ++k) {  // [HHK92]: B⁺ = Bᵀ / |B|²
    const auto control = static_cast<std::size_t>(rows[0].indices[k]);
    EXPECT_LT(glm::distance(pulled.motion[control], rows[0].weights[k] / squares * wanted), 1e-14);
  }
}

TEST(Pull, leaves_pinned_control_points_and_moves_stiff_ones_less) {
  const Volume volume = grid_volume(4);
  const StencilTable rows = picks(volume, {{2, 2, 2}});
  std::vector<double> mobilities(volume.n_controls(), 1.0);
  const std::size_t middle = 2 + 5 * (2 + 5 * 2);
  mobilities[middle - 1] = 0;
  mobilities[middle + 1] = 0.25;
  const glm::dvec3 wanted(0.5, 0, 0);
  const PullMotion pulled = Pull(rows, mobilities).motion(std::span(&wanted, 1));
  EXPECT_EQ(pulled.motion[middle - 1], glm::dvec3(0));
  EXPECT_NEAR(pulled.motion[middle + 1].x, 0.25 * pulled.motion[middle + 5].x, 1e-15);
  EXPECT_LT(glm::length(pulled.residuals[0]), 1e-15);
}

TEST(Pull, shares_out_what_cannot_be_met) {
  const Volume volume = grid_volume(3);
  // One place pulled two ways, and more points than control points.
  auto points = random_vectors(100, 0.1, 2.9, 3);
  points[1] = points[0];
  auto wanted = random_vectors(100, -0.1, 0.1, 4);
  const StencilTable rows = picks(volume, points);
  const Pull pull(rows);
  EXPECT_LE(pull.rank(), 64u);
  const PullMotion pulled = pull.motion(wanted);
  EXPECT_NEAR(glm::length(pulled.residuals[0] - pulled.residuals[1] - (wanted[0] - wanted[1])), 0,
              1e-12);
  // At the least sum of squares, what is left has no slope: R applied to it gives zero.
  std::vector<glm::dvec3> slopes(volume.n_controls(), glm::dvec3(0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < rows[i].indices.size(); ++k) {
      slopes[static_cast<std::size_t>(rows[i].indices[k])] +=
          rows[i].weights[k] * pulled.residuals[i];
    }
  }
  for (const glm::dvec3& slope : slopes) {
    EXPECT_LT(glm::length(slope), 1e-9);
  }
}

TEST(Pull, of_a_knot_may_go_as_far_as_is_known_in_closed_form) {
  const auto volume = std::make_shared<const Volume>(grid_volume(8));
  const InjectivityCheck check(volume);
  const auto rest = volume->rest_controls();
  const auto step = [&](const glm::dvec3& point, const glm::dvec3& direction) {
    const glm::dvec3 unit = glm::normalize(direction);
    const PullMotion pulled = Pull(picks(*volume, {point})).motion(std::span(&unit, 1));
    return check.largest_step(rest, pulled.motion).step;
  };
  EXPECT_LE(step({4, 4, 4}, {1, 0, 0}), 4.0 / 3 * (1 + 1e-12));
  EXPECT_GE(step({4, 4, 4}, {1, 0, 0}), 4.0 / 3 * (1 - 1e-4));
  EXPECT_NEAR(step({4, 4, 4}, {1, 1, 0}), 1.3136, 2e-4);
  EXPECT_NEAR(step({4, 4, 4}, {1, 1, 1}), 1.3011, 2e-4);
  EXPECT_NEAR(step({4.5, 4.5, 4.5}, {1, 0, 0}), 1.3281, 2e-4);
}

/// The lattice with the border points that tripled ends stand for: three at each, at one place.
TensorLattice with_border_points(const TensorLattice& tripled, std::vector<std::size_t>& leaders) {
  const std::array<int, 3> counts = tripled.counts();
  const auto leader = [&](int i, std::size_t axis) {
    return std::clamp(i - 2, 0, counts[axis] - 1);
  };
  TensorLattice all = tripled;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.axes[axis] = TensorAxis::make(counts[axis] + 4, 3, Ends::Uniform);
  }
  all.rest.clear();
  for (int k = 0; k < counts[2] + 4; ++k) {
    for (int j = 0; j < counts[1] + 4; ++j) {
      for (int i = 0; i < counts[0] + 4; ++i) {
        leaders.push_back(static_cast<std::size_t>(
            leader(i, 0) + counts[0] * (leader(j, 1) + counts[1] * leader(k, 2))));
        all.rest.push_back(tripled.rest[leaders.back()]);
      }
    }
  }
  return all;
}

TEST(Pull, moves_coupled_border_points_as_one) {
  // [HHK92] eq. (6) and (7): Δq = B S ΔP, ΔP = (B S)ᵀ (B S Sᵀ Bᵀ)⁻¹ Δq, with the rows B of the
  // lattice in which three border points are three.
  const TensorAxis axis = TensorAxis::make(5, 3, Ends::Tripled);
  const TensorLattice tripled =
      make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {}, BoxFilling::Volume);
  std::vector<std::size_t> leaders;
  const Volume all = freeze(with_border_points(tripled, leaders));
  for (const glm::dvec3& point : {glm::dvec3(0.02, 0.3, 0.01), glm::dvec3(0.9, 0.95, 0.5)}) {
    const StencilTable B = picks(all, {point});
    ASSERT_FALSE(B[0].indices.empty());
    std::vector<double> BS(tripled.rest.size(), 0.0);
    for (std::size_t k = 0; k < B[0].indices.size(); ++k) {
      BS[leaders[static_cast<std::size_t>(B[0].indices[k])]] += B[0].weights[k];
    }
    const double squares = std::inner_product(BS.begin(), BS.end(), BS.begin(), 0.0);
    const glm::dvec3 wanted(0.1, 0.2, -0.1);
    const PullMotion pulled = Pull(picks(freeze(tripled), {point})).motion(std::span(&wanted, 1));
    std::vector<glm::dvec3> border(leaders.size());
    for (std::size_t i = 0; i < leaders.size(); ++i) {
      border[i] = pulled.motion[leaders[i]];
      EXPECT_LT(glm::distance(border[i], BS[leaders[i]] / squares * wanted), 1e-13);
    }
    EXPECT_LT(glm::distance(B.apply(border)[0], wanted), 1e-13);
  }
}

TEST(Pull, keeps_the_digits_of_picks_that_nearly_coincide) {
  const Volume volume = grid_volume(6);
  for (const double apart : {1e-3, 1e-6, 1e-8}) {
    const Pull pull(picks(volume, {{2.3, 3.1, 2.7}, {2.3 + apart, 3.1, 2.7}}));
    EXPECT_EQ(pull.rank(), 2u);
    const std::vector<glm::dvec3> wanted = {{0.1, 0, 0}, {0.1 + 0.1 * apart, 0, 0.2 * apart}};
    for (const glm::dvec3& residual : pull.motion(wanted).residuals) {
      EXPECT_LT(glm::length(residual), 1e-14) << apart;
    }
  }
}

TEST(Pull, names_bad_input) {
  const Volume volume = grid_volume(3);
  EXPECT_THROW(Pull(picks(volume, {{1, 1, 1}, {9, 9, 9}})), ParameterError);
  std::vector<double> mobilities(volume.n_controls(), 1.0);
  mobilities[3] = -1;
  EXPECT_THROW(Pull(picks(volume, {{1, 1, 1}}), mobilities), ParameterError);
  mobilities.pop_back();
  EXPECT_THROW(Pull(picks(volume, {{1, 1, 1}}), mobilities), ParameterError);
  const Pull pull(picks(volume, {{1, 1, 1}}));
  EXPECT_THROW((void)pull.motion(std::vector<glm::dvec3>{{NAN, 0, 0}}), ParameterError);
  EXPECT_THROW((void)pull.motion(std::vector<glm::dvec3>(2)), ParameterError);
}

}  // namespace
}  // namespace espalier
