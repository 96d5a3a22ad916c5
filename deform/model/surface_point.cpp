#include "deform/model/surface_point.h"

#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "lattice/core/box.h"

namespace espalier {
namespace {

using Corners = std::span<const std::int32_t>;

/// The weights of the corners of a triangle whose combination is closest to x.
std::array<double, 3> closest_on_triangle(const glm::dvec3& x, const glm::dvec3& a,
                                          const glm::dvec3& b, const glm::dvec3& c) {
  const auto on_edge = [&x](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 along = to - from;
    const double length2 = glm::dot(along, along);
    return length2 > 0 ? glm::clamp(glm::dot(x - from, along) / length2, 0.0, 1.0) : 0.0;
  };
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area2 = glm::dot(normal, normal);
  if (area2 > 0) {
    const double u = glm::dot(glm::cross(c - b, x - b), normal) / area2;
    const double v = glm::dot(glm::cross(a - c, x - c), normal) / area2;
    if (u >= 0 && v >= 0 && u + v <= 1) {
      return {u, v, 1 - u - v};
    }
  }
  const double ab = on_edge(a, b);
  const double bc = on_edge(b, c);
  const double ca = on_edge(c, a);
  const std::array<std::array<double, 3>, 3> candidates = {
      {{1 - ab, ab, 0}, {0, 1 - bc, bc}, {ca, 0, 1 - ca}}};
  std::array<double, 3> best = candidates[0];
  double least = std::numeric_limits<double>::infinity();
  for (const auto& weights : candidates) {
    const double distance = glm::distance(x, weights[0] * a + weights[1] * b + weights[2] * c);
    if (distance < least) {
      least = distance;
      best = weights;
    }
  }
  return best;
}

/// Finds the closest of many faces.
class ClosestFace {
 public:
  ClosestFace(std::span<const glm::dvec3> points, const glm::dvec3& x) : points_(points), x_(x) {}

  void visit(Corners corners) {
    Box box;
    for (const std::int32_t corner : corners) {
      box.add(at(corner));
    }
    if (glm::distance(x_, glm::clamp(x_, box.min, box.max)) >= least_) {
      return;
    }
    if (corners.size() == 3) {
      const auto weights = closest_on_triangle(x_, at(corners[0]), at(corners[1]), at(corners[2]));
      keep({weights.begin(), weights.end()}, corners);
      return;
    }
    glm::dvec3 mean(0);
    const double part = 1.0 / static_cast<double>(corners.size());
    for (const std::int32_t corner : corners) {
      mean += part * at(corner);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t next = (i + 1) % corners.size();
      const auto on_fan = closest_on_triangle(x_, mean, at(corners[i]), at(corners[next]));
      std::vector<double> weights(corners.size(), on_fan[0] * part);
      weights[i] += on_fan[1];
      weights[next] += on_fan[2];
      keep(weights, corners);
    }
  }

  [[nodiscard]] const SurfacePoint& found() const { return found_; }

 private:
  [[nodiscard]] const glm::dvec3& at(std::int32_t corner) const {
    return points_[static_cast<std::size_t>(corner)];
  }

  void keep(const std::vector<double>& weights, Corners corners) {
    SurfacePoint candidate;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (weights[i] > 0) {
        candidate.corners.push_back({static_cast<std::size_t>(corners[i]), weights[i]});
      }
    }
    const double distance = glm::distance(x_, place_of(candidate, points_));
    if (distance < least_) {
      least_ = distance;
      found_ = std::move(candidate);
    }
  }

  std::span<const glm::dvec3> points_;
  glm::dvec3 x_;
  double least_ = std::numeric_limits<double>::infinity();
  SurfacePoint found_;
};

}  // namespace

glm::dvec3 place_of(const SurfacePoint& point, std::span<const glm::dvec3> points) {
  glm::dvec3 place(0);
  for (const SurfacePoint::Corner& corner : point.corners) {
    place += corner.weight * points[corner.point];
  }
  return place;
}

SurfacePoint closest_surface_point(const Model& model, const glm::dvec3& x) {
  ClosestFace closest(model.points(), x);
  for (std::size_t face = 0; face < model.faces().n_rows(); ++face) {
    closest.visit(model.faces()[face]);
  }
  if (model.faces().n_rows() == 0) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(model.points().size()); ++i) {
      closest.visit({&i, 1});
    }
  }
  return closest.found();
}

}  // namespace espalier
