#include "lattice/tensor/flatness.h"

#include <glm/geometric.hpp>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// Of the extent along the other directions; more than round-off, far less than any use.
constexpr double kFlat = 1e-13;

/// The largest vector of those from the first point, as `part` sees them.
template <class Part>
glm::dvec3 largest(std::span<const glm::dvec3> points, const Part& part) {
  glm::dvec3 result(0);
  for (const glm::dvec3& point : points) {
    const glm::dvec3 vector = part(point - points.front());
    if (glm::dot(vector, vector) > glm::dot(result, result)) {
      result = vector;
    }
  }
  return result;
}

}  // namespace

void require_thickness(std::span<const glm::dvec3> points) {
  if (points.empty()) {
    return;
  }
  const glm::dvec3 first = largest(points, [](const glm::dvec3& v) { return v; });
  const double length = glm::length(first);
  const glm::dvec3 along = length > 0 ? first / length : first;
  const glm::dvec3 second =
      largest(points, [&](const glm::dvec3& v) { return v - glm::dot(v, along) * along; });
  const double width = glm::length(second);
  const glm::dvec3 normal = glm::cross(along, width > 0 ? second / width : second);
  const glm::dvec3 third =
      largest(points, [&](const glm::dvec3& v) { return glm::dot(v, normal) * normal; });
  if (!(width > kFlat * length && glm::length(third) > kFlat * length)) {
    throw LatticeError(
        "the control points at rest all lie in a plane: the lattice has no thickness and holds "
        "nothing; move some off the plane, or give one control point on an axis");
  }
}

}  // namespace espalier
