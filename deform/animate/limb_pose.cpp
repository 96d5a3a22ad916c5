// Maps of space for limbs, after [B84].

#include "deform/animate/limb_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "lattice/build/offsets.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A unit vector along `vector`.
glm::dvec3 direction(const glm::dvec3& vector, const std::string& name) {
  const glm::dvec3 unit = is_finite(vector) ? unit_vector(vector) : glm::dvec3(0);
  if (unit == glm::dvec3(0)) {
    throw ParameterError("'" + name + "' must be finite and not zero");
  }
  return unit;
}

/// In radians.
double angle_of(double degrees) {
  if (!std::isfinite(degrees)) {
    throw ParameterError("'angle' must be finite");
  }
  return glm::radians(degrees);
}

/// A unit vector from one joint to the other, and the length between.
struct Axis {
  glm::dvec3 along;
  double length;
};

Axis axis_of(const Bone& bone) {
  if (!is_finite(bone.from) || !is_finite(bone.to) || bone.from == bone.to) {
    throw ParameterError("'from' and 'to' must be finite and differ");
  }
  return {unit_vector(bone.to - bone.from), glm::distance(bone.from, bone.to)};
}

void check(const LimbRegion& region) {
  if (!is_finite(region.joint) || !is_finite(region.along)) {
    throw ParameterError("'about' and 'along' must be finite");
  }
  if (!(region.falloff >= 0) || !std::isfinite(region.falloff)) {
    throw ParameterError("'falloff' must be a length, 0 or more");
  }
}

/// `v` turned about a unit vector, by Rodrigues' formula.
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double cosine = std::cos(angle);
  return v * cosine + glm::cross(axis, v) * std::sin(angle) +
         axis * (glm::dot(axis, v) * (1 - cosine));
}

/// What is not displaced keeps its bits, those of -0 too.
glm::dvec3 displaced(const glm::dvec3& x, const glm::dvec3& by) {
  return by == glm::dvec3(0) ? x : x + by;
}

template <class Map>
std::vector<glm::dvec3> mapped(std::span<const glm::dvec3> points, const Map& map) {
  std::vector<glm::dvec3> result;
  result.reserve(points.size());
  std::transform(points.begin(), points.end(), std::back_inserter(result), map);
  return result;
}

}  // namespace

double LimbRegion::weight(const glm::dvec3& x) const {
  if (along == glm::dvec3(0)) {
    return 1;
  }
  const double s = glm::dot(x - joint, unit_vector(along));
  if (falloff == 0) {
    return s >= 0 ? 1 : 0;
  }
  const double tau = std::clamp(s / falloff + 0.5, 0.0, 1.0);
  return tau * tau * (3 - 2 * tau);
}

std::vector<glm::dvec3> turned(std::span<const glm::dvec3> points, const LimbRegion& region,
                               const glm::dvec3& axis, double degrees) {
  check(region);
  const glm::dvec3 about = direction(axis, "axis");
  const double whole = angle_of(degrees);
  return mapped(points, [&](const glm::dvec3& x) {
    const double angle = whole * region.weight(x);
    return angle == 0 ? x : region.joint + rotated(x - region.joint, about, angle);
  });
}

std::vector<glm::dvec3> scaled(std::span<const glm::dvec3> points, const LimbRegion& region,
                               const glm::dvec3& factors) {
  check(region);
  if (!is_finite(factors) || !(factors.x > 0 && factors.y > 0 && factors.z > 0)) {
    throw ParameterError("'scale' must be positive factors");
  }
  return mapped(points, [&](const glm::dvec3& x) {
    return displaced(x, region.weight(x) * (factors - 1.0) * (x - region.joint));
  });
}

std::vector<glm::dvec3> moved(std::span<const glm::dvec3> points, const LimbRegion& region,
                              const glm::dvec3& by) {
  check(region);
  if (!is_finite(by)) {
    throw ParameterError("'by' must be finite");
  }
  return mapped(points, [&](const glm::dvec3& x) { return displaced(x, region.weight(x) * by); });
}

std::vector<glm::dvec3> twisted(std::span<const glm::dvec3> points, const Bone& bone,
                                double degrees) {
  const Axis axis = axis_of(bone);
  const double whole = angle_of(degrees);
  return mapped(points, [&](const glm::dvec3& x) {
    const double s = glm::dot(x - bone.from, axis.along);
    const double angle = whole * std::clamp(s / axis.length, 0.0, 1.0);
    return angle == 0 ? x : bone.from + rotated(x - bone.from, axis.along, angle);
  });
}

std::vector<glm::dvec3> bent(std::span<const glm::dvec3> points, const Bone& bone,
                             const glm::dvec3& towards, double degrees) {
  const Axis axis = axis_of(bone);
  const glm::dvec3 towards_unit = direction(towards, "towards");
  const glm::dvec3 across = towards_unit - axis.along * glm::dot(towards_unit, axis.along);
  if (!(glm::length(across) > 1e-9)) {
    throw ParameterError("'towards' must not run along the limb");
  }
  const glm::dvec3 side = unit_vector(across);
  const double whole = angle_of(degrees);
  return mapped(points, [&](const glm::dvec3& x) {
    const glm::dvec3 offset = x - bone.from;
    const double s = glm::dot(offset, axis.along);
    const double on_bone = std::clamp(s, 0.0, axis.length);
    const double angle = whole * (on_bone / axis.length);
    if (angle == 0) {
      return x;
    }
    // The chord of an arc of this length halves its angle.
    const double chord = on_bone * std::sin(angle / 2) / (angle / 2);
    const glm::dvec3 foot = chord * (axis.along * std::cos(angle / 2) + side * std::sin(angle / 2));
    const glm::dvec3 along = axis.along * std::cos(angle) + side * std::sin(angle);
    const glm::dvec3 inward = side * std::cos(angle) - axis.along * std::sin(angle);
    const double h = glm::dot(offset, side);
    const glm::dvec3 out_of_plane = offset - axis.along * s - side * h;
    return bone.from + foot + along * (s - on_bone) + inward * h + out_of_plane;
  });
}

std::vector<glm::dvec3> tapered(std::span<const glm::dvec3> points, const Bone& bone,
                                double scale) {
  const Axis axis = axis_of(bone);
  if (!(scale > 0) || !std::isfinite(scale)) {
    throw ParameterError("'scale' must be positive");
  }
  return mapped(points, [&](const glm::dvec3& x) {
    const glm::dvec3 offset = x - bone.from;
    const double s = glm::dot(offset, axis.along);
    const double weight = std::clamp(s / axis.length, 0.0, 1.0);
    return displaced(x, (scale - 1) * weight * (offset - axis.along * s));
  });
}

double cut_radius(std::span<const glm::dvec3> points,
                  std::span<const std::array<std::int32_t, 2>> net, const glm::dvec3& joint,
                  const glm::dvec3& along) {
  const glm::dvec3 normal = direction(along, "along");
  double radius = 0;
  for (const auto& [first, second] : net) {
    const glm::dvec3 a = points[static_cast<std::size_t>(first)] - joint;
    const glm::dvec3 b = points[static_cast<std::size_t>(second)] - joint;
    const double height_a = glm::dot(a, normal);
    const double height_b = glm::dot(b, normal);
    if (height_a * height_b <= 0 && height_a != height_b) {
      const double t = height_a / (height_a - height_b);
      radius = std::max(radius, glm::length(a + t * (b - a)));
    }
  }
  return radius;
}

}  // namespace espalier
