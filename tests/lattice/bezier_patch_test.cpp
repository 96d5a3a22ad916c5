#include "lattice/volume/bezier_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

using test::warped_cube;

constexpr std::array<std::array<int, 3>, 9> kDegrees = {{{1, 1, 1},
                                                         {2, 2, 2},
                                                         {3, 3, 3},
                                                         {1, 1, 3},
                                                         {3, 2, 1},
                                                         {0, 2, 3},
                                                         {4, 4, 4},
                                                         {5, 1, 2},
                                                         {9, 8, 10}}};

std::vector<glm::dvec3> places(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-0.1, 1.1);
  std::vector<glm::dvec3> result = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0.5}, {0.5, 0.5, 0.5}};
  for (int i = 0; i < 20; ++i) {
    result.emplace_back(unit(random), unit(random), unit(random));
  }
  return result;
}

/// De Casteljau's algorithm, one axis after the other.
glm::dvec3 value_by_de_casteljau(const BezierPatch& patch, const glm::dvec3& uvw) {
  std::vector<glm::dvec3> points = patch.points;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(patch.degree[static_cast<std::size_t>(axis)] + 1);
    std::vector<glm::dvec3> ends;
    for (std::size_t line = 0; line < points.size(); line += n) {
      for (std::size_t left = n - 1; left > 0; --left) {
        for (std::size_t i = line; i < line + left; ++i) {
          points[i] = (1 - uvw[axis]) * points[i] + uvw[axis] * points[i + 1];
        }
      }
      ends.push_back(points[line]);
    }
    points = ends;  // the next axis is now the fastest
  }
  return points[0];
}

TEST(BezierPatch, value_is_that_of_de_casteljaus_algorithm) {
  for (const auto& degree : kDegrees) {
    const BezierPatch patch = warped_cube(degree, 0.3, 1);
    for (const glm::dvec3& uvw : places(2)) {
      EXPECT_LT(glm::distance(patch.value(uvw), value_by_de_casteljau(patch, uvw)), 1e-13)
          << degree[0] << degree[1] << degree[2];
    }
  }
}

TEST(BezierPatch, takes_its_corner_points_at_the_corners_bit_for_bit) {
  for (const auto& degree : kDegrees) {
    const BezierPatch patch = warped_cube(degree, 0.3, 1);
    EXPECT_EQ(patch.value({0, 0, 0}), patch.points.front());
    EXPECT_EQ(patch.value({1, 1, 1}), patch.points.back());
  }
}

TEST(BezierPatch, is_exactly_zero_where_all_its_points_are) {
  for (const auto& degree : kDegrees) {
    BezierPatch patch = warped_cube(degree, 0.3, 1);
    std::fill(patch.points.begin(), patch.points.end(), glm::dvec3(0));
    for (const glm::dvec3& uvw : places(3)) {
      EXPECT_EQ(patch.value(uvw), glm::dvec3(0));
      EXPECT_EQ(patch.derivative(uvw), glm::dmat3(0));
    }
  }
}

TEST(BezierPatch, derivative_is_the_difference_quotient) {
  for (const auto& degree : kDegrees) {
    for (const bool is_pyramid : {false, true}) {
      const BezierPatch patch = warped_cube(degree, 0.1, 4, is_pyramid);
      for (const glm::dvec3& uvw : places(5)) {
        glm::dvec3 value;
        glm::dmat3 derivative;
        patch.evaluate(uvw, value, derivative);
        EXPECT_EQ(value, patch.value(uvw));
        EXPECT_EQ(derivative, patch.derivative(uvw));
        for (int axis = 0; axis < 3; ++axis) {
          const double factor = is_pyramid && axis < 2 ? 1 - uvw.z : 1;
          glm::dvec3 step(0);
          step[axis] = 1e-5;
          const glm::dvec3 quotient = (patch.value(uvw + step) - patch.value(uvw - step)) / 2e-5;
          EXPECT_LT(glm::distance(factor * derivative[axis], quotient), 3e-7)
              << degree[0] << degree[1] << degree[2] << is_pyramid;
        }
      }
    }
  }
}

TEST(BezierPatch, derivative_of_a_pyramid_is_regular_at_its_apex) {
  for (const int height : {1, 2, 3, 5}) {
    const BezierPatch patch = warped_cube({2, 2, height}, 0, 0, true);
    const glm::dmat3 J = patch.derivative({0.5, 0.5, 1});
    EXPECT_GT(glm::dot(J[0], glm::cross(J[1], J[2])), 0.5) << height;
    const glm::dmat3 before = patch.derivative({0.5, 0.5, 1 - 1e-9});
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(glm::distance(J[axis], before[axis]), 1e-7);
    }
  }
}

TEST(BezierPatch, part_is_the_same_map) {
  const glm::dvec3 low(0.2, -0.05, 0.25);
  for (const auto& degree : kDegrees) {
    for (const bool is_pyramid : {false, true}) {
      const BezierPatch patch = warped_cube(degree, 0.2, 6, is_pyramid);
      for (const glm::dvec3& high : {glm::dvec3(0.7, 1.05, 0.5), glm::dvec3(1)}) {
        const BezierPatch part = patch.part(low, high);
        EXPECT_EQ(part.is_pyramid, is_pyramid && high.z == 1);
        for (const glm::dvec3& uvw : places(7)) {
          const glm::dvec3 wanted = patch.value(low + uvw * (high - low));
          EXPECT_LT(glm::distance(part.value(uvw), wanted), 1e-12);
        }
      }
    }
  }
}

TEST(BezierPatch, part_of_everything_and_of_a_half_are_exact) {
  const BezierPatch patch = warped_cube({3, 3, 3}, 0.2, 6);
  EXPECT_EQ(patch.part(glm::dvec3(0), glm::dvec3(1)).points, patch.points);
  BezierPatch whole = patch;
  for (glm::dvec3& point : whole.points) {
    point = glm::round(point * 1024.0);
  }
  const BezierPatch half = whole.part({0, 0, 0}, {0.5, 1, 1});
  EXPECT_EQ(half.points[3],
            (whole.points[0] + 3.0 * (whole.points[1] + whole.points[2]) + whole.points[3]) / 8.0);
}

TEST(BezierPatch, elevated_is_the_same_map) {
  for (const auto& degree : kDegrees) {
    for (const bool is_pyramid : {false, true}) {
      const BezierPatch patch = warped_cube(degree, 0.2, 8, is_pyramid);
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const BezierPatch higher = patch.elevated(axis, degree[a] + 2);
        EXPECT_EQ(higher.degree[a], degree[a] + 2);
        EXPECT_EQ(higher.is_pyramid, is_pyramid);
        for (const glm::dvec3& uvw : places(9)) {
          EXPECT_LT(glm::distance(higher.value(uvw), patch.value(uvw)), 1e-13);
        }
      }
    }
  }
}

TEST(BezierPatch, hull_box_holds_all_values) {
  const BezierPatch patch = warped_cube({3, 2, 3}, 0.5, 10);
  for (const glm::dvec3& uvw : places(11)) {
    EXPECT_TRUE(patch.hull_box().grown(1e-15).contains(patch.value(glm::clamp(uvw, 0.0, 1.0))));
  }
}

/// A warped cube of positive weights.
BezierPatch rational_cube(const std::array<int, 3>& degree, unsigned seed) {
  BezierPatch patch = warped_cube(degree, 0.1, seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.5, 2);
  for (glm::dvec3& point : patch.points) {
    patch.weights.push_back(weight(random));
    point *= patch.weights.back();
  }
  return patch;
}

TEST(BezierPatch, a_rational_one_is_the_quotient_of_two_polynomials) {
  for (const auto& degree : kDegrees) {
    const BezierPatch patch = rational_cube(degree, 12);
    BezierPatch numerators = patch;
    numerators.weights.clear();
    BezierPatch weights = numerators;
    for (std::size_t i = 0; i < weights.points.size(); ++i) {
      weights.points[i] = glm::dvec3(patch.weights[i]);
    }
    for (const glm::dvec3& uvw : places(13)) {
      const glm::dvec3 wanted =
          value_by_de_casteljau(numerators, uvw) / value_by_de_casteljau(weights, uvw);
      EXPECT_LT(glm::distance(patch.value(uvw), wanted), 2e-13);
    }
  }
}

TEST(BezierPatch, derivative_of_a_rational_one_is_the_difference_quotient) {
  for (const auto& degree : kDegrees) {
    const BezierPatch patch = rational_cube(degree, 14);
    for (const glm::dvec3& uvw : places(15)) {
      const glm::dvec3 at = glm::clamp(uvw, 0.0, 1.0);
      glm::dvec3 value;
      glm::dmat3 derivative;
      patch.evaluate(at, value, derivative);
      EXPECT_LT(glm::distance(value, patch.value(at)), 1e-14);
      for (int axis = 0; axis < 3; ++axis) {
        const auto quotient = [&](double h) {
          glm::dvec3 step(0);
          step[axis] = h;
          return (patch.value(at + step) - patch.value(at - step)) / (2 * h);
        };
        const glm::dvec3 limit = (4.0 * quotient(5e-5) - quotient(1e-4)) / 3.0;
        EXPECT_LT(glm::distance(derivative[axis], limit), 1e-9);
      }
    }
  }
}

TEST(BezierPatch, equal_weights_are_no_weights) {
  BezierPatch patch = warped_cube({3, 2, 3}, 0.2, 16);
  const BezierPatch polynomial = patch;
  patch.weights.assign(patch.points.size(), 4.0);
  for (glm::dvec3& point : patch.points) {
    point *= 4.0;
  }
  for (const glm::dvec3& uvw : places(17)) {
    EXPECT_LT(glm::distance(patch.value(uvw), polynomial.value(uvw)), 1e-14);
  }
}

TEST(BezierPatch, a_quarter_circle_is_exact) {
  const double h = std::sqrt(0.5);
  const BezierPatch arc{{2, 0, 0}, {{1, 0, 0}, {h, h, 0}, {0, 1, 0}}, false, {1, h, 1}};
  for (int i = 0; i <= 16; ++i) {
    const glm::dvec3 uvw(i / 16.0, 0, 0);
    EXPECT_NEAR(glm::length(arc.value(uvw)), 1, 2e-16);
    EXPECT_NEAR(glm::dot(arc.value(uvw), arc.derivative(uvw)[0]), 0, 5e-16);
  }
}

TEST(BezierPatch, part_elevation_and_hull_of_a_rational_one_are_those_of_its_map) {
  const glm::dvec3 low(0.2, 0, 0.25);
  const glm::dvec3 high(0.7, 0.5, 1);
  for (const auto& degree : {kDegrees[0], kDegrees[2], kDegrees[7]}) {
    const BezierPatch patch = rational_cube(degree, 18);
    const BezierPatch part = patch.part(low, high);
    const BezierPatch higher = patch.elevated(1, degree[1] + 2);
    EXPECT_EQ(higher.weights.size(), higher.points.size());
    for (const glm::dvec3& place : places(19)) {
      const glm::dvec3 uvw = glm::clamp(place, 0.0, 1.0);
      EXPECT_LT(glm::distance(part.value(uvw), patch.value(low + uvw * (high - low))), 1e-13);
      EXPECT_LT(glm::distance(higher.value(uvw), patch.value(uvw)), 1e-13);
      EXPECT_TRUE(part.hull_box().grown(1e-14).contains(part.value(uvw)));
    }
  }
}

}  // namespace
}  // namespace espalier
