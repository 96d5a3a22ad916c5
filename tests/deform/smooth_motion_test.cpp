#include "deform/direct/smooth_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "deform/direct/pull.h"
#include "deform/embed/embed.h"
#include "deform/evaluate/weights.h"
#include "lattice/build/weld.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/edit.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// A lattice with its volume and picks.
struct Case {
  std::string name;
  Lattice lattice;
  Volume volume;
  StencilTable rows;
};

Case make_case(const std::string& name, Lattice lattice, const std::vector<glm::dvec3>& points) {
  Volume volume = lattice.freeze();
  StencilTable rows = control_weights(volume, embed(volume, points));
  return {name, std::move(lattice), std::move(volume), std::move(rows)};
}

Lattice spline(Ends ends) {
  const TensorAxis axis = TensorAxis::make(6, 3, ends);
  return make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {}, BoxFilling::Volume);
}

Lattice hierarchical() {
  ThbLattice thb = make_thb_lattice({5, 5, 5}, {2, 2, 2}, {});
  thb = with_cells(thb, 1, cells_of_box(*thb.hierarchy, 1, glm::dvec3(0), glm::dvec3(2.0 / 3)));
  return with_cells(thb, 2, cells_of_box(*thb.hierarchy, 2, glm::dvec3(0), glm::dvec3(0.5)));
}

std::vector<Case> cases() {
  const std::vector<glm::dvec3> points = {{0.3, 0.4, 0.45}, {0.7, 0.6, 0.55}};
  std::vector<Case> all;
  all.push_back(make_case("open", spline(Ends::Open), points));
  all.push_back(make_case("tripled", spline(Ends::Tripled), points));
  all.push_back(make_case("thb", hierarchical(), points));
  all.push_back(make_case("grid", test::prism(test::grid_section(3, 3), 3),
                          {{0.8, 1.2, 1.5}, {2.1, 1.9, 1.4}}));
  return all;
}

double energy(const StencilTable& differences, std::span<const glm::dvec3> motion) {
  double sum = 0;
  for (const glm::dvec3& v : differences.apply(motion)) {
    sum += glm::dot(v, v);
  }
  return sum;
}

TEST(SmoothMotion, of_one_pick_moves_the_whole_lattice_where_nothing_is_pinned) {
  const glm::dvec3 wanted(0.1, -0.2, 0.3);
  for (const Case& c : cases()) {
    const Case one = make_case(c.name, c.lattice,
                               {c.volume.bezier(0, c.volume.rest_points()).value({0.4, 0.5, 0.6})});
    const auto energy_of_one =
        smooth_motion(one.rows, neighbour_differences(one.lattice, one.volume));
    const PullMotion pulled = Pull(one.rows, energy_of_one).motion(std::span(&wanted, 1));
    for (const glm::dvec3& v : pulled.motion) {
      EXPECT_LT(glm::distance(v, wanted), 1e-14) << c.name;
    }
  }
}

TEST(SmoothMotion, meets_picks_and_has_the_least_energy_of_all_motions_that_do) {
  const std::vector<glm::dvec3> wanted = {{0.1, 0, 0.05}, {-0.1, 0.02, 0}};
  for (const Case& c : cases()) {
    const StencilTable differences = neighbour_differences(c.lattice, c.volume);
    const PullMotion pulled = Pull(c.rows, smooth_motion(c.rows, differences)).motion(wanted);
    for (const glm::dvec3& residual : pulled.residuals) {
      EXPECT_LT(glm::length(residual), 1e-13) << c.name;
    }
    // Any other motion that leaves the picks where they are costs more, whatever its sign.
    auto noise = test::jittered(std::vector<glm::dvec3>(c.volume.n_controls()), 0.01, 3);
    const PullMotion back = Pull(c.rows).motion(c.rows.apply(noise));
    double along = 0;
    const auto slopes = differences.apply(pulled.motion);
    for (std::size_t i = 0; i < noise.size(); ++i) {
      noise[i] -= back.motion[i];
    }
    const auto moves = differences.apply(noise);
    for (std::size_t i = 0; i < moves.size(); ++i) {
      along += glm::dot(slopes[i], moves[i]);
    }
    EXPECT_NEAR(along, 0, 1e-13 * std::sqrt(energy(differences, noise))) << c.name;
    EXPECT_LT(energy(differences, pulled.motion),
              energy(differences, Pull(c.rows).motion(wanted).motion))
        << c.name;
  }
}

TEST(SmoothMotion, leaves_what_is_pinned_and_stretches_evenly_to_it) {
  // A row of control points of degree 1, pinned at one end and pulled at the other.
  const TensorAxis axis = TensorAxis::make(9, 1, Ends::Open);
  const TensorAxis two = TensorAxis::make(2, 1, Ends::Open);
  const Case bar = make_case("bar", make_tensor_lattice(TensorKind::BSpline, {axis, two, two}, {}),
                             {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}});
  std::vector<double> mobilities(bar.volume.n_controls(), 1.0);
  for (std::size_t i = 0; i < mobilities.size(); i += 9) {
    mobilities[i] = 0;
  }
  const StencilTable differences = neighbour_differences(bar.lattice, bar.volume);
  const std::vector<glm::dvec3> wanted(4, {0, 0, 1});
  const PullMotion even =
      Pull(bar.rows, smooth_motion(bar.rows, differences, mobilities)).motion(wanted);
  for (std::size_t i = 0; i < mobilities.size(); ++i) {
    EXPECT_NEAR(even.motion[i].z, static_cast<double>(i % 9) / 8, 1e-14);
  }
  EXPECT_EQ(even.motion[0], glm::dvec3(0));
  // The far half three times as stiff: it takes a quarter of the stretch, the joint a share too.
  for (std::size_t i = 0; i < mobilities.size(); ++i) {
    mobilities[i] = i % 9 == 0 ? 0 : i % 9 <= 4 ? 1 : 1.0 / 3;
  }
  const PullMotion stiff =
      Pull(bar.rows, smooth_motion(bar.rows, differences, mobilities)).motion(wanted);
  const double give = 4 + 0.5 + 3 / 3.0;  // of edges of stiffness 1, 2 and 3
  EXPECT_NEAR(stiff.motion[4].z, 4 / give, 1e-14);
  EXPECT_NEAR(stiff.motion[5].z, 4.5 / give, 1e-14);
  EXPECT_NEAR(stiff.motion[8].z, 1, 1e-14);
}

TEST(SmoothMotion, leaves_parts_of_the_lattice_that_no_pick_sees) {
  // Two cubes that share nothing.
  const CellMesh cube = mesh_of(test::prism(test::grid_section(1, 1), 1));
  CellMesh far = cube;
  for (glm::dvec3& p : far.points) {
    p.x += 5;
  }
  const Case both =
      make_case("cubes", test::lattice_from(side_by_side(cube, far)), {{0.5, 0.5, 0.5}});
  const glm::dvec3 wanted(1, 0, 0);
  const PullMotion pulled =
      Pull(both.rows, smooth_motion(both.rows, neighbour_differences(both.lattice, both.volume)))
          .motion(std::span(&wanted, 1));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LT(glm::distance(pulled.motion[i], wanted), 1e-14);
    EXPECT_EQ(pulled.motion[8 + i], glm::dvec3(0));
  }
}

TEST(SmoothMotion, names_mobilities_that_are_none) {
  const Case c = cases().front();
  const StencilTable differences = neighbour_differences(c.lattice, c.volume);
  std::vector<double> mobilities(c.volume.n_controls(), 1.0);
  mobilities[2] = NAN;
  EXPECT_THROW((void)smooth_motion(c.rows, differences, mobilities), ParameterError);
  mobilities.resize(3);
  EXPECT_THROW((void)smooth_motion(c.rows, differences, mobilities), ParameterError);
}

}  // namespace
}  // namespace espalier
