/// Models that no cache holds are written past the caches: to the same bits.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "deform/evaluate/drag.h"
#include "deform/evaluate/evaluator.h"
#include "lattice/core/streamed_copy.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

constexpr std::size_t kFew = 1999;

/// Points in a bent grid, as often as the caches are to be filled over and over.
struct Crowd {
  std::vector<glm::dvec3> points, normals;
  LatticeMotion motion;

  explicit Crowd(std::size_t n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 2);
    for (std::size_t i = 0; i < n; ++i) {
      if (i < kFew) {
        const double x = place(random);
        const double y = place(random);
        points.emplace_back(x, y, place(random));
        normals.push_back(glm::normalize(glm::dvec3(x - 1, y - 1, 0.3)));
      } else {
        points.push_back(points[i - kFew]);
        normals.push_back(normals[i - kFew]);
      }
    }
    const std::vector<glm::dvec3> grid = test::grid_points({2, 2, 2});
    motion.volume = std::make_shared<const Volume>(test::spline_volume({2, 2, 2}, grid));
    motion.binding = std::make_shared<const Binding>(embed(*motion.volume, points));
    motion.displacements = motion.volume->displacements(test::jittered(grid, 0.1, 1));
  }
};

/// Numbers of `width` bytes a point that are more than the caches hold.
std::size_t too_many(std::size_t width) {
  return last_cache_bytes() / width + 3 * kFew;
}

TEST(LargerThanCaches, evaluation_gives_the_same_bits) {
  const Crowd crowd(too_many(36));
  const Binding& binding = *crowd.motion.binding;
  std::vector<glm::dvec3> rest;
  std::vector<glm::dvec3> normals;
  for (const std::int32_t point : binding.points) {
    rest.push_back(crowd.points[static_cast<std::size_t>(point)]);
    normals.push_back(crowd.normals[static_cast<std::size_t>(point)]);
  }
  const Evaluator<float> evaluator(*crowd.motion.volume,
                                   {binding.patches, binding.uvw, rest, normals});
  const std::size_t n = rest.size();
  std::vector<glm::vec3> points(n + 1, glm::vec3(-7));  // begins within a line
  std::vector<glm::vec3> moved_normals(n);
  std::vector<float> determinants(n);
  evaluator.evaluate(VolumeMotion<float>(crowd.motion.displacements),
                     {.points = std::span(points).subspan(1),
                      .determinants = determinants,
                      .normals = moved_normals});
  std::vector<glm::vec3> first(kFew);
  std::vector<glm::vec3> first_normals(kFew);
  std::vector<float> first_determinants(kFew);
  std::size_t n_compared = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto point = static_cast<std::size_t>(binding.points[i]);
    if (point < kFew) {
      first[point] = points[i + 1];
      first_normals[point] = moved_normals[i];
      first_determinants[point] = determinants[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto point = static_cast<std::size_t>(binding.points[i]) % kFew;
    n_compared += first[point] == points[i + 1] && first_normals[point] == moved_normals[i] &&
                          first_determinants[point] == determinants[i]
                      ? 1
                      : 0;
  }
  EXPECT_EQ(n_compared, n);
  EXPECT_EQ(points[0], glm::vec3(-7));

  const Crowd few(kFew);
  const std::vector<LatticeMotion> motions = {few.motion};
  const std::vector<glm::dvec3> expected = combined_points(few.points, motions);
  for (std::size_t i = 0; i < kFew; ++i) {
    EXPECT_LT(glm::distance(glm::dvec3(first[i]), expected[i]), 1e-6);
    EXPECT_NEAR(glm::length(first_normals[i]), 1, 1e-6);
  }
}

TEST(LargerThanCaches, drags_give_the_same_bits) {
  std::vector<double> selection(27, 0.0);
  selection[13] = 1;
  const glm::dvec3 by(0.1, 0.07, -0.05);
  const auto dragged = [&](const Crowd& crowd, std::vector<glm::vec3>& points,
                           std::vector<glm::vec3>& normals) {
    const std::vector<LatticeMotion> motions = {crowd.motion};
    const Drag<float> drag({.rest_points = crowd.points,
                            .motions = motions,
                            .normals = crowd.normals,
                            .has_fold_check = false},
                           selection);
    points.assign(crowd.points.size(), glm::vec3(-7));
    normals.assign(crowd.points.size(), glm::vec3(-7));
    drag.update(by, {}, {.points = points, .normals = normals});
  };
  std::vector<glm::vec3> points;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec3> few_points;
  std::vector<glm::vec3> few_normals;
  const Crowd crowd(too_many(76));
  dragged(crowd, points, normals);
  dragged(Crowd(kFew), few_points, few_normals);
  std::size_t n_equal = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    n_equal += points[i] == few_points[i % kFew] && normals[i] == few_normals[i % kFew] ? 1 : 0;
  }
  EXPECT_EQ(n_equal, points.size());
  EXPECT_NE(points[0], glm::vec3(-7));
}

}  // namespace
}  // namespace espalier
