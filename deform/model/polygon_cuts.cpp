#include "deform/model/polygon_cuts.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "lattice/topology/face_triangles.h"

namespace espalier {
namespace {

double height(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
              const glm::dvec3& normal) {
  return glm::dot(glm::cross(b - a, c - a), normal);
}

/// How well a corner is shaped as an ear: its area, negative where it is no ear.
double ear_quality(std::span<const glm::dvec3> loop, const std::vector<std::size_t>& left,
                   std::size_t i, const glm::dvec3& normal) {
  const std::size_t n = left.size();
  const glm::dvec3& a = loop[left[(i + n - 1) % n]];
  const glm::dvec3& b = loop[left[i]];
  const glm::dvec3& c = loop[left[(i + 1) % n]];
  const double area = height(a, b, c, normal);
  for (std::size_t k = 0; k < n && area > 0; ++k) {
    const glm::dvec3& p = loop[left[k]];
    const bool is_own = p == a || p == b || p == c;
    if (!is_own && height(a, b, p, normal) >= 0 && height(b, c, p, normal) >= 0 &&
        height(c, a, p, normal) >= 0) {
      return -1;
    }
  }
  const double longest =
      std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  return longest > 0 ? area / longest : 0;
}

}  // namespace

bool is_seen_from_middle(std::span<const glm::dvec3> loop) {
  const glm::dvec3 normal = area_vector(loop);
  glm::dvec3 middle(0);
  for (const glm::dvec3& p : loop) {
    middle += p / static_cast<double>(loop.size());
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (height(middle, loop[i], loop[(i + 1) % loop.size()], normal) < 0) {
      return false;
    }
  }
  return true;
}

std::vector<std::array<std::size_t, 3>> ear_triangles(std::span<const glm::dvec3> loop) {
  const glm::dvec3 normal = area_vector(loop);
  std::vector<std::size_t> left(loop.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = i;
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  while (left.size() > 3) {
    std::size_t best = 0;
    double most = -2;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (const double quality = ear_quality(loop, left, i, normal); quality > most) {
        most = quality;
        best = i;
      }
    }
    const std::size_t n = left.size();
    triangles.push_back({left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace espalier
