#include "deform/animate/limb_part.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "lattice/build/offsets.h"
#include "lattice/core/disjoint_sets.h"

namespace espalier {
namespace {

using Net = std::vector<std::array<std::int32_t, 2>>;

void join(std::span<const std::array<std::int32_t, 2>> net, DisjointSets& points) {
  for (const auto& [a, b] : net) {
    points.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
}

/// A net and the plane through a joint.
class CutNet {
 public:
  CutNet(std::span<const glm::dvec3> points, std::span<const std::array<std::int32_t, 2>> net,
         const glm::dvec3& joint, const glm::dvec3& direction)
      : n_points_(points.size()) {
    heights_.reserve(points.size());
    for (const glm::dvec3& point : points) {
      heights_.push_back(glm::dot(point - joint, direction));
    }
    std::vector<std::pair<double, std::array<std::int32_t, 2>>> crossing;
    for (const auto& edge : net) {
      const auto a = static_cast<std::size_t>(edge[0]);
      const auto b = static_cast<std::size_t>(edge[1]);
      if (is_beyond(a) == is_beyond(b)) {
        whole_.push_back(edge);
        continue;
      }
      const double t = heights_[a] / (heights_[a] - heights_[b]);
      crossing.emplace_back(glm::distance(points[a] + t * (points[b] - points[a]), joint), edge);
    }
    std::sort(crossing.begin(), crossing.end());
    for (const auto& [distance, edge] : crossing) {
      distances_.push_back(distance);
      crossing_.push_back(edge);
    }
  }

  [[nodiscard]] bool is_beyond(std::size_t point) const { return heights_[point] >= 0; }
  [[nodiscard]] std::size_t n_crossing() const { return crossing_.size(); }
  /// How far from the joint the first n crossing edges reach.
  [[nodiscard]] double radius(std::size_t n) const { return n == 0 ? 0 : distances_[n - 1]; }

  /// What hangs together without the first n crossing edges.
  [[nodiscard]] DisjointSets without(std::size_t n) const {
    DisjointSets joined(n_points_);
    join(whole_, joined);
    join(std::span(crossing_).subspan(n), joined);
    return joined;
  }

 private:
  std::size_t n_points_;
  std::vector<double> heights_;  // #points, over the plane
  Net whole_;                    // edges that do not cross it
  Net crossing_;                 // those that do, by distance from the joint
  std::vector<double> distances_;
};

/// The point nearest the joint on one side of the plane; #points if there is none.
std::size_t nearest_point(std::span<const glm::dvec3> points, const CutNet& net,
                          const glm::dvec3& joint, bool is_beyond) {
  std::size_t nearest = points.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = glm::distance(points[i], joint);
    if (net.is_beyond(i) == is_beyond && distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

LimbPart limb_part(std::span<const glm::dvec3> points,
                   std::span<const std::array<std::int32_t, 2>> net, const glm::dvec3& joint,
                   const glm::dvec3& along) {
  const glm::dvec3 direction = unit_vector(along);
  const CutNet cut(points, net, joint, direction);
  const std::size_t beyond = nearest_point(points, cut, joint, true);
  const std::size_t before = nearest_point(points, cut, joint, false);
  if (beyond == points.size() || before == points.size()) {
    return {std::vector<double>(points.size(), 1.0), 0, cut.radius(cut.n_crossing())};
  }
  std::size_t too_few = 0;
  std::size_t enough = cut.n_crossing();
  while (too_few < enough) {
    const std::size_t n = (too_few + enough) / 2;
    DisjointSets joined = cut.without(n);
    if (joined.first(beyond) == joined.first(before)) {
      too_few = n + 1;
    } else {
      enough = n;
    }
  }
  LimbPart part{std::vector<double>(points.size(), 0.0), 0, cut.radius(enough)};
  DisjointSets joined = cut.without(enough);
  const std::size_t limb = joined.first(beyond);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (joined.first(i) == limb) {
      part.shares[i] = 1;
      ++part.n_parted;
    } else if (!cut.is_beyond(i) && part.radius > 0) {
      const glm::dvec3 offset = points[i] - joint;
      const double across = glm::length(offset - direction * glm::dot(offset, direction));
      const double t = std::clamp(2 - across / part.radius, 0.0, 1.0);
      part.shares[i] = t * t * (3 - 2 * t);
    }
  }
  return part;
}

}  // namespace espalier
