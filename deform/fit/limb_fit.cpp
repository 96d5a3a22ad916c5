#include "deform/fit/limb_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "deform/fit/chain_place.h"
#include "deform/fit/point_extent.h"
#include "deform/model/volume_change.h"
#include "lattice/build/offsets.h"
#include "lattice/build/section.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

/// Points at the ends of the edges of each point's faces, with repetitions.
CompressedRows<std::int32_t> neighbours(std::size_t n_points,
                                        const CompressedRows<std::int32_t>& faces) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(2 * faces.n_values());
  for (std::size_t f = 0; f < faces.n_rows(); ++f) {
    const auto loop = faces[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t next = loop[(i + 1) % loop.size()];
      edges.emplace_back(loop[i], next);
      edges.emplace_back(next, loop[i]);
    }
  }
  std::sort(edges.begin(), edges.end());
  CompressedRows<std::int32_t> rows;
  std::vector<std::int32_t> row;
  std::size_t at = 0;
  for (std::size_t point = 0; point < n_points; ++point) {
    row.clear();
    for (; at < edges.size() && edges[at].first == static_cast<std::int32_t>(point); ++at) {
      row.push_back(edges[at].second);
    }
    rows.push_back(row);
  }
  return rows;
}

/// Of points, outward; none if the surface is not closed.
std::vector<glm::dvec3> outward_normals(std::span<const glm::dvec3> points,
                                        const CompressedRows<std::int32_t>& faces) {
  if (!is_closed(points, faces)) {
    return {};
  }
  const double sign = signed_volume(points, faces) < 0 ? -1 : 1;
  std::vector<glm::dvec3> normals(points.size(), glm::dvec3(0));
  for (std::size_t f = 0; f < faces.n_rows(); ++f) {
    const glm::dvec3 area = sign * area_vector(points, faces[f]);
    for (const std::int32_t point : faces[f]) {
      normals[static_cast<std::size_t>(point)] += area;
    }
  }
  return normals;
}

struct Ray {
  glm::dvec3 from{0};
  glm::dvec3 along{0};
};

/// How far along the ray it crosses a triangle; infinity if it does not.
double distance_along(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b,
                      const glm::dvec3& c) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const glm::dvec3 across = glm::cross(ray.along, c - a);
  const double determinant = glm::dot(b - a, across);
  if (determinant == 0) {
    return kMiss;
  }
  const double u = glm::dot(ray.from - a, across) / determinant;
  const glm::dvec3 second = glm::cross(ray.from - a, b - a);
  const double v = glm::dot(ray.along, second) / determinant;
  const double distance = glm::dot(c - a, second) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : kMiss;
}

/// The face that a ray meets first, and how far away; -1 if none.
std::pair<std::int32_t, double> first_face(const Ray& ray, std::span<const glm::dvec3> points,
                                           const CompressedRows<std::int32_t>& faces) {
  std::pair<std::int32_t, double> first = {-1, std::numeric_limits<double>::infinity()};
  const auto corner = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
  for (std::size_t f = 0; f < faces.n_rows(); ++f) {
    const auto loop = faces[f];
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const double distance =
          distance_along(ray, corner(loop[0]), corner(loop[i - 1]), corner(loop[i]));
      if (distance < first.second) {
        first = {static_cast<std::int32_t>(f), distance};
      }
    }
  }
  return first;
}

/// Rays from evenly spaced places of a bone, across it to all sides.
std::vector<Ray> rays_across(const glm::dvec3& from, const glm::dvec3& to) {
  constexpr int kPlaces = 6;
  constexpr int kSides = 12;
  const auto [right, up] = plane_across(unit_vector(to - from));
  std::vector<Ray> rays;
  for (int place = 0; place < kPlaces; ++place) {
    for (int side = 0; side < kSides; ++side) {
      const double t = (place + 0.5) / kPlaces;
      const double angle = 2 * std::numbers::pi * side / kSides;
      rays.push_back({from * (1 - t) + to * t, right * std::cos(angle) + up * std::sin(angle)});
    }
  }
  return rays;
}

/// What bones see of a surface across them.
struct Sight {
  std::vector<std::int32_t> points;                        // of the faces seen
  double reach = std::numeric_limits<double>::infinity();  // of the first bone
};

Sight seen_from_bones(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
                      std::span<const glm::dvec3> joints) {
  constexpr double kReach = 2.5;  // of the middle ray's way
  Sight sight;
  for (std::size_t bone = 0; bone + 1 < joints.size(); ++bone) {
    const std::vector<Ray> rays = rays_across(joints[bone], joints[bone + 1]);
    std::vector<std::pair<std::int32_t, double>> seen(rays.size());
    parallel_for(
        rays.size(), [&](std::size_t i) { seen[i] = first_face(rays[i], points, faces); }, 8);
    std::vector<double> distances;
    for (const auto& [face, distance] : seen) {
      if (face >= 0) {
        const auto loop = faces[static_cast<std::size_t>(face)];
        sight.points.insert(sight.points.end(), loop.begin(), loop.end());
        distances.push_back(distance);
      }
    }
    if (bone == 0 && !distances.empty()) {
      std::sort(distances.begin(), distances.end());
      sight.reach = kReach * distances[distances.size() / 2];
    }
  }
  return sight;
}

/// Of each stretch of each bone the place that is farthest from it.
std::vector<ChainPlace> widest_places(const std::vector<ChainPlace>& places, std::size_t n_joints) {
  constexpr std::size_t kStretches = 8;
  std::vector<std::optional<ChainPlace>> widest(kStretches * (n_joints - 1));
  for (const ChainPlace& place : places) {
    const auto stretch = std::min(kStretches - 1, static_cast<std::size_t>(kStretches * place.t));
    std::optional<ChainPlace>& best = widest[kStretches * place.bone + stretch];
    if (!best || place.distance > best->distance) {
      best = place;
    }
  }
  std::vector<ChainPlace> result;
  for (const std::optional<ChainPlace>& place : widest) {
    if (place) {
      result.push_back(*place);
    }
  }
  return result;
}

/// Radii at the joints whose line along the bones is nearest to the places' distances, in least
/// squares, and as even as that leaves them: a tridiagonal system.
std::vector<double> even_radii(const std::vector<ChainPlace>& places, std::size_t n_joints) {
  constexpr double kEvenness = 1e-3;
  std::vector<double> diagonal(n_joints, 0);
  std::vector<double> beside(n_joints, 0);
  std::vector<double> radii(n_joints, 0);
  const auto add = [&](std::size_t bone, double first, double second, double value, double weight) {
    diagonal[bone] += weight * first * first;
    diagonal[bone + 1] += weight * second * second;
    beside[bone] += weight * first * second;
    radii[bone] += weight * first * value;
    radii[bone + 1] += weight * second * value;
  };
  for (const ChainPlace& place : places) {
    add(place.bone, 1 - place.t, place.t, place.distance, 1);
  }
  for (std::size_t bone = 0; bone + 1 < n_joints; ++bone) {
    add(bone, 1, -1, 0, kEvenness);
  }
  for (std::size_t i = 0; i + 1 < n_joints; ++i) {
    const double factor = beside[i] / diagonal[i];
    diagonal[i + 1] -= factor * beside[i];
    radii[i + 1] -= factor * radii[i];
  }
  for (std::size_t i = n_joints; i-- > 0;) {
    const double next = i + 1 < n_joints ? beside[i] * radii[i + 1] : 0;
    radii[i] = (radii[i] - next) / diagonal[i];
  }
  return radii;
}

/// Raises radii until no place is farther from its bone: where one is, the two radii of the bone by
/// what is least in sum of squares.
void raise(const std::vector<ChainPlace>& places, std::vector<double>& radii) {
  constexpr int kMostSweeps = 100;
  bool has_grown = true;
  for (int sweep = 0; has_grown && sweep < kMostSweeps; ++sweep) {
    has_grown = false;
    for (const auto& [bone, t, distance, beyond] : places) {
      const double missing = distance - (radii[bone] * (1 - t) + radii[bone + 1] * t);
      if (missing > 0) {
        const double step = missing * (1 + 1e-9) / ((1 - t) * (1 - t) + t * t);
        radii[bone] += step * (1 - t);
        radii[bone + 1] += step * t;
        has_grown = true;
      }
    }
  }
}

}  // namespace

std::vector<std::int32_t> limb_points(std::span<const glm::dvec3> points,
                                      const CompressedRows<std::int32_t>& faces,
                                      std::span<const glm::dvec3> joints) {
  const bool is_surface = faces.n_rows() > 0;
  const Sight sight = is_surface ? seen_from_bones(points, faces, joints) : Sight();
  const std::vector<glm::dvec3> normals = outward_normals(points, faces);
  const CompressedRows<std::int32_t> next = neighbours(points.size(), faces);
  std::vector<bool> is_reached(points.size(), false);
  std::vector<std::int32_t> limb;
  std::vector<std::int32_t> open = sight.points;
  if (!is_surface) {
    open.resize(points.size());
    std::iota(open.begin(), open.end(), 0);
  }
  while (!open.empty()) {
    const std::int32_t point = open.back();
    open.pop_back();
    const auto i = static_cast<std::size_t>(point);
    const ChainPlace place = nearest_place(points[i], joints);
    const bool looks_back =
        !normals.empty() && glm::dot(normals[i], points[i] - foot_of(place, joints)) < 0;
    if (is_reached[i] || place.beyond > 0 || looks_back ||
        (place.bone == 0 && place.distance > sight.reach)) {
      continue;
    }
    is_reached[i] = true;
    limb.push_back(point);
    open.insert(open.end(), next[i].begin(), next[i].end());
  }
  std::sort(limb.begin(), limb.end());
  return limb;
}

std::size_t count_beyond_ends(std::span<const glm::dvec3> points,
                              std::span<const glm::dvec3> joints) {
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](auto& point) {
    return nearest_place(point, joints).beyond > 0;
  }));
}

std::vector<double> limb_radii(std::span<const glm::dvec3> points,
                               std::span<const glm::dvec3> joints, double margin) {
  constexpr double kThinnestNeighbour = 0.25;
  const double thinnest = margin + kThinnestFit * extent_of(joints) / 2;
  std::vector<ChainPlace> places;
  places.reserve(points.size());
  for (const glm::dvec3& point : points) {
    places.push_back(nearest_place(point, joints));
    places.back().distance += margin;
  }
  std::vector<double> radii = even_radii(widest_places(places, joints.size()), joints.size());
  for (double& radius : radii) {
    radius = std::max(radius, thinnest);
  }
  raise(places, radii);
  for (std::size_t i = 1; i < radii.size(); ++i) {
    radii[i] = std::max(radii[i], kThinnestNeighbour * radii[i - 1]);
  }
  for (std::size_t i = radii.size() - 1; i > 0; --i) {
    radii[i - 1] = std::max(radii[i - 1], kThinnestNeighbour * radii[i]);
  }
  return radii;
}

std::vector<glm::dvec3> moved_off_bones(std::span<const glm::dvec3> points,
                                        std::span<const glm::dvec3> joints, double distance) {
  std::vector<glm::dvec3> moved;
  moved.reserve(points.size());
  for (const glm::dvec3& point : points) {
    const ChainPlace place = nearest_place(point, joints);
    const glm::dvec3 bone = unit_vector(joints[place.bone + 1] - joints[place.bone]);
    const glm::dvec3 away = unit_vector(point - foot_of(place, joints));
    moved.push_back(point + distance * (away == glm::dvec3(0) ? plane_across(bone)[0] : away));
  }
  return moved;
}

}  // namespace espalier
