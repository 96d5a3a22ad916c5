#include "lattice/tensor/tensor_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/tensor/thb_lattice.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

constexpr std::array<Ends, 5> kAllEnds = {Ends::Open, Ends::Uniform, Ends::Natural, Ends::Tripled,
                                          Ends::Periodic};

/// A lattice on a box with noise on its points, and weights if it has any; posed.
TensorLattice warped(TensorKind kind, const std::array<TensorAxis, 3>& axes, unsigned seed) {
  OrientedBox box{{1, 2, 3}, glm::dmat3(1.0), {2, 1, 1.5}};
  TensorLattice lattice = make_tensor_lattice(kind, axes, box);
  lattice.rest = test::jittered(lattice.rest, 0.1, seed);
  lattice.pose = test::jittered(lattice.rest, 0.4, seed + 1);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.5, 2);
  for (double& w : lattice.weights) {
    w = weight(random);
  }
  return lattice;
}

std::array<TensorAxis, 3> same_axes(int n, int degree, Ends ends) {
  const TensorAxis axis = TensorAxis::make(n, degree, ends);
  return {axis, axis, axis};
}

std::vector<std::array<TensorAxis, 3>> axes_of_all_kinds() {
  const TensorAxis open = TensorAxis::make(5, 3, Ends::Open);
  std::vector<std::array<TensorAxis, 3>> all;
  for (const Ends ends : kAllEnds) {
    all.push_back({open, TensorAxis::make(6, 3, ends), TensorAxis::make(3, 2, Ends::Open)});
  }
  all.push_back({TensorAxis::make(2, 3, Ends::Natural), TensorAxis::make(2, 3, Ends::Tripled),
                 TensorAxis::from_knots(2, {0, 0, 0.5, 1, 1, 2.5, 4, 4.5})});
  all.push_back({TensorAxis(), TensorAxis::make(4, 1, Ends::Open), open});
  all.push_back({TensorAxis(), open, TensorAxis()});
  all.push_back({});
  return all;
}

std::vector<glm::dvec3> places(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> result = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0.5}, {0.5, 0.5, 0.5}};
  for (int i = 0; i < 40; ++i) {
    result.emplace_back(unit(random), unit(random), unit(random));
  }
  return result;
}

/// The volume's map at a place of the whole, and its derivative, of any points and weights.
struct Sample {
  glm::dvec3 value;
  glm::dmat3 derivative;
};

Sample sample(const TensorLattice& lattice, const Volume& volume, const glm::dvec3& uvw,
              std::span<const glm::dvec3> points, std::span<const double> weights) {
  const PatchPlace place = place_of(lattice, uvw);
  BezierPatch patch;
  volume.bezier(place.patch, points, weights, patch);
  Sample result;
  patch.evaluate(place.uvw, result.value, result.derivative);
  for (int axis = 0; axis < 3; ++axis) {
    result.derivative[axis] *= place.scale[axis];
  }
  return result;
}

Sample at_rest(const TensorLattice& lattice, const Volume& volume, const glm::dvec3& uvw) {
  return sample(lattice, volume, uvw, volume.rest_points(), volume.weights());
}

/// Σ w N P / Σ w N straight from the axes' functions.
glm::dvec3 by_definition(const TensorLattice& lattice, const glm::dvec3& uvw) {
  std::array<SparseRow, 3> rows;
  for (std::size_t a = 0; a < 3; ++a) {
    const TensorAxis& axis = lattice.axes[a];
    rows[a] = axis.values(axis.begin() + uvw[static_cast<int>(a)] * (axis.end() - axis.begin()));
  }
  glm::dvec3 sum(0);
  double weight_sum = 0;
  const auto counts = lattice.counts();
  for (const auto& [k, w] : rows[2]) {
    for (const auto& [j, v] : rows[1]) {
      for (const auto& [i, u] : rows[0]) {
        const auto at = static_cast<std::size_t>(i + counts[0] * (j + counts[1] * k));
        const double weight = u * v * w * (lattice.weights.empty() ? 1 : lattice.weights[at]);
        sum += weight * lattice.rest[at];
        weight_sum += weight;
      }
    }
  }
  return sum / weight_sum;
}

TEST(TensorLattice, volume_is_the_sum_of_functions_times_control_points) {
  for (const auto& axes : axes_of_all_kinds()) {
    for (const TensorKind kind : {TensorKind::BSpline, TensorKind::Nurbs}) {
      TensorLattice lattice = warped(kind, axes, 1);
      const Volume volume = freeze(lattice);
      for (const glm::dvec3& uvw : places(2)) {
        glm::dvec3 thickness(0);
        for (int axis = 0; axis < 3; ++axis) {
          thickness += (uvw[axis] - 0.5) * lattice.thickness[static_cast<std::size_t>(axis)];
        }
        const glm::dvec3 wanted = by_definition(lattice, uvw) + thickness;
        EXPECT_LT(glm::distance(at_rest(lattice, volume, uvw).value, wanted), 1e-13);
      }
    }
  }
}

TEST(TensorLattice, bezier_is_de_casteljaus_algorithm) {
  const std::array<TensorAxis, 3> axes = {TensorAxis::make(4, 3, Ends::Open),
                                          TensorAxis::make(3, 2, Ends::Open),
                                          TensorAxis::make(6, 5, Ends::Open)};
  const TensorLattice lattice = warped(TensorKind::Bezier, axes, 3);
  const Volume volume = freeze(lattice);
  ASSERT_EQ(volume.n_patches(), 1u);
  EXPECT_EQ(volume.bezier(0, volume.rest_points()).points, lattice.rest);
  for (const glm::dvec3& uvw : places(4)) {
    std::vector<glm::dvec3> points = lattice.rest;
    for (int axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(axes[static_cast<std::size_t>(axis)].n_controls());
      std::vector<glm::dvec3> ends;
      for (std::size_t line = 0; line < points.size(); line += n) {
        for (std::size_t left = n - 1; left > 0; --left) {
          for (std::size_t i = line; i < line + left; ++i) {
            points[i] = (1 - uvw[axis]) * points[i] + uvw[axis] * points[i + 1];
          }
        }
        ends.push_back(points[line]);
      }
      points = ends;
    }
    EXPECT_LT(glm::distance(at_rest(lattice, volume, uvw).value, points[0]), 1e-14);
  }
}

TEST(TensorLattice, a_box_is_mapped_affinely) {
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  const OrientedBox box{{1, 2, 3}, glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1), {2, 1, 1.5}};
  for (const Ends ends : {Ends::Open, Ends::Uniform, Ends::Natural}) {
    const TensorLattice lattice =
        make_tensor_lattice(TensorKind::BSpline, same_axes(6, 3, ends), box, BoxFilling::Volume);
    const Volume volume = freeze(lattice);
    for (const glm::dvec3& uvw : places(5)) {
      EXPECT_LT(glm::distance(at_rest(lattice, volume, uvw).value, box.at(2.0 * uvw - 1.0)), 4e-15);
    }
    const TensorLattice outer =
        make_tensor_lattice(TensorKind::BSpline, same_axes(6, 3, ends), box);
    EXPECT_EQ(outer.rest.front(), box.at({-1, -1, -1}));
    EXPECT_EQ(outer.rest.back(), box.at({1, 1, 1}));
  }
}

TEST(TensorLattice, derivative_is_the_difference_quotient) {
  for (const auto& axes : axes_of_all_kinds()) {
    const TensorLattice lattice = warped(TensorKind::Nurbs, axes, 6);
    const Volume volume = freeze(lattice);
    for (const glm::dvec3& place : places(7)) {
      const glm::dvec3 uvw = glm::clamp(place, 1e-3, 1 - 1e-3);
      const Sample here = at_rest(lattice, volume, uvw);
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0);
        step[axis] = 1e-5;
        const glm::dvec3 quotient = (at_rest(lattice, volume, uvw + step).value -
                                     at_rest(lattice, volume, uvw - step).value) /
                                    2e-5;
        EXPECT_LT(glm::distance(here.derivative[axis], quotient),
                  1e-4 * (1 + glm::length(quotient)));
      }
    }
  }
}

TEST(TensorLattice, natural_is_the_catmull_clark_grid) {
  CellMesh mesh = make_box({3, 2, 4}, {0, 0, 0}, {3, 2, 4});
  SubdivisionLattice grid = test::lattice_from(mesh);
  const Volume subdivided = freeze_adaptive(grid, {});
  const std::array<TensorAxis, 3> axes = {TensorAxis::make(4, 3, Ends::Natural),
                                          TensorAxis::make(3, 3, Ends::Natural),
                                          TensorAxis::make(5, 3, Ends::Natural)};
  TensorLattice lattice =
      make_tensor_lattice(TensorKind::BSpline, axes, {{1.5, 1, 2}, glm::dmat3(1), {1.5, 1, 2}});
  ASSERT_EQ(lattice.rest, grid.rest);
  const Volume volume = freeze(lattice);
  const auto pose = test::jittered(grid.rest, 0.3, 8);
  const auto points = volume.points(pose);
  const auto subdivided_points = subdivided.points(pose);
  ASSERT_EQ(volume.n_patches(), subdivided.n_patches());
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const BezierPatch rest = subdivided.bezier(i, subdivided.rest_points());
    const BezierPatch posed = subdivided.bezier(i, subdivided_points);
    for (const glm::dvec3& uvw : places(9)) {
      const PatchPlace place = place_of(lattice, rest.value(uvw) / glm::dvec3(3, 2, 4));
      const glm::dvec3 here = volume.bezier(place.patch, points).value(place.uvw);
      EXPECT_LT(glm::distance(here, posed.value(uvw)), 1e-13);
    }
  }
}

TEST(TensorLattice, refining_and_elevating_change_nothing_and_give_more_control_points) {
  for (const auto& axes : axes_of_all_kinds()) {
    for (const TensorKind kind : {TensorKind::BSpline, TensorKind::Nurbs}) {
      TensorLattice lattice = warped(kind, axes, 10);
      if (kind == TensorKind::Nurbs) {
        lattice.pose_weights = lattice.weights;
        std::reverse(lattice.pose_weights.begin(), lattice.pose_weights.end());
      }
      std::vector<TensorLattice> finer = {refined(lattice), refined(refined(lattice))};
      for (int axis = 0; axis < 3; ++axis) {
        const TensorAxis& along = axes[static_cast<std::size_t>(axis)];
        if (along.n_controls() > 1 && along.ends() != Ends::Periodic) {
          finer.push_back(elevated(lattice, axis));
          const double knot = 0.3 * along.begin() + 0.7 * along.end();
          finer.push_back(with_knots(lattice, axis, std::vector<double>{knot}));
        }
      }
      const Volume volume = freeze(lattice);
      const auto posed = volume.points(lattice.pose);
      for (const TensorLattice& fine : finer) {
        const Volume fine_volume = freeze(fine);
        EXPECT_EQ(fine.n_controls() > lattice.n_controls(), lattice.n_controls() > 1);
        const auto fine_posed = fine_volume.points(fine.pose);
        // A posed rational point's weights are those of the pose: control points' own here.
        for (const glm::dvec3& uvw : places(11)) {
          EXPECT_LT(glm::distance(at_rest(fine, fine_volume, uvw).value,
                                  at_rest(lattice, volume, uvw).value),
                    1e-13);
          if (lattice.thickness == std::array<glm::dvec3, 3>{}) {
            EXPECT_LT(glm::distance(
                          sample(fine, fine_volume, uvw, fine_posed, fine.posed_weights()).value,
                          sample(lattice, volume, uvw, posed, lattice.posed_weights()).value),
                      1e-13);
          }
        }
      }
    }
  }
}

TEST(TensorLattice, nurbs_make_an_exact_sphere) {
  // A half circle turned round z, in u and v; w scales it.
  const double h = std::sqrt(0.5);
  const std::vector<glm::dvec3> half = {{0, 0, -1}, {1, 0, -1}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  const std::vector<double> half_weights = {1, h, 1, h, 1};
  const std::vector<glm::dvec3> circle = {{1, 0, 0},  {1, 1, 0},  {0, 1, 0},
                                          {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0},
                                          {0, -1, 0}, {1, -1, 0}, {1, 0, 0}};
  TensorLattice ball;
  ball.kind = TensorKind::Nurbs;
  ball.axes = {TensorAxis::from_knots(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}),
               TensorAxis::from_knots(2, {0, 0, 0, 1, 1, 2, 2, 2}),
               TensorAxis::make(2, 1, Ends::Open)};
  for (const double radius : {0.5, 1.0}) {
    for (std::size_t j = 0; j < half.size(); ++j) {
      for (std::size_t i = 0; i < circle.size(); ++i) {
        ball.rest.push_back(radius * (half[j].x * circle[i] + glm::dvec3(0, 0, half[j].z)));
        ball.weights.push_back(half_weights[j] * (i % 2 == 0 ? 1 : h));
      }
    }
  }
  const Volume volume = freeze(ball);
  EXPECT_EQ(volume.n_patches(), 8u);
  for (const glm::dvec3& uvw : places(12)) {
    EXPECT_NEAR(glm::length(at_rest(ball, volume, uvw).value), 0.5 + 0.5 * uvw.z, 1e-15);
  }
}

TEST(TensorLattice, boundary_is_where_no_neighbour_is_and_rings_have_none) {
  const std::array<TensorAxis, 3> axes = {TensorAxis::make(6, 3, Ends::Periodic),
                                          TensorAxis::make(5, 3, Ends::Uniform), TensorAxis()};
  const TensorLattice lattice = make_tensor_lattice(TensorKind::BSpline, axes, {});
  const Volume volume = freeze(lattice);
  ASSERT_EQ(volume.n_patches(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    const std::array<bool, 6> wanted = {false, false, i < 6, i >= 6, true, true};
    for (int face = 0; face < 6; ++face) {
      EXPECT_EQ(volume.patch(i).is_on_boundary(face), wanted[static_cast<std::size_t>(face)]);
    }
  }
  // The ring's map is right-handed everywhere and closes.
  for (const glm::dvec3& uvw : places(13)) {
    const glm::dmat3 J = at_rest(lattice, volume, uvw).derivative;
    EXPECT_GT(glm::dot(J[0], glm::cross(J[1], J[2])), 1e-3);
  }
  EXPECT_LT(glm::distance(at_rest(lattice, volume, {0, 0.3, 0.2}).value,
                          at_rest(lattice, volume, {1, 0.3, 0.2}).value),
            1e-15);
}

TEST(TensorLattice, zero_spans_of_repeated_knots_are_no_patches) {
  const TensorAxis axis = TensorAxis::from_knots(2, {0, 0, 0, 1, 1, 2, 2, 2});
  TensorLattice lattice = make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {});
  EXPECT_EQ(freeze(lattice).n_patches(), 8u);
}

TEST(TensorLattice, one_control_point_on_an_axis_moves_everything_along_it_alike) {
  const std::array<TensorAxis, 3> axes = {TensorAxis::make(4, 3, Ends::Open),
                                          TensorAxis::make(4, 3, Ends::Open), TensorAxis()};
  TensorLattice lattice = make_tensor_lattice(TensorKind::BSpline, axes, {});
  for (const bool has_thickness : {true, false}) {
    if (!has_thickness) {
      lattice.thickness = {};
    }
    const Volume volume = freeze(lattice);
    EXPECT_EQ(volume.n_controls(), 16u);
    EXPECT_EQ(volume.degree(0), (std::array<int, 3>{3, 3, 1}));
    const double height = has_thickness ? 1 : std::sqrt(2.0);
    EXPECT_LT(glm::distance(at_rest(lattice, volume, {0.25, 0.75, 1}).value,
                            {0.25, 0.75, 0.5 + height / 2}),
              1e-15);
    const auto moves = volume.displacements(test::jittered(lattice.rest, 0.2, 14));
    const BezierPatch patch = volume.bezier(0, moves);
    EXPECT_LT(glm::distance(patch.value({0.3, 0.4, 0.1}), patch.value({0.3, 0.4, 0.9})), 1e-16);
  }
}

TEST(TensorLattice, one_line_of_control_points_has_a_right_handed_volume_of_its_own) {
  for (int along = 0; along < 3; ++along) {
    std::array<TensorAxis, 3> axes;
    axes[static_cast<std::size_t>(along)] = TensorAxis::make(4, 3, Ends::Open);
    TensorLattice lattice;
    lattice.axes = axes;
    lattice.rest = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}};
    const Volume volume = freeze(lattice);
    const glm::dmat3 J = at_rest(lattice, volume, {0.2, 0.5, 0.7}).derivative;
    EXPECT_NEAR(glm::dot(J[0], glm::cross(J[1], J[2])), std::pow(126, 1.5), 1e-9) << along;
  }
}

/// What is wrong with a lattice.
std::string complaint(const TensorLattice& lattice) {
  try {
    require_valid(lattice);
  } catch (const LatticeError& error) {
    return error.what();
  }
  return "";
}

TEST(TensorLattice, refuses_what_does_not_fit_together) {
  const TensorLattice valid =
      make_tensor_lattice(TensorKind::Nurbs, same_axes(3, 2, Ends::Open), {});
  EXPECT_EQ(complaint(valid), "");
  TensorLattice lattice = valid;
  lattice.rest.pop_back();
  EXPECT_EQ(complaint(lattice), "has 26 rest points, its counts ask for 27");
  lattice = valid;
  lattice.pose = {glm::dvec3(0)};
  EXPECT_EQ(complaint(lattice), "has 1 posed points, its counts ask for 27");
  lattice = valid;
  lattice.rest[3].y = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint(lattice), "rest point 3 has a coordinate inf, not a number up to 1e18");
  lattice = valid;
  lattice.weights[5] = 0;
  EXPECT_EQ(complaint(lattice), "weights[5] is 0, must be positive");
  lattice = valid;
  lattice.kind = TensorKind::BSpline;
  EXPECT_EQ(complaint(lattice), "is a bspline lattice, which has no weights");
  lattice = make_tensor_lattice(TensorKind::BSpline, same_axes(4, 2, Ends::Open), {});
  lattice.kind = TensorKind::Bezier;
  EXPECT_EQ(complaint(lattice), "is a bezier lattice with knots inside along u");
  EXPECT_THROW((void)make_tensor_lattice(TensorKind::Bezier, same_axes(4, 2, Ends::Open), {}),
               ParameterError);
  EXPECT_THROW((void)make_tensor_lattice(TensorKind::BSpline, same_axes(4, 2, Ends::Periodic), {}),
               ParameterError);
  EXPECT_THROW((void)make_tensor_lattice(TensorKind::BSpline, same_axes(60000, 2, Ends::Open), {}),
               ParameterError);
}

TEST(TensorLattice, refuses_lattices_without_thickness) {
  const TensorAxis axis = TensorAxis::make(3, 2, Ends::Open);
  const auto complaint = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  OrientedBox flat;
  flat.half_sizes.y = 0;
  EXPECT_EQ(complaint([&] {
              (void)make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, flat);
            }),
            "the box has no thickness along v: its half size is 0");
  EXPECT_EQ(complaint([&] {
              (void)make_thb_lattice({3, 3, 3}, {2, 2, 2}, flat);
            }),
            "the box has no thickness along v: its half size is 0");
  TensorLattice lattice = make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {});
  ThbLattice levels = make_thb_lattice({3, 3, 3}, {2, 2, 2}, {});
  for (const glm::dvec3& normal : {glm::dvec3(0, 0, 1), glm::dvec3(0.36, 0.48, 0.8)}) {
    lattice.rest = make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {}).rest;
    for (glm::dvec3& p : lattice.rest) {
      p -= glm::dot(p, normal) * normal;
    }
    levels.rest = lattice.rest;
    for (const std::string& found :
         {complaint([&] { (void)freeze(lattice); }), complaint([&] { (void)freeze(levels); })}) {
      EXPECT_EQ(found.find("the control points at rest all lie in a plane"), 0u) << found;
    }
    lattice.rest[5] += 1e-6 * normal;
    EXPECT_EQ(complaint([&] { (void)freeze(lattice); }), "");
  }
}

TEST(OrientedBox, fits_points_along_the_axes_or_along_their_own) {
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const glm::dmat3 turn(c, s, 0, -s, c, 0, 0, 0, 1);
  std::vector<glm::dvec3> points;
  for (const glm::dvec3& corner : test::grid_points({1, 1, 1})) {
    points.push_back(glm::dvec3(5, 6, 7) + turn * (glm::dvec3(4, 2, 1) * (corner - 0.5)));
  }
  const OrientedBox own = fitted_principal_box(points, 0);
  EXPECT_LT(glm::distance(own.center, glm::dvec3(5, 6, 7)), 1e-14);
  EXPECT_LT(glm::distance(own.half_sizes, glm::dvec3(2, 1, 0.5)), 1e-13);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(glm::distance(own.axes[axis], turn[axis]), 1e-13);
  }
  const OrientedBox plain = fitted_box(points, 0.1);
  EXPECT_EQ(plain.axes, glm::dmat3(1.0));
  const glm::dvec3 half(2 * c + s, 2 * s + c, 0.5);
  EXPECT_LT(glm::distance(plain.half_sizes, half + 0.2 * glm::length(half)), 1e-13);
  EXPECT_THROW((void)fitted_box({}, 0), ParameterError);
  EXPECT_THROW((void)fitted_box(points, -1), ParameterError);
}

TEST(OrientedBox, gives_flat_things_a_thickness) {
  const std::vector<glm::dvec3> square = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {3, 4, 0}};
  for (const OrientedBox& box : {fitted_box(square, 0), fitted_principal_box(square, 0)}) {
    EXPECT_NEAR(box.half_sizes.z, 0.0025, 1e-15);
  }
}

}  // namespace
}  // namespace espalier
