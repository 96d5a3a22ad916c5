#include "deform/embed/fringe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "deform/embed/boundary_face.h"
#include "lattice/core/box_tree.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

/// The search's first radius, as a fraction of the reach; it doubles until something is found.
constexpr double kFirstRadius = 1.0 / 64;

/// A point of the fringe, as it is found.
struct Follower {
  std::int32_t patch = -1;
  glm::dvec3 uvw{0};
  double weight = 0;
  glm::dvec3 weight_slope{0};
  glm::dmat3 uvw_slope{0};
};

double distance(const Box& box, const glm::dvec3& x) {
  return glm::length(glm::max(glm::dvec3(0), glm::max(box.min - x, x - box.max)));
}

/// The boundary of a volume at rest.
class Boundary {
 public:
  explicit Boundary(const Volume& volume) {
    BezierPatch patch;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < volume.n_patches(); ++i) {
      if (volume.patch(i).boundary_faces == 0) {
        continue;
      }
      volume.bezier(i, volume.rest_points(), patch);
      for (int face = 0; face < 6; ++face) {
        if (volume.patch(i).is_on_boundary(face)) {
          faces_.emplace_back(patch, face);
          patches_.push_back(static_cast<std::int32_t>(i));
          boxes.push_back(faces_.back().hull_box());
        }
      }
    }
    tree_ = BoxTree(std::move(boxes));
  }

  /// candidates: memory for the search.
  [[nodiscard]] std::optional<Follower> follower(
      const glm::dvec3& x, double reach,
      std::vector<std::pair<double, std::size_t>>& candidates) const {
    for (double radius = kFirstRadius * reach; radius <= reach; radius *= 2) {
      candidates.clear();
      tree_.visit_overlapping(Box{x, x}.grown(radius), [&](std::size_t face) {
        candidates.emplace_back(distance(tree_.box(face), x), face);
      });
      std::sort(candidates.begin(), candidates.end());
      double least = radius;
      std::optional<std::size_t> best;
      BoundaryFace::Closest closest;
      for (const auto& [bound, face] : candidates) {
        if (bound >= least) {
          break;
        }
        const BoundaryFace::Closest found = faces_[face].closest(x);
        if (found.distance < least) {
          least = found.distance;
          best = face;
          closest = found;
        }
      }
      if (best) {
        return follower(x, reach, *best, closest);
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] Follower follower(const glm::dvec3& x, double reach, std::size_t index,
                                  const BoundaryFace::Closest& closest) const {
    const BoundaryFace& face = faces_[index];
    Follower result;
    result.patch = patches_[index];
    result.uvw = face.uvw(closest.st);
    result.weight = falloff(closest.distance, reach);
    if (closest.distance > 0) {
      const double tau = closest.distance / reach;
      result.weight_slope = -6 * tau * (1 - tau) / (reach * closest.distance) * (x - closest.point);
    }
    for (int k = 0; k < 2; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        result.uvw_slope[axis][face.axes()[static_cast<std::size_t>(k)]] =
            closest.slopes[static_cast<std::size_t>(k)][axis];
      }
    }
    return result;
  }

  std::vector<BoundaryFace> faces_;
  std::vector<std::int32_t> patches_;  // of the faces
  BoxTree tree_;
};

/// Those that follow, sorted by patch, then by point.
Fringe sorted_by_patch(const std::vector<std::int32_t>& points,
                       const std::vector<std::optional<Follower>>& followers) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (followers[i]) {
      order.push_back(i);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return followers[a]->patch < followers[b]->patch;
  });
  Fringe fringe;
  for (const std::size_t i : order) {
    const Follower& follower = *followers[i];
    fringe.points.push_back(points[i]);
    fringe.patches.push_back(follower.patch);
    fringe.uvw.push_back(follower.uvw);
    fringe.weights.push_back(follower.weight);
    fringe.weight_slopes.push_back(follower.weight_slope);
    fringe.uvw_slopes.push_back(follower.uvw_slope);
  }
  return fringe;
}

}  // namespace

double falloff(double distance, double reach) {
  const double tau = std::clamp(distance / reach, 0.0, 1.0);
  return 1 - tau * tau * (3 - 2 * tau);
}

Fringe make_fringe(const Volume& volume, std::span<const glm::dvec3> points,
                   std::span<const PointStatus> status, double reach, const Progress& progress) {
  progress.update("falloff", 0.0);
  std::vector<std::int32_t> outside;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (status[i] == PointStatus::Outside) {
      outside.push_back(static_cast<std::int32_t>(i));
    }
  }
  const Boundary boundary(volume);
  std::vector<std::optional<Follower>> followers(outside.size());
  parallel_ranges(outside.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<double, std::size_t>> candidates;
    for (std::size_t i = begin; i < end; ++i) {
      followers[i] =
          boundary.follower(points[static_cast<std::size_t>(outside[i])], reach, candidates);
    }
  });
  progress.update("falloff", 1.0);
  return sorted_by_patch(outside, followers);
}

}  // namespace espalier
