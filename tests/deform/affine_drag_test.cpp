#include "deform/evaluate/affine_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>

#include "deform/evaluate/displace.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "tests/support/allocations.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

using Points = std::vector<glm::dvec3>;

constexpr int kCells = 5;

glm::dmat3 turn(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// Points at random in a bent grid, some of whose control points are selected.
struct Example {
  Points rest, normals, pose;
  std::vector<double> weights;
  glm::dvec3 pivot{2.2, 2.4, 2.5};
  std::vector<LatticeMotion> motions;

  explicit Example(double noise = 0.1) {
    const Points controls = test::grid_points({kCells, kCells, kCells});
    rest = test::jittered(Points(600, glm::dvec3(2.5)), 2.4, 1);
    for (const glm::dvec3& point : test::jittered(Points(600, glm::dvec3(0)), 1, 2)) {
      normals.push_back(glm::normalize(point));
    }
    pose = test::jittered(controls, noise, 3);
    for (const glm::dvec3& control : controls) {
      const double distance = glm::distance(control, glm::dvec3(2, 3, 2));
      weights.push_back(distance < 1.1 ? 1 : distance < 1.8 ? 0.4 : 0);
    }
    const auto volume =
        std::make_shared<const Volume>(test::spline_volume({kCells, kCells, kCells}, controls));
    motions = {{volume, std::make_shared<const Binding>(embed(*volume, rest)),
                volume->displacements(pose)}};
  }

  [[nodiscard]] DragModel model() const {
    return {.rest_points = rest, .motions = motions, .normals = normals};
  }
  [[nodiscard]] AffineSelection selection() const { return {weights, pose, pivot}; }
  [[nodiscard]] Points displacements(const glm::dmat3& map) const {
    Points mapped = pose;
    for (std::size_t i = 0; i < mapped.size(); ++i) {
      mapped[i] += weights[i] * (map * (pose[i] - pivot) - (pose[i] - pivot));
    }
    return motions[0].volume->displacements(mapped);
  }
  [[nodiscard]] std::vector<glm::dmat3> gradients(const glm::dmat3& map) const {
    return deformation_gradients(*motions[0].volume, *motions[0].binding, displacements(map));
  }
};

template <class Real>
struct Results {
  std::vector<glm::vec<3, Real>> points = std::vector<glm::vec<3, Real>>(600);
  std::vector<glm::vec<3, Real>> normals = std::vector<glm::vec<3, Real>>(600);
  std::vector<std::uint8_t> folded = std::vector<std::uint8_t>(600, 7);

  [[nodiscard]] DraggedPoints<Real> all() { return {points, normals, folded}; }
  bool operator==(const Results&) const = default;
};

template <class Real>
void expect_equals_full_evaluation(double tolerance) {
  const Example example;
  const AffineDrag<Real> drag(example.model(), example.selection());
  for (const glm::dmat3& map : {turn(0.7), turn(2.5), 1.7 * turn(-0.2), glm::dmat3(1)}) {
    Results<Real> results;
    EXPECT_EQ(drag.update(map, {}, results.all()).fraction, 1);
    const Points points = displaced_points(*example.motions[0].volume, *example.motions[0].binding,
                                           example.rest, example.displacements(map));
    const auto gradients = example.gradients(map);
    ASSERT_GT(drag.reached().size(), 100u);
    for (const std::uint32_t i : drag.reached()) {
      EXPECT_LT(glm::distance(glm::dvec3(results.points[i]), points[i]), 9 * tolerance) << i;
      const glm::dvec3 normal = turned_normal(gradients[i], example.normals[i]);
      EXPECT_LT(glm::distance(glm::dvec3(results.normals[i]), normal), 1000 * tolerance) << i;
      EXPECT_EQ(results.folded[i], glm::determinant(gradients[i]) <= 0 ? 1 : 0) << i;
    }
  }
}

TEST(AffineDrag, any_map_equals_a_full_evaluation) {
  expect_equals_full_evaluation<float>(1e-6);
  expect_equals_full_evaluation<double>(1e-14);
}

TEST(AffineDrag, far_turn_or_scale_stops_exactly_where_a_determinant_reaches_the_margin) {
  const Example example;
  const AffineDrag<float> drag(example.model(), example.selection());
  const auto before = example.gradients(glm::dmat3(1));
  for (const double margin : {0.0, 0.3}) {
    for (const glm::dmat3& map : {turn(3), 9.0 * turn(1), glm::dmat3(-1)}) {
      Results<float> results;
      const AffineStep step = drag.update(map, margin, results.all());
      ASSERT_TRUE(step.is_stopped());
      const auto at = example.gradients(step.map);
      const glm::dmat3 further = glm::dmat3(1) + (1 + 1e-6) * (step.map - glm::dmat3(1));
      const auto beyond = example.gradients(further);
      std::size_t n_beyond = 0;
      for (const std::uint32_t i : drag.reached()) {
        const double mark = margin * glm::determinant(before[i]);
        EXPECT_GT(glm::determinant(at[i]), mark) << i;
        n_beyond += glm::determinant(beyond[i]) <= mark ? 1 : 0;
      }
      EXPECT_GE(n_beyond, 1u);
      EXPECT_FALSE(drag.update(step.map, margin, results.all()).is_stopped());
    }
  }
}

TEST(AffineDrag, whole_lattice_mirrored_or_half_turned_stops_half_way) {
  Example example(0);
  std::fill(example.weights.begin(), example.weights.end(), 1);
  const AffineDrag<double> drag(example.model(), example.selection());
  const glm::dmat3 mirror = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(drag.safe_fraction(mirror, 0), 0.5, 1e-7);
  EXPECT_NEAR(drag.safe_fraction(mirror, 0.5), 0.25, 1e-7);
  EXPECT_NEAR(drag.safe_fraction(turn(std::acos(-1.0)), 0), 0.5, 1e-5);
  EXPECT_EQ(drag.safe_fraction(turn(3), 0), 1);
  EXPECT_EQ(drag.safe_fraction(glm::dmat3(7), 0), 1);
}

TEST(AffineDrag, any_number_of_threads_and_updates_gives_the_same_bits_without_allocating) {
  const Example example;
  const AffineDrag<float> drag(example.model(), example.selection());
  set_thread_count(1);
  Results<float> once;
  const AffineStep step = drag.update(turn(3), 0.0, once.all());
  Results<float> again;
  const std::size_t before = test::n_allocations();
  drag.update(turn(1), 0.0, again.all());
  drag.update(turn(3), 0.0, again.all());
  EXPECT_EQ(test::n_allocations(), before);
  EXPECT_EQ(again, once);
  set_thread_count(3);
  EXPECT_EQ(drag.update(turn(3), 0.0, again.all()).fraction, step.fraction);
  EXPECT_EQ(again, once);
  set_thread_count(0);
}

TEST(AffineDrag, refuses_what_does_not_fit) {
  const Example example;
  const AffineDrag<float> drag(example.model(), example.selection());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Results<float> results;
  EXPECT_THROW(drag.update(glm::dmat3(nan), 0.0, results.all()), ParameterError);
  EXPECT_THROW(drag.update(glm::dmat3(nan), {}, results.all()), ParameterError);
  EXPECT_THROW(drag.update(turn(1), -0.1, results.all()), ParameterError);
  results.points.pop_back();
  EXPECT_THROW(drag.update(turn(1), 0.0, results.all()), ParameterError);
  AffineSelection selection = example.selection();
  selection.pivot.x = nan;
  EXPECT_THROW(AffineDrag<float>(example.model(), selection), ParameterError);
  selection = example.selection();
  selection.controls = selection.controls.first(2);
  EXPECT_THROW(AffineDrag<float>(example.model(), selection), ParameterError);
}

}  // namespace
}  // namespace espalier
