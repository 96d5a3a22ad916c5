#include "tests/support/spline_volume.h"

#include <algorithm>
#include <utility>

#include "tests/support/families.h"

namespace espalier::test {
namespace {

/// The coefficients that an interval sees on one axis of n intervals: first and last.
std::pair<int, int> coefficients(int interval, int n) {
  return {std::max(interval - 1, 0), std::min(interval + 2, n)};
}

}  // namespace

std::vector<glm::dvec3> grid_points(const std::array<int, 3>& n) {
  std::vector<glm::dvec3> points;
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) {
        points.emplace_back(i, j, k);
      }
    }
  }
  return points;
}

Volume spline_volume(const std::array<int, 3>& n, std::vector<glm::dvec3> controls) {
  VolumeTables tables;
  tables.stencils = StencilTable::build(
      controls.size(), controls.size(),
      [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1.0); });
  for (const bool begin : {false, true}) {
    for (const bool end : {false, true}) {
      tables.extractions.push_back(uniform_cubic_extraction(begin, end));
    }
  }
  for (const glm::dvec3& cell : grid_points({n[0] - 1, n[1] - 1, n[2] - 1})) {
    Patch patch;
    std::array<std::pair<int, int>, 3> range;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const int interval = static_cast<int>(cell[axis]);
      range[a] = coefficients(interval, n[a]);
      const bool begin = interval == 0;
      const bool end = interval == n[a] - 1;
      patch.extractions[a] = static_cast<std::uint16_t>(2 * (begin ? 1 : 0) + (end ? 1 : 0));
      patch.boundary_faces = static_cast<std::uint8_t>(
          patch.boundary_faces | (begin ? 1 << (2 * a) : 0) | (end ? 2 << (2 * a) : 0));
    }
    std::vector<std::int32_t> block;
    for (int k = range[2].first; k <= range[2].second; ++k) {
      for (int j = range[1].first; j <= range[1].second; ++j) {
        for (int i = range[0].first; i <= range[0].second; ++i) {
          block.push_back(i + (n[0] + 1) * (j + (n[1] + 1) * k));
        }
      }
    }
    tables.patches.push_back(patch);
    tables.blocks.push_back(block);
  }
  return {std::move(tables), std::move(controls)};
}

BezierPatch warped_cube(const std::array<int, 3>& degree, double noise, unsigned seed,
                        bool is_pyramid) {
  BezierPatch patch{degree, grid_points(degree), is_pyramid};
  for (glm::dvec3& point : patch.points) {
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] /= std::max(degree[static_cast<std::size_t>(axis)], 1);
    }
    if (is_pyramid) {
      const double shrink = 1 - point.z;
      point.x = 0.5 + shrink * (point.x - 0.5);
      point.y = 0.5 + shrink * (point.y - 0.5);
    }
  }
  patch.points = jittered(std::move(patch.points), noise, seed);
  if (is_pyramid) {
    const auto n = static_cast<std::ptrdiff_t>((degree[0] + 1) * (degree[1] + 1));
    std::fill(patch.points.end() - n, patch.points.end(), glm::dvec3(0.5, 0.4, 1));
  }
  return patch;
}

}  // namespace espalier::test
