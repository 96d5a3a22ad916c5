#include "deform/evaluate/evaluator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "deform/evaluate/displace.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "tests/support/allocations.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

/// Patches of all degrees 0 to 4 mixed and pyramids, and points in them, the cubes' ends included.
struct Example {
  Volume volume;
  std::vector<std::int32_t> patches;
  std::vector<glm::dvec3> uvw, points, normals, tangents, displacements;

  [[nodiscard]] BoundPoints bound() const {
    return {patches, uvw, points, normals, tangents, true};
  }
};

void add_patch(const BezierPatch& patch, VolumeTables& tables, std::vector<glm::dvec3>& controls) {
  std::vector<std::int32_t> block;
  for (const glm::dvec3& point : patch.points) {
    block.push_back(static_cast<std::int32_t>(controls.size()));
    controls.push_back(point);
  }
  Patch added;
  added.is_pyramid = patch.is_pyramid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    added.extractions[axis] = static_cast<std::uint16_t>(patch.degree[axis]);
  }
  tables.patches.push_back(added);
  tables.blocks.push_back(block);
}

Volume volume_of(VolumeTables tables, std::vector<glm::dvec3> controls) {
  for (int degree = 0; degree <= 4; ++degree) {
    tables.extractions.push_back(bezier_extraction(degree));
  }
  tables.stencils = StencilTable::build(
      controls.size(), controls.size(),
      [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1.0); });
  return {std::move(tables), std::move(controls)};
}

Volume mixed_volume() {
  VolumeTables tables;
  std::vector<glm::dvec3> controls;
  for (int p = 0; p <= 4; ++p) {
    for (int q = 0; q <= 4; ++q) {
      for (int r = 0; r <= 4; ++r) {
        add_patch(test::warped_cube({p, q, r}, 0.05, 7), tables, controls);
      }
    }
  }
  for (const std::array<int, 3>& degree : {std::array{1, 1, 1}, {3, 3, 3}, {2, 1, 4}}) {
    add_patch(test::warped_cube(degree, 0.02, 8, true), tables, controls);
  }
  return volume_of(std::move(tables), std::move(controls));
}

/// n points in every patch, some of them at ends.
Example example_of(Volume volume, int n) {
  Example example{std::move(volume), {}, {}, {}, {}, {}, {}};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  const auto some = [&] { return glm::dvec3(place(random), place(random), place(random)); };
  for (std::size_t patch = 0; patch < example.volume.n_patches(); ++patch) {
    const BezierPatch map = example.volume.bezier(patch, example.volume.rest_points());
    for (int i = 0; i < n; ++i) {
      glm::dvec3 uvw = some();
      for (int axis = 0; axis < 3 && i % 3 == 0; ++axis) {
        uvw[axis] = (i >> axis & 2) != 0 ? std::round(uvw[axis]) : uvw[axis];
      }
      if (example.volume.patch(patch).is_pyramid && uvw.z == 1) {
        uvw.z = 0.5;
      }
      example.patches.push_back(static_cast<std::int32_t>(patch));
      example.uvw.push_back(uvw);
      example.points.push_back(map.value(uvw));
      example.normals.push_back(glm::normalize(some() - 0.5));
      example.tangents.push_back(some() - 0.5);
    }
  }
  for (std::size_t i = 0; i < example.volume.n_points(); ++i) {
    example.displacements.push_back(0.1 * (some() - 0.5));
  }
  return example;
}

template <class Real>
struct Results {
  explicit Results(std::size_t n)
      : points(n), normals(n), tangents(n), gradients(n), determinants(n) {}

  std::vector<glm::vec<3, Real>> points, normals, tangents;
  std::vector<glm::mat<3, 3, Real>> gradients;
  std::vector<Real> determinants;

  [[nodiscard]] MovedPoints<Real> all() {
    return {points, gradients, determinants, normals, tangents};
  }
  bool operator==(const Results&) const = default;
};

template <class Real>
Results<Real> evaluated(const Evaluator<Real>& evaluator, const VolumeMotion<Real>& motion) {
  Results<Real> results(evaluator.n_points());
  evaluator.evaluate(motion, results.all());
  return results;
}

template <class T>
double largest_difference(const T& a, const glm::dmat3& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      largest = std::max(largest, std::abs(static_cast<double>(a[i][k]) - b[i][k]));
    }
  }
  return largest;
}

/// Points: of the lattice's diagonal.
template <class Real>
struct Precision {
  double points, gradients;
};
constexpr Precision<float> kFloat{3e-7, 1e-5};
constexpr Precision<double> kDouble{5e-15, 2e-14};

template <class Real>
void expect_equals_bezier_patches(InstructionSet set, const Precision<Real>& precision) {
  const Example example = example_of(mixed_volume(), 21);
  const Evaluator<Real> evaluator(example.volume, example.bound(), set);
  const auto results = evaluated(evaluator, VolumeMotion<Real>(example.displacements));
  for (std::size_t i = 0; i < example.patches.size(); ++i) {
    const auto patch = static_cast<std::size_t>(example.patches[i]);
    const BezierPatch moves = example.volume.bezier(patch, example.displacements);
    const BezierPatch rest = example.volume.bezier(patch, example.volume.rest_points());
    const glm::dvec3 uvw = example.uvw[i];
    EXPECT_LT(glm::distance(glm::dvec3(results.points[i]), example.points[i] + moves.value(uvw)),
              precision.points * example.volume.diagonal())
        << i << " in patch " << patch;
    const glm::dmat3 R = rest.derivative(uvw);
    if (!(std::abs(glm::determinant(R)) > 1e-3)) {
      continue;  // of degree 0 along an axis
    }
    const glm::dmat3 J = glm::dmat3(1) + moves.derivative(uvw) * glm::inverse(R);
    EXPECT_LT(largest_difference(results.gradients[i], J), precision.gradients) << i;
    EXPECT_NEAR(results.determinants[i], glm::determinant(J), precision.gradients) << i;
    const glm::dvec3 normal =
        glm::normalize(glm::determinant(J) * glm::transpose(glm::inverse(J)) * example.normals[i]);
    EXPECT_LT(glm::distance(glm::dvec3(results.normals[i]), normal), precision.gradients) << i;
    EXPECT_LT(glm::distance(glm::dvec3(results.tangents[i]), J * example.tangents[i]),
              precision.gradients)
        << i;
  }
}

class EvaluatorOnEverySet : public ::testing::TestWithParam<InstructionSet> {};

TEST_P(EvaluatorOnEverySet, equals_bezier_patches_of_all_degrees_in_double) {
  expect_equals_bezier_patches<double>(GetParam(), kDouble);
}

TEST_P(EvaluatorOnEverySet, equals_bezier_patches_of_all_degrees_in_float) {
  expect_equals_bezier_patches<float>(GetParam(), kFloat);
}

TEST_P(EvaluatorOnEverySet, equals_the_bezier_patches_of_b_splines) {
  const Example example =
      example_of(test::spline_volume({1, 2, 4}, test::grid_points({1, 2, 4})), 9);
  const Evaluator<double> evaluator(example.volume, example.bound(), GetParam());
  const auto results = evaluated(evaluator, VolumeMotion<double>(example.displacements));
  for (std::size_t i = 0; i < example.patches.size(); ++i) {
    const auto moves =
        example.volume.bezier(static_cast<std::size_t>(example.patches[i]), example.displacements);
    EXPECT_LT(glm::distance(results.points[i], example.points[i] + moves.value(example.uvw[i])),
              2e-15);
  }
}

template <class Real>
void expect_same_bits_whatever_threads_scope_and_wishes(InstructionSet set) {
  const Example example = example_of(test::spline_volume({3, 3, 3}, test::grid_points({3, 3, 3})),
                                     1000);  // several chunks
  const Evaluator<Real> evaluator(example.volume, example.bound(), set);
  VolumeMotion<Real> motion(example.volume.n_points());
  Results<Real> frames = evaluated(evaluator, motion);
  std::vector<glm::dvec3> displacements(example.volume.n_points(), glm::dvec3(0));
  for (const std::size_t moved : {std::size_t{0}, std::size_t{21}, std::size_t{63}}) {
    displacements[moved] = example.displacements[moved];
    motion.set(displacements);
    set_thread_count(1);
    const Results<Real> whole = evaluated(evaluator, motion);
    evaluator.evaluate(motion, frames.all(), Scope::Changed);
    EXPECT_EQ(frames, whole);
    for (const int threads : {2, 3}) {
      set_thread_count(threads);
      EXPECT_EQ(evaluated(evaluator, motion), whole) << threads;
    }
    set_thread_count(0);
    Results<Real> points_only(evaluator.n_points());
    evaluator.evaluate(motion, {.points = points_only.points});
    EXPECT_EQ(points_only.points, whole.points);
  }
}

TEST_P(EvaluatorOnEverySet, gives_the_same_bits_for_any_number_of_threads_scope_and_outputs) {
  expect_same_bits_whatever_threads_scope_and_wishes<float>(GetParam());
  expect_same_bits_whatever_threads_scope_and_wishes<double>(GetParam());
}

TEST_P(EvaluatorOnEverySet, keeps_the_bits_of_unmoved_points_at_the_ends_of_patches_too) {
  const Volume grid = test::spline_volume({4, 1, 1}, test::grid_points({4, 1, 1}));
  const std::vector<std::int32_t> patches = {0, 0, 0, 1, 1, 1, 2, 2, 3};
  const std::vector<glm::dvec3> uvw = {{1, 0.3, 0.7}, {1, 1, 1},     {0.4, 0.2, 0.1},
                                       {1, 0.5, 1},   {0, 0.5, 0.5}, {1, 1, 0},
                                       {0, 1, 1},     {0.5, 1, 1},   {1, 1, 1}};
  std::vector<glm::dvec3> points(uvw.size(), glm::dvec3(-0.0, 1.0 / 3, 1e-17));
  std::vector<glm::dvec3> displacements(grid.n_points(), glm::dvec3(0));
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    displacements[i].y = grid.rest_controls()[i].x == 4 ? 0.7 : 0;  // reaches x > 2 only
  }
  const Evaluator<double> evaluator(grid, {patches, uvw, points}, GetParam());
  std::vector<glm::dvec3> moved(uvw.size());
  evaluator.evaluate(VolumeMotion<double>(displacements), {.points = moved});
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(moved[i], points[i]) << i;
    EXPECT_TRUE(std::signbit(moved[i].x)) << i;
  }
  EXPECT_GT(moved[7].y, points[7].y);
  EXPECT_NEAR(moved[8].y, points[8].y + 0.7, 1e-15);
}

TEST_P(EvaluatorOnEverySet, leaves_patches_alone_that_have_not_moved) {
  const Example example =
      example_of(test::spline_volume({8, 1, 1}, test::grid_points({8, 1, 1})), 5);
  std::vector<glm::dvec3> displacements(example.volume.n_points(), glm::dvec3(0));
  displacements.back() = {1, 1, 1};
  const Evaluator<double> evaluator(example.volume, example.bound(), GetParam());
  std::vector<glm::dvec3> moved(evaluator.n_points(), glm::dvec3(7));
  evaluator.evaluate(VolumeMotion<double>(displacements), {.points = moved}, Scope::Moved);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(moved[i] == glm::dvec3(7), example.patches[i] < 6) << i;
  }
}

TEST_P(EvaluatorOnEverySet, allocates_nothing_in_a_frame) {
  const Example example = example_of(mixed_volume(), 20);
  const Evaluator<float> evaluator(example.volume, example.bound(), GetParam());
  VolumeMotion<float> motion(example.displacements);
  Results<float> results = evaluated(evaluator, motion);
  set_thread_count(1);  // which threads work on what is chance
  evaluator.evaluate(motion, results.all());
  const std::size_t before = test::n_allocations();
  motion.set(example.displacements);
  evaluator.evaluate(motion, results.all());
  evaluator.evaluate(motion, results.all(), Scope::Changed);
  EXPECT_EQ(test::n_allocations(), before);
  set_thread_count(0);
}

TEST_P(EvaluatorOnEverySet, bears_tiny_and_huge_lattices) {
  for (const double scale : {1e-8, 1e-3, 1e8}) {
    std::vector<glm::dvec3> controls = test::grid_points({2, 2, 2});
    for (glm::dvec3& point : controls) {
      point *= scale;
    }
    const Example example = example_of(test::spline_volume({2, 2, 2}, controls), 20);
    std::vector<glm::dvec3> displacements;  // x → 2 y, y → −x, z → z
    for (const glm::dvec3& point : example.volume.rest_points()) {
      displacements.emplace_back(glm::dvec3(2 * point.y, -point.x, point.z) - point);
    }
    const Evaluator<float> evaluator(example.volume, example.bound(), GetParam());
    const auto results = evaluated(evaluator, VolumeMotion<float>(displacements));
    for (std::size_t i = 0; i < example.patches.size(); ++i) {
      const glm::dvec3 n = example.normals[i];
      EXPECT_NEAR(results.determinants[i], 2, 2e-5);
      EXPECT_LT(glm::distance(glm::dvec3(results.normals[i]),
                              glm::normalize(glm::dvec3(n.y, -2 * n.x, 2 * n.z))),
                1e-5);
    }
  }
}

TEST_P(EvaluatorOnEverySet, stays_finite_under_huge_and_denormal_displacements) {
  const Example example = example_of(mixed_volume(), 5);
  for (const double size : {1e-310, 1e-42, 1e12}) {
    std::vector<glm::dvec3> displacements = example.displacements;
    for (glm::dvec3& move : displacements) {
      move *= size;
    }
    const Evaluator<double> evaluator(example.volume, example.bound(), GetParam());
    const auto results = evaluated(evaluator, VolumeMotion<double>(displacements));
    for (std::size_t i = 0; i < example.patches.size(); ++i) {
      EXPECT_TRUE(std::isfinite(glm::dot(results.points[i], glm::dvec3(1)))) << i;
      EXPECT_TRUE(std::isfinite(glm::dot(results.normals[i], glm::dvec3(1)))) << i;
      EXPECT_TRUE(std::isfinite(results.determinants[i])) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, EvaluatorOnEverySet,
                         ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

TEST(Evaluator, baseline_fuses_nothing) {
  VolumeTables tables;
  std::vector<glm::dvec3> controls;
  add_patch(test::warped_cube({1, 1, 1}, 0, 1), tables, controls);
  const Volume volume = volume_of(std::move(tables), std::move(controls));
  std::vector<glm::dvec3> displacements;
  for (std::size_t i = 0; i < volume.n_points(); ++i) {
    displacements.emplace_back(i % 2 == 0 ? 1.0 / 3 : 1.0 / 7, 0, 0);
  }
  const std::vector<std::int32_t> patches(8, 0);
  std::vector<glm::dvec3> uvw;
  for (int i = 0; i < 8; ++i) {
    uvw.emplace_back(0.1 * i, 0, 0);
  }
  std::vector<glm::dvec3> moved(8);
  Evaluator<double>(volume, {patches, uvw, {}}, InstructionSet::Baseline)
      .evaluate(VolumeMotion<double>(displacements), {.points = moved});
  for (std::size_t i = 0; i < 8; ++i) {
    const double slope = 1.0 / 7 - 1.0 / 3;
    const double product = slope * uvw[i].x;
    EXPECT_EQ(moved[i].x, product + 1.0 / 3) << i;
  }
}

TEST(Evaluator, refuses_what_does_not_fit) {
  const Example example =
      example_of(test::spline_volume({1, 1, 1}, test::grid_points({1, 1, 1})), 3);
  const Volume& volume = example.volume;
  const auto make = [&](const BoundPoints& points) { Evaluator<float>(volume, points); };
  EXPECT_THROW(make({example.patches, std::vector<glm::dvec3>(2), {}}), ParameterError);
  EXPECT_THROW(make({example.patches, example.uvw, std::vector<glm::dvec3>(2)}), ParameterError);
  const std::vector<std::int32_t> strangers = {0, 0, 1};
  EXPECT_THROW(make({strangers, example.uvw, {}}), ParameterError);
  const Evaluator<float> evaluator(volume, {example.patches, example.uvw, example.points});
  const VolumeMotion<float> motion(example.displacements);
  std::vector<glm::vec3> two(2);
  std::vector<glm::vec3> three(3);
  EXPECT_THROW(evaluator.evaluate(motion, {.points = two}), ParameterError);
  EXPECT_THROW(evaluator.evaluate(motion, {.normals = three}), ParameterError);
  EXPECT_THROW(evaluator.evaluate(VolumeMotion<float>(7), {.points = three}), ParameterError);
  EXPECT_THROW(VolumeMotion<float>(7).set(example.displacements), ParameterError);
}

}  // namespace
}  // namespace espalier
