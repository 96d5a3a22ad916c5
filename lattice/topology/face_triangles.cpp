#include "lattice/topology/face_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace espalier {
namespace {

/// Loops beyond this size are never cut by ears, which takes up to the cube of their size.
constexpr std::size_t kLargestConcaveLoop = 512;

bool append_fan(std::span<const glm::dvec3> loop, const glm::dvec3& normal, bool may_fold,
                std::vector<Triangle>& triangles) {
  const std::size_t n_before = triangles.size();
  glm::dvec3 centroid(0);
  for (const glm::dvec3& point : loop) {
    centroid += point / static_cast<double>(loop.size());
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3& next = loop[i + 1 < loop.size() ? i + 1 : 0];
    if (!may_fold && glm::dot(glm::cross(loop[i] - centroid, next - centroid), normal) <= 0) {
      triangles.resize(n_before);
      return false;
    }
    triangles.push_back({centroid, loop[i], next});
  }
  return true;
}

/// Whether a corner is convex and its triangle holds no other point of the loop.
bool is_ear(std::span<const glm::dvec3> loop, const std::vector<std::size_t>& left, std::size_t at,
            const glm::dvec3& normal) {
  const std::size_t n = left.size();
  const std::array<std::size_t, 3> corners = {left[(at + n - 1) % n], left[at], left[(at + 1) % n]};
  const auto turns_left = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(glm::cross(b - a, c - a), normal) > 0;
  };
  if (!turns_left(loop[corners[0]], loop[corners[1]], loop[corners[2]])) {
    return false;
  }
  return std::none_of(left.begin(), left.end(), [&](std::size_t i) {
    if (std::find(corners.begin(), corners.end(), i) != corners.end()) {
      return false;
    }
    return !turns_left(loop[corners[1]], loop[corners[0]], loop[i]) &&
           !turns_left(loop[corners[2]], loop[corners[1]], loop[i]) &&
           !turns_left(loop[corners[0]], loop[corners[2]], loop[i]);
  });
}

/// Cuts ears until a triangle is left; false if the loop runs out of ears.
bool append_ears(std::span<const glm::dvec3> loop, const glm::dvec3& normal,
                 std::vector<Triangle>& triangles) {
  const std::size_t n_before = triangles.size();
  std::vector<std::size_t> left(loop.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  while (left.size() > 3) {
    std::size_t at = 0;
    while (at < left.size() && !is_ear(loop, left, at, normal)) {
      ++at;
    }
    if (at == left.size()) {
      triangles.resize(n_before);
      return false;
    }
    const std::size_t n = left.size();
    triangles.push_back({loop[left[(at + n - 1) % n]], loop[left[at]], loop[left[(at + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.push_back({loop[left[0]], loop[left[1]], loop[left[2]]});
  return true;
}

}  // namespace

glm::dvec3 area_vector(std::span<const glm::dvec3> loop) {
  glm::dvec3 normal(0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    normal += glm::cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  }
  return normal;
}

void append_face_triangles(std::span<const glm::dvec3> loop, std::vector<Triangle>& triangles) {
  if (loop.size() == 3) {
    triangles.push_back({loop[0], loop[1], loop[2]});
    return;
  }
  const glm::dvec3 normal = area_vector(loop);
  if (append_fan(loop, normal, false, triangles) ||
      (loop.size() <= kLargestConcaveLoop && append_ears(loop, normal, triangles))) {
    return;
  }
  append_fan(loop, normal, true, triangles);
}

double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? glm::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(point - a - t * along);
}

double distance_to_triangle(const glm::dvec3& point, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  const auto is_left = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, point - from), normal) >= 0;
  };
  if (length > 0 && is_left(a, b) && is_left(b, c) && is_left(c, a)) {
    return std::abs(glm::dot(point - a, normal)) / length;
  }
  return std::min({distance_to_segment(point, a, b), distance_to_segment(point, b, c),
                   distance_to_segment(point, c, a)});
}

double half_angle(const glm::dvec3& point, const Triangle& triangle) {
  const glm::dvec3 a = triangle[0] - point;
  const glm::dvec3 b = triangle[1] - point;
  const glm::dvec3 c = triangle[2] - point;
  const double length_a = glm::length(a);
  const double length_b = glm::length(b);
  const double length_c = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  return std::atan2(volume, length_a * length_b * length_c + glm::dot(a, b) * length_c +
                                glm::dot(b, c) * length_a + glm::dot(c, a) * length_b);
}

}  // namespace espalier
