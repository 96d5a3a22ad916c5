#include "viewer/render/polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace espalier::viewer {
namespace {

/// Twice the signed area of a triangle in the plane.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The loop seen along the axis its normal is closest to, counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> loop) {
  const glm::dvec3 normal = area_vector(loop);
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    axis = std::abs(normal[i]) > std::abs(normal[axis]) ? i : axis;
  }
  const int first = (axis + 1) % 3;
  const int second = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<glm::dvec2> flat;
  flat.reserve(loop.size());
  for (const glm::dvec3& point : loop) {
    flat.emplace_back(point[first] - loop[0][first], sign * (point[second] - loop[0][second]));
  }
  return flat;
}

/// Every corner turns left. A loop that winds around twice does so too, but is no simple polygon.
bool is_convex(const std::vector<glm::dvec2>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) <= 0) {
      return false;
    }
  }
  return true;
}

/// Clips triangles off the loop until one is left.
class EarClipper {
 public:
  explicit EarClipper(std::vector<glm::dvec2> flat) : flat_(std::move(flat)) {
    for (std::uint32_t i = 0; i < flat_.size(); ++i) {
      left_.push_back(i);
    }
  }

  void clip_all(std::vector<std::uint32_t>& triangles) {
    std::size_t at = 0;
    while (left_.size() > 3) {
      at = next_ear(at);
      clip(at, triangles);
      at = at % left_.size();
    }
    triangles.insert(triangles.end(), left_.begin(), left_.end());
  }

 private:
  [[nodiscard]] std::uint32_t before(std::size_t i) const {
    return left_[(i + left_.size() - 1) % left_.size()];
  }
  [[nodiscard]] std::uint32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }

  void clip(std::size_t ear, std::vector<std::uint32_t>& triangles) {
    triangles.insert(triangles.end(), {before(ear), left_[ear], after(ear)});
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
  }

  /// The first ear from place `start` on. A loop without one crosses itself: any corner serves.
  [[nodiscard]] std::size_t next_ear(std::size_t start) const {
    for (std::size_t step = 0; step < left_.size(); ++step) {
      const std::size_t i = (start + step) % left_.size();
      if (is_ear(i)) {
        return i;
      }
    }
    return start;
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    const glm::dvec2& a = flat_[before(i)];
    const glm::dvec2& b = flat_[left_[i]];
    const glm::dvec2& c = flat_[after(i)];
    if (turn(a, b, c) <= 0) {
      return false;
    }
    return std::none_of(left_.begin(), left_.end(), [&](std::uint32_t other) {
      const glm::dvec2& p = flat_[other];
      // Corners at one place with the triangle's own (a bridge to a hole) do not block it.
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
             turn(c, a, p) >= 0;
    });
  }

  std::vector<glm::dvec2> flat_;
  std::vector<std::uint32_t> left_;
};

/// Two triangles, cut along the shorter diagonal if both are inside.
void triangulate_quad(std::span<const glm::dvec3> loop, std::vector<std::uint32_t>& triangles) {
  const glm::dvec3 normal = area_vector(loop);
  const auto faces_normal = [&](int a, int b, int c) {
    return glm::dot(glm::cross(loop[b] - loop[a], loop[c] - loop[a]), normal) > 0;
  };
  const bool first_is_inside = faces_normal(0, 1, 2) && faces_normal(0, 2, 3);
  const bool second_is_inside = faces_normal(0, 1, 3) && faces_normal(1, 2, 3);
  const bool first_is_shorter =
      glm::length(loop[2] - loop[0]) <= glm::length(loop[3] - loop[1]) * (1 + 1e-9);
  const bool cut_first = first_is_inside == second_is_inside ? first_is_shorter : first_is_inside;
  if (cut_first) {
    triangles.insert(triangles.end(), {0, 1, 2, 0, 2, 3});
  } else {
    triangles.insert(triangles.end(), {0, 1, 3, 1, 2, 3});
  }
}

}  // namespace

glm::dvec3 area_vector(std::span<const glm::dvec3> loop) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum += glm::cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  }
  return sum;
}

void triangulate(std::span<const glm::dvec3> loop, std::vector<std::uint32_t>& triangles) {
  if (loop.size() < 3) {
    return;
  }
  if (loop.size() == 3) {
    triangles.insert(triangles.end(), {0, 1, 2});
    return;
  }
  if (loop.size() == 4) {
    triangulate_quad(loop, triangles);
    return;
  }
  std::vector<glm::dvec2> flat = flattened(loop);
  if (is_convex(flat)) {
    for (std::uint32_t i = 2; i < loop.size(); ++i) {
      triangles.insert(triangles.end(), {0, i - 1, i});
    }
    return;
  }
  EarClipper(std::move(flat)).clip_all(triangles);
}

}  // namespace espalier::viewer
