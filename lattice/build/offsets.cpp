#include "lattice/build/offsets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr double kLongestMiter = 4;
constexpr double kCancelled = 1e-6;

/// The angle of a loop at its corner i, radians.
double corner_angle(std::span<const glm::dvec3> points, std::span<const std::int32_t> loop,
                    std::size_t i) {
  const auto point = [&](std::size_t j) {
    return points[static_cast<std::size_t>(loop[j % loop.size()])];
  };
  const glm::dvec3 a = unit_vector(point(i + 1) - point(i));
  const glm::dvec3 b = unit_vector(point(i + loop.size() - 1) - point(i));
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

glm::dvec3 unit_vector(const glm::dvec3& vector) {
  const glm::dvec3 size = glm::abs(vector);
  const double largest = std::max({size.x, size.y, size.z});
  return largest > 0 ? glm::normalize(vector / largest) : glm::dvec3(0);
}

glm::dvec3 area_vector(std::span<const glm::dvec3> points, std::span<const std::int32_t> loop) {
  const auto point = [&](std::size_t i) { return points[static_cast<std::size_t>(loop[i])]; };
  glm::dvec3 area(0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    area += glm::cross(point(i) - point(0), point(i + 1) - point(0));
  }
  return area;
}

std::vector<glm::dvec3> offsets_along_normals(std::span<const glm::dvec3> points,
                                              const CompressedRows<std::int32_t>& faces,
                                              double distance) {
  std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0));
  std::vector<double> angles(points.size(), 0);
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto loop = faces[face];
    const glm::dvec3 normal = unit_vector(area_vector(points, loop));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double angle = corner_angle(points, loop, i);
      sums[static_cast<std::size_t>(loop[i])] += angle * normal;
      angles[static_cast<std::size_t>(loop[i])] += angle;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = glm::length(sums[i]);
    if (angles[i] > 0) {
      if (!(length > kCancelled * angles[i])) {
        throw LatticeError(fmt::format("vertex {}: the normals of its faces cancel", i));
      }
      sums[i] *= distance * std::min(angles[i] / length, kLongestMiter) / length;
    }
  }
  return sums;
}

}  // namespace espalier
