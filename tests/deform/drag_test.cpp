#include "deform/evaluate/drag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "deform/embed/fringe.h"
#include "deform/evaluate/displace.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/allocations.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

using Points = std::vector<glm::dvec3>;

/// A model in one or two lattices, bent, and a selection of the last one's control points.
struct Example {
  Points rest, normals;
  std::vector<LatticeMotion> motions;
  std::vector<double> selection;
  Influence influence;

  [[nodiscard]] DragModel model() const {
    return {.rest_points = rest,
            .motions = motions,
            .dragged = motions.size() - 1,
            .normals = normals,
            .influence = &influence};
  }
  [[nodiscard]] const Volume& volume() const { return *motions.back().volume; }
  /// The motions after a drag.
  [[nodiscard]] std::vector<LatticeMotion> dragged(const glm::dvec3& displacement) const {
    Points vectors;
    for (const double weight : selection) {
      vectors.push_back(weight * displacement);
    }
    const Points moves = volume().stencils().apply(vectors);
    std::vector<LatticeMotion> after = motions;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      after.back().displacements[i] += moves[i];
    }
    return after;
  }
  [[nodiscard]] Points full_points(const glm::dvec3& displacement) const {
    return combined_points(rest, dragged(displacement), influence);
  }
  [[nodiscard]] std::vector<glm::dmat3> full_gradients(const glm::dvec3& displacement) const {
    return combined_gradients(rest.size(), dragged(displacement), influence);
  }
  [[nodiscard]] std::vector<double> full_determinants(const glm::dvec3& displacement) const {
    std::vector<double> determinants;
    for (const glm::dmat3& J : full_gradients(displacement)) {
      determinants.push_back(glm::determinant(J));
    }
    return determinants;
  }
};

Points random_points(std::size_t n, const glm::dvec3& low, const glm::dvec3& high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 1);
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = place(random);
    const double y = place(random);
    points.push_back(low + (high - low) * glm::dvec3(x, y, place(random)));
  }
  return points;
}

Points random_normals(std::size_t n) {
  Points normals = random_points(n, glm::dvec3(-1), glm::dvec3(1), 2);
  for (glm::dvec3& normal : normals) {
    normal = glm::normalize(normal);
  }
  return normals;
}

LatticeMotion bent(Volume volume, const Points& points, double noise, unsigned seed,
                   double reach = 0) {
  const auto rest = volume.rest_controls();
  const Points pose = test::jittered({rest.begin(), rest.end()}, noise, seed);
  auto binding = std::make_shared<Binding>(embed(volume, points));
  if (reach > 0) {
    binding->fringe = make_fringe(volume, points, binding->status, reach);
  }
  Points displacements = volume.displacements(pose);
  return {std::make_shared<const Volume>(std::move(volume)), binding, std::move(displacements)};
}

Volume grid(int n, double scale = 1) {
  Points controls = test::grid_points({n, n, n});
  for (glm::dvec3& point : controls) {
    point *= scale;
  }
  return test::spline_volume({n, n, n}, std::move(controls));
}

std::size_t control_at(int n, int i, int j, int k) {
  return static_cast<std::size_t>(i + (n + 1) * (j + (n + 1) * k));
}

/// A grid of 6³ cells, of which a control point and, in part, its neighbour are selected.
Example grid_example(std::size_t n_points, double scale = 1, double noise = 0.15) {
  Example example;
  example.rest = random_points(n_points, glm::dvec3(0), glm::dvec3(6 * scale), 1);
  example.normals = random_normals(n_points);
  example.motions.push_back(bent(grid(6, scale), example.rest, noise * scale, 3));
  example.selection.assign(example.volume().n_controls(), 0);
  example.selection[control_at(6, 2, 3, 3)] = 1;
  example.selection[control_at(6, 3, 3, 3)] = 0.3;
  return example;
}

/// Points that follow each other are near each other, as in most models.
Example ordered_example() {
  Example example = grid_example(3000);
  std::sort(example.rest.begin(), example.rest.end(),
            [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; });
  example.motions = {bent(grid(6), example.rest, 0.15, 3)};
  return example;
}

/// Two lattices, the dragged one with a fringe, and weights.
Example layered_example() {
  Example example;
  example.rest = random_points(700, glm::dvec3(-1), glm::dvec3(7), 4);
  example.normals = random_normals(example.rest.size());
  example.motions.push_back(bent(grid(3, 2), example.rest, 0.1, 5));
  example.motions.push_back(bent(grid(6), example.rest, 0.1, 6, 1.0));
  example.selection.assign(example.volume().n_controls(), 0);
  std::mt19937 random(7);
  for (std::size_t i = 0; i < example.selection.size(); i += 3) {
    example.selection[i] = std::uniform_real_distribution<double>(0, 1)(random);
  }
  example.influence.strength = 0.8;
  for (std::size_t i = 0; i < example.rest.size(); ++i) {
    example.influence.weights.push_back(static_cast<double>(i % 5) / 4);
  }
  return example;
}

template <class Real>
struct Results {
  explicit Results(std::size_t n) : points(n), normals(n), folded(n, 7) {}
  std::vector<glm::vec<3, Real>> points, normals;
  std::vector<std::uint8_t> folded;

  [[nodiscard]] DraggedPoints<Real> all() { return {points, normals, folded}; }
  bool operator==(const Results&) const = default;
};

class DragOf : public ::testing::TestWithParam<InstructionSet> {};

template <class Real>
void expect_equals_full_evaluation(const Example& example, InstructionSet set, double tolerance,
                                   double normal_tolerance) {
  const Drag<Real> drag(example.model(), example.selection, set);
  const double extent = example.volume().diagonal();
  for (const glm::dvec3& by : {glm::dvec3(0), glm::dvec3(0.05, -0.03, 0.04) * extent}) {
    Results<Real> results(example.rest.size());
    EXPECT_EQ(drag.update(by, {}, results.all()).fraction, 1);
    const Points points = example.full_points(by);
    const auto gradients = example.full_gradients(by);
    ASSERT_GT(drag.reached().size(), 50u);
    for (const std::uint32_t i : drag.reached()) {
      EXPECT_LT(glm::distance(glm::dvec3(results.points[i]), points[i]), tolerance * extent) << i;
      const glm::dvec3 normal = turned_normal(gradients[i], example.normals[i]);
      EXPECT_LT(glm::distance(glm::dvec3(results.normals[i]), normal), normal_tolerance) << i;
      EXPECT_EQ(results.folded[i], glm::determinant(gradients[i]) <= 0 ? 1 : 0) << i;
    }
  }
}

TEST_P(DragOf, any_displacement_equals_a_full_evaluation) {
  for (const Example& example : {grid_example(1003), layered_example()}) {
    expect_equals_full_evaluation<float>(example, GetParam(), 1e-6, 1e-4);
    expect_equals_full_evaluation<double>(example, GetParam(), 1e-14, 1e-11);
  }
}

TEST_P(DragOf, tiny_and_huge_lattices_equals_a_full_evaluation) {
  for (const double scale : {1e-8, 1e8}) {
    expect_equals_full_evaluation<float>(grid_example(500, scale), GetParam(), 1e-6, 1e-4);
    expect_equals_full_evaluation<double>(grid_example(500, scale), GetParam(), 1e-14, 1e-11);
  }
}

/// A point in each of about a hundred patches of a volume, bent by some noise.
Example patch_example(Volume volume, double noise) {
  Example example;
  Binding binding;
  for (std::size_t patch = 0; patch < volume.n_patches(); patch += 1 + volume.n_patches() / 100) {
    binding.points.push_back(static_cast<std::int32_t>(binding.points.size()));
    binding.status.push_back(PointStatus::Inside);
    binding.patches.push_back(static_cast<std::int32_t>(patch));
    binding.uvw.emplace_back(0.3, 0.6, 0.45);
    example.rest.push_back(volume.bezier(patch, volume.rest_points()).value(binding.uvw.back()));
  }
  example.normals = random_normals(example.rest.size());
  const auto rest = volume.rest_controls();
  Points displacements = volume.displacements(test::jittered({rest.begin(), rest.end()}, noise, 3));
  example.selection.assign(volume.n_controls(), 0);
  example.motions = {{std::make_shared<const Volume>(std::move(volume)),
                      std::make_shared<const Binding>(std::move(binding)),
                      std::move(displacements)}};
  return example;
}

TEST_P(DragOf, lattices_of_any_topology_equals_a_full_evaluation) {
  for (SubdivisionLattice lattice :
       {test::pyramid_on_cube(), test::prism(test::flower_section(3), 1)}) {
    Example example = patch_example(freeze_adaptive(lattice), 0.01);
    example.selection[0] = 1;
    const glm::dvec3 by(0.1, 0.05, -0.07);
    const Drag<double> drag(example.model(), example.selection, GetParam());
    Results<double> results(example.rest.size());
    drag.update(by, {}, results.all());
    ASSERT_FALSE(drag.reached().empty());
    const Points points = example.full_points(by);
    for (const std::uint32_t i : drag.reached()) {
      EXPECT_LT(glm::distance(results.points[i], points[i]), 1e-14 * example.volume().diagonal());
    }
  }
}

TEST_P(DragOf, points_that_the_selection_does_not_reach_keep_what_they_hold) {
  const Example example = grid_example(1003);
  const Drag<float> drag(example.model(), example.selection, GetParam());
  const glm::vec3 mark(7, 8, 9);
  Results<float> results(example.rest.size());
  std::fill(results.points.begin(), results.points.end(), mark);
  std::fill(results.normals.begin(), results.normals.end(), mark);
  drag.update({0.3, 0.2, 0.1}, 0.0, results.all());
  const Points before = example.full_points(glm::dvec3(0));
  const Points after = example.full_points({0.3, 0.2, 0.1});
  const std::vector<std::uint32_t> reached = drag.reached();
  ASSERT_LT(reached.size(), 900u);
  for (std::uint32_t i = 0; i < example.rest.size(); ++i) {
    const bool is_reached = std::binary_search(reached.begin(), reached.end(), i);
    EXPECT_EQ(is_reached, before[i] != after[i]) << i;
    EXPECT_EQ(results.points[i] == mark, !is_reached) << i;
    EXPECT_EQ(results.normals[i] == mark, !is_reached) << i;
    EXPECT_EQ(results.folded[i] == 7, !is_reached) << i;
  }
}

TEST_P(DragOf, ten_thousand_updates_leave_the_bits_of_one) {
  const Example example = grid_example(200);
  const Drag<float> drag(example.model(), example.selection, GetParam());
  const glm::dvec3 last(0.11, -0.07, 0.05);
  Results<float> once(example.rest.size());
  drag.update(last, 0.0, once.all());
  Results<float> often(example.rest.size());
  for (int i = 1; i < 10000; ++i) {
    drag.update(std::sin(0.1 * i) * glm::dvec3(9, 1e-3 * i, 1), 0.0, often.all());
  }
  EXPECT_NE(often, once);
  drag.update(last, 0.0, often.all());
  EXPECT_EQ(often, once);
}

TEST_P(DragOf, far_displacement_stops_exactly_where_a_determinant_reaches_the_margin) {
  for (const Example& example : {grid_example(3000), ordered_example(), layered_example()}) {
    const Drag<float> drag(example.model(), example.selection, GetParam());
    const auto before = example.full_determinants(glm::dvec3(0));
    for (const double margin : {0.0, 0.25}) {
      for (const glm::dvec3& by :
           {glm::dvec3(40, 0, 0), glm::dvec3(-20, 30, 11), glm::dvec3(3, -2, -50)}) {
        Results<float> results(example.rest.size());
        const DragStep step = drag.update(by, margin, results.all());
        ASSERT_TRUE(step.is_stopped());
        EXPECT_EQ(step.displacement, step.fraction * by);
        const auto at = example.full_determinants(step.displacement);
        const auto beyond = example.full_determinants((1 + 1e-6) * step.displacement);
        std::size_t n_beyond = 0;
        for (const std::uint32_t i : drag.reached()) {
          EXPECT_GT(at[i], margin * before[i]) << i;
          EXPECT_EQ(results.folded[i], 0) << i;
          n_beyond += beyond[i] <= margin * before[i] ? 1 : 0;
        }
        EXPECT_GE(n_beyond, 1u);
        Results<float> there(example.rest.size());
        EXPECT_FALSE(drag.update(step.displacement, margin, there.all()).is_stopped());
        EXPECT_EQ(there, results);
      }
    }
  }
}

TEST_P(DragOf, stopped_drag_slides_on_when_the_hand_returns) {
  const Example example = grid_example(1000);
  const Drag<float> drag(example.model(), example.selection, GetParam());
  const glm::dvec3 back(0.1, 0.1, 0);
  Results<float> straight(example.rest.size());
  Results<float> returned(example.rest.size());
  EXPECT_EQ(drag.update(back, 0.0, straight.all()).fraction, 1);
  EXPECT_TRUE(drag.update({50, 50, 0}, 0.0, returned.all()).is_stopped());
  EXPECT_EQ(drag.update(back, 0.0, returned.all()).fraction, 1);
  EXPECT_EQ(returned, straight);
}

TEST_P(DragOf, drag_without_a_margin_goes_on_and_marks_what_folds) {
  const Example example = grid_example(2000);
  const Drag<float> drag(example.model(), example.selection, GetParam());
  const glm::dvec3 far(8, 2, 0);
  Results<float> results(example.rest.size());
  EXPECT_EQ(drag.update(far, {}, results.all()).displacement, far);
  const auto determinants = example.full_determinants(far);
  std::size_t n_folded = 0;
  for (const std::uint32_t i : drag.reached()) {
    EXPECT_EQ(results.folded[i], determinants[i] <= 0 ? 1 : 0) << i;
    n_folded += results.folded[i];
  }
  EXPECT_GT(n_folded, 10u);
}

TEST_P(DragOf, points_folded_at_the_start_hinder_no_drag_and_are_freed_by_it) {
  Example example = grid_example(2000);
  const glm::dvec3 far(8, 2, 0);
  const auto folded = example.full_determinants(far);
  const Points unfolded = example.full_points(glm::dvec3(0));
  example.motions = example.dragged(far);
  const Drag<double> drag(example.model(), example.selection, GetParam());
  const auto at_start = drag.folded_at_start();
  for (const std::uint32_t i : drag.reached()) {
    EXPECT_EQ(std::binary_search(at_start.begin(), at_start.end(), i), folded[i] < 1e-12) << i;
  }
  Results<double> results(example.rest.size());
  EXPECT_GT(drag.update(-far, 0.0, results.all()).fraction, 0.9999);
  for (const std::uint32_t i : at_start) {
    EXPECT_EQ(results.folded[i], 0) << i;
    EXPECT_LT(glm::distance(results.points[i], unfolded[i]), 1e-2);
  }
}

/// The largest step of points on the lines from the middle of a uniform grid of spacing 1 along the
/// axis and the diagonals, and of a coarse grid round them.
double largest_step(const std::vector<double>& selection, const glm::dvec3& along,
                    InstructionSet set) {
  const glm::dvec3 middle(4);
  Example example;
  for (const glm::dvec3& line : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 1)}) {
    for (int i = -1500; i <= 1500; ++i) {
      example.rest.push_back(middle + static_cast<double>(i) / 750 * line);
    }
  }
  for (const glm::dvec3& point : test::grid_points({12, 12, 12})) {
    example.rest.push_back(middle + point / 3.0 - 2.0);
  }
  example.motions.push_back(bent(grid(8), example.rest, 0, 1));
  const Drag<double> drag(example.model(), selection, set);
  const double far = 100;
  return far * drag.safe_fraction(far * glm::normalize(along), 0);
}

TEST_P(DragOf, control_point_of_a_uniform_grid_stops_at_the_known_distances) {
  std::vector<double> selection(729, 0);
  selection[control_at(8, 4, 4, 4)] = 1;
  EXPECT_NEAR(largest_step(selection, {1, 0, 0}, GetParam()), 27.0 / 8, 1e-6);
  EXPECT_NEAR(largest_step(selection, {0, -1, 0}, GetParam()), 27.0 / 8, 1e-6);
  EXPECT_NEAR(largest_step(selection, {1, 1, 0}, GetParam()), 3.4886, 1e-4);
  EXPECT_NEAR(largest_step(selection, {1, 1, 1}, GetParam()), 3.4958, 1e-4);
}

TEST_P(DragOf, knot_point_pulled_by_least_squares_stops_at_the_known_distances) {
  std::vector<double> selection(729, 0);
  const double shares[3] = {0.25, 1, 0.25};  // in proportion to the weights 1/6, 2/3, 1/6
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        selection[control_at(8, 4 + i, 4 + j, 4 + k)] =
            shares[i + 1] * shares[j + 1] * shares[k + 1];
      }
    }
  }
  const double of_knot = 0.75 * 0.75 * 0.75;  // how far it goes
  EXPECT_NEAR(of_knot * largest_step(selection, {1, 0, 0}, GetParam()), 4.0 / 3, 1e-6);
  EXPECT_NEAR(of_knot * largest_step(selection, {1, 1, 0}, GetParam()), 1.3136, 1e-4);
  EXPECT_NEAR(of_knot * largest_step(selection, {1, 1, 1}, GetParam()), 1.3011, 1e-4);
}

TEST_P(DragOf, any_number_of_threads_gives_the_same_bits) {
  Example example = grid_example(1000);
  constexpr std::size_t kTimes = 150;  // enough for several threads
  const Points some = example.rest;
  const Points normals = example.normals;
  const Binding places = *example.motions.back().binding;
  Binding many;
  example.rest.clear();
  example.normals.clear();
  for (std::size_t i = 0; i < places.points.size(); ++i) {
    for (std::size_t k = 0; k < kTimes; ++k) {
      const auto from = static_cast<std::size_t>(places.points[i]);
      many.points.push_back(static_cast<std::int32_t>(example.rest.size()));
      many.patches.push_back(places.patches[i]);
      many.uvw.push_back(places.uvw[i]);
      many.status.push_back(places.status[from]);
      example.rest.push_back(some[from]);
      example.normals.push_back(normals[from]);
    }
  }
  example.motions.back().binding = std::make_shared<const Binding>(std::move(many));
  const Drag<float> drag(example.model(), example.selection, GetParam());
  Results<float> one(example.rest.size());
  set_thread_count(1);
  const DragStep step = drag.update({9, 3, 1}, 0.1, one.all());
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    Results<float> several(example.rest.size());
    EXPECT_EQ(drag.update({9, 3, 1}, 0.1, several.all()).fraction, step.fraction);
    EXPECT_EQ(several, one);
  }
  set_thread_count(0);
  EXPECT_TRUE(step.is_stopped());
}

TEST_P(DragOf, updates_allocate_nothing) {
  const Example example = grid_example(1000);
  const Drag<float> drag(example.model(), example.selection, GetParam());
  Results<float> results(example.rest.size());
  drag.update({9, 0, 0}, 0.0, results.all());
  const std::size_t before = test::n_allocations();
  drag.update({9, 0, 0}, 0.0, results.all());
  drag.update({0.1, 0, 0}, {}, results.all());
  EXPECT_EQ(test::n_allocations(), before);
}

TEST_P(DragOf, singular_rest_makes_no_nonsense) {
  Points flat = test::grid_points({2, 2, 2});
  for (glm::dvec3& point : flat) {
    point.z = 0;
  }
  Example example = patch_example(test::spline_volume({2, 2, 2}, flat), 0);
  example.selection[13] = 1;
  const Drag<float> drag(example.model(), example.selection, GetParam());
  ASSERT_EQ(drag.reached().size(), 8u);
  Results<float> results(example.rest.size());
  const DragStep step = drag.update({1, 2, 3}, 0.0, results.all());
  EXPECT_GT(step.fraction, 0);
  const Points points = example.full_points(step.displacement);
  for (const std::uint32_t i : drag.reached()) {
    EXPECT_LT(glm::distance(glm::dvec3(results.points[i]), points[i]), 1e-6) << i;
    EXPECT_NEAR(glm::length(results.normals[i]), 1, 1e-6) << i;
    EXPECT_EQ(results.folded[i], 0) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, DragOf, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

TEST(Drag, empty_selection_or_model_reaches_nothing) {
  Example example = grid_example(50);
  std::fill(example.selection.begin(), example.selection.end(), 0);
  const Drag<float> drag(example.model(), example.selection);
  EXPECT_TRUE(drag.reached().empty());
  Results<float> results(50);
  EXPECT_EQ(drag.update({100, 0, 0}, 0.0, results.all()).fraction, 1);
  EXPECT_EQ(results, Results<float>(50));
  const Example nothing = grid_example(0);
  EXPECT_EQ(Drag<double>(nothing.model(), nothing.selection).safe_fraction({9, 9, 9}, 0), 1);
}

TEST(Drag, refuses_what_does_not_fit) {
  const Example example = grid_example(20);
  const Drag<float> drag(example.model(), example.selection);
  Results<float> results(20);
  Results<float> few(19);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(drag.update({nan, 0, 0}, 0.0, results.all()), ParameterError);
  EXPECT_THROW(drag.update({1e30, 0, 0}, 0.0, results.all()), ParameterError);
  EXPECT_THROW(drag.update({1, 0, 0}, 1.0, results.all()), ParameterError);
  EXPECT_THROW(drag.update({1, 0, 0}, nan, results.all()), ParameterError);
  EXPECT_THROW(drag.update({1, 0, 0}, 0.0, few.all()), ParameterError);
  DragModel plain = example.model();
  plain.normals = {};
  plain.has_fold_check = false;
  const Drag<float> positions(plain, example.selection);
  EXPECT_THROW(positions.update({1, 0, 0}, 0.0, {.points = results.points}), ParameterError);
  EXPECT_THROW(positions.update({1, 0, 0}, {}, {.normals = results.normals}), ParameterError);
  EXPECT_THROW(positions.update({1, 0, 0}, {}, {.folded = results.folded}), ParameterError);
  const auto begin = [&](const DragModel& model, const std::vector<double>& selection) {
    Drag<float>(model, selection);
  };
  std::vector<double> selection = example.selection;
  selection[5] = 1.5;
  EXPECT_THROW(begin(example.model(), selection), ParameterError);
  selection[5] = nan;
  EXPECT_THROW(begin(example.model(), selection), ParameterError);
  selection.pop_back();
  EXPECT_THROW(begin(example.model(), selection), ParameterError);
  DragModel other = example.model();
  other.dragged = 1;
  EXPECT_THROW(begin(other, example.selection), ParameterError);
  other = example.model();
  other.normals = other.normals.first(3);
  EXPECT_THROW(begin(other, example.selection), ParameterError);
}

}  // namespace
}  // namespace espalier
