/// Models in lattices of every tensor type: nothing downstream of the volume asks for the type.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/embed/fringe.h"
#include "deform/evaluate/displace.h"
#include "deform/evaluate/weights.h"
#include "lattice/tensor/thb_lattice.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

struct Posed {
  std::string name;
  Volume volume;
  std::vector<glm::dvec3> pose;
};

TensorLattice box_lattice(TensorKind kind, const std::array<TensorAxis, 3>& axes) {
  return make_tensor_lattice(kind, axes, {}, BoxFilling::Volume);
}

/// Lattices that fill the unit cube, or bend it a little, and a pose of each.
std::vector<Posed> lattices() {
  const TensorAxis open = TensorAxis::make(6, 3, Ends::Open);
  const TensorAxis bezier = TensorAxis::make(4, 3, Ends::Open);
  std::vector<Posed> all;
  const auto add = [&](const std::string& name, TensorLattice lattice, double bend) {
    lattice.rest = test::jittered(lattice.rest, bend, 1);
    for (std::size_t i = 0; i < lattice.weights.size(); ++i) {
      lattice.weights[i] = 1 + 0.3 * std::sin(static_cast<double>(i));
    }
    all.push_back({name, freeze(lattice), test::jittered(lattice.rest, 0.05, 2)});
  };
  add("bezier", box_lattice(TensorKind::Bezier, {bezier, bezier, bezier}), 0);
  add("bent bezier", box_lattice(TensorKind::Bezier, {bezier, bezier, bezier}), 0.03);
  for (const Ends ends : {Ends::Uniform, Ends::Natural, Ends::Tripled}) {
    const TensorAxis axis = TensorAxis::make(6, 3, ends);
    add(std::string(name_of(ends)), box_lattice(TensorKind::BSpline, {open, axis, axis}), 0.01);
  }
  add("nurbs", box_lattice(TensorKind::Nurbs, {open, bezier, open}), 0.02);
  add("plane", box_lattice(TensorKind::BSpline, {open, bezier, TensorAxis()}), 0);
  add("line", box_lattice(TensorKind::Nurbs, {TensorAxis(), open, TensorAxis()}), 0);
  ThbLattice thb = make_thb_lattice({5, 5, 5}, {2, 2, 2}, {});
  thb = with_cells(thb, 1, cells_of_box(*thb.hierarchy, 1, glm::dvec3(0), glm::dvec3(2.0 / 3)));
  thb = with_cells(thb, 2, cells_of_box(*thb.hierarchy, 2, glm::dvec3(0), glm::dvec3(0.5)));
  all.push_back({"thb", freeze(thb), test::jittered(thb.rest, 0.03, 3)});
  return all;
}

/// Points well inside the unit cube.
std::vector<glm::dvec3> inner_points(int n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.2, 0.8);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < n; ++i) {
    points.emplace_back(unit(random), unit(random), unit(random));
  }
  return points;
}

TEST(TensorLattices, hold_every_point_inside_and_move_none_at_rest) {
  const auto points = inner_points(200);
  for (const Posed& lattice : lattices()) {
    const Binding binding = embed(lattice.volume, points);
    EXPECT_EQ(binding.counts().inside, points.size()) << lattice.name;
    for (std::size_t i = 0; i < binding.points.size(); ++i) {
      const BezierPatch patch = lattice.volume.bezier(static_cast<std::size_t>(binding.patches[i]),
                                                      lattice.volume.rest_points());
      EXPECT_LT(glm::distance(patch.value(binding.uvw[i]),
                              points[static_cast<std::size_t>(binding.points[i])]),
                1e-14)
          << lattice.name;
    }
    const auto still = lattice.volume.displacements(lattice.volume.rest_controls());
    EXPECT_EQ(displaced_points(lattice.volume, binding, points, still), points) << lattice.name;
  }
}

TEST(TensorLattices, weights_times_motions_are_the_displacements) {
  const auto points = inner_points(60);
  for (const Posed& lattice : lattices()) {
    const Binding binding = embed(lattice.volume, points);
    const auto moved = displaced_points(lattice.volume, binding, points,
                                        lattice.volume.displacements(lattice.pose));
    const StencilTable weights = control_weights(lattice.volume, binding);
    for (std::size_t i = 0; i < points.size(); ++i) {
      glm::dvec3 sum(0);
      double total = 0;
      for (std::size_t k = 0; k < weights[i].indices.size(); ++k) {
        const auto control = static_cast<std::size_t>(weights[i].indices[k]);
        sum += weights[i].weights[k] *
               (lattice.pose[control] - lattice.volume.rest_controls()[control]);
        total += weights[i].weights[k];
      }
      EXPECT_NEAR(total, 1, 1e-14) << lattice.name;
      EXPECT_LT(glm::distance(points[i] + sum, moved[i]), 1e-15) << lattice.name;
    }
  }
}

TEST(TensorLattices, gradients_are_difference_quotients) {
  constexpr double kStep = 1e-5;
  const auto points = inner_points(20);
  for (const Posed& lattice : lattices()) {
    const auto displacements = lattice.volume.displacements(lattice.pose);
    const auto displaced = [&](const std::vector<glm::dvec3>& at) {
      return displaced_points(lattice.volume, embed(lattice.volume, at), at, displacements);
    };
    const auto gradients =
        deformation_gradients(lattice.volume, embed(lattice.volume, points), displacements);
    for (int axis = 0; axis < 3; ++axis) {
      auto before = points;
      auto after = points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        before[i][axis] -= kStep;
        after[i][axis] += kStep;
      }
      const auto low = displaced(before);
      const auto high = displaced(after);
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LT(glm::distance(gradients[i][axis], (high[i] - low[i]) / (2 * kStep)), 2e-6)
            << lattice.name;
      }
    }
  }
}

TEST(TensorLattices, planes_and_lines_of_control_points_keep_the_other_coordinates) {
  const std::vector<glm::dvec3> points = {{0.3, 0.4, 0.1}, {0.3, 0.4, 0.5}, {0.3, 0.4, 0.9}};
  for (const Posed& lattice : lattices()) {
    if (lattice.name != "plane" && lattice.name != "line") {
      continue;
    }
    const Binding binding = embed(lattice.volume, points);
    const auto moved = displaced_points(lattice.volume, binding, points,
                                        lattice.volume.displacements(lattice.pose));
    const glm::dvec3 move = moved[0] - points[0];
    EXPECT_GT(glm::length(move), 1e-3);
    for (std::size_t i = 1; i < points.size(); ++i) {
      EXPECT_LT(glm::distance(moved[i] - points[i], move), 1e-15);
    }
  }
}

TEST(TensorLattices, points_outside_follow_the_boundary_of_a_rational_one) {
  const TensorAxis axis = TensorAxis::make(3, 2, Ends::Open);
  TensorLattice lattice = make_tensor_lattice(TensorKind::Nurbs, {axis, axis, axis}, {});
  lattice.weights[13] = 3;
  lattice.weights[12] = 0.5;
  const Volume volume = freeze(lattice);
  const std::vector<glm::dvec3> points = {{-0.1, 0.37, 0.61}, {0.2, 1.15, 0.4}};
  const Binding binding = embed(volume, points);
  ASSERT_EQ(binding.counts().outside, 2u);
  const Fringe fringe = make_fringe(volume, points, binding.status, 0.5);
  ASSERT_EQ(fringe.points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto patch =
        volume.bezier(static_cast<std::size_t>(fringe.patches[i]), volume.rest_points());
    const glm::dvec3 nearest =
        glm::clamp(points[static_cast<std::size_t>(fringe.points[i])], 0.0, 1.0);
    EXPECT_LT(glm::distance(patch.value(fringe.uvw[i]), nearest), 1e-12);
  }
}

}  // namespace
}  // namespace espalier
