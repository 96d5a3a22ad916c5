#include "viewer/interact/picking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "lattice/topology/face_triangles.h"

namespace espalier::viewer {
namespace {

constexpr double kReach = 12;
constexpr double kMiddleReach = 40;

glm::dvec3 middle(const PickTarget& target, std::int32_t element) {
  const std::vector<std::int32_t> vertices = target.lattice.vertices(target.kind, element);
  glm::dvec3 sum(0.0);
  for (const std::int32_t vertex : vertices) {
    sum += target.points[static_cast<std::size_t>(vertex)];
  }
  return sum / static_cast<double>(vertices.size());
}

/// Whether a segment crosses a triangle away from its own ends.
bool crosses(const glm::dvec3& from, const glm::dvec3& to, const Triangle& triangle) {
  const glm::dmat3 system(from - to, triangle[1] - triangle[0], triangle[2] - triangle[0]);
  if (glm::determinant(system) == 0) {
    return false;
  }
  const glm::dvec3 solution = glm::inverse(system) * (from - triangle[0]);
  constexpr double kEnd = 1e-6;
  return solution.x > kEnd && solution.x < 1 - kEnd && solution.y >= -kEnd && solution.z >= -kEnd &&
         solution.y + solution.z <= 1 + kEnd;
}

/// Whether an outer face stands between the eye and a point.
bool is_hidden(const View& view, const PickTarget& target, const glm::dvec3& point) {
  const glm::dvec3 eye = view.eye_before(point);
  std::vector<glm::dvec3> loop;
  std::vector<Triangle> triangles;
  for (std::size_t face = 0; face < target.lattice.faces.n_rows(); ++face) {
    if (!target.lattice.is_outer[face] || !target.has(ElementKind::Face, face)) {
      continue;
    }
    loop.clear();
    triangles.clear();
    for (const std::int32_t vertex : target.lattice.faces[face]) {
      loop.push_back(target.points[static_cast<std::size_t>(vertex)]);
    }
    append_face_triangles(loop, triangles);
    if (std::any_of(triangles.begin(), triangles.end(),
                    [&](const Triangle& triangle) { return crosses(eye, point, triangle); })) {
      return true;
    }
  }
  return false;
}

/// The place of an element that is nearest to a pixel, in pixels and depth.
glm::dvec3 nearest_place(const View& view, const PickTarget& target, std::int32_t element,
                         const glm::dvec2& pixel) {
  if (target.kind != ElementKind::Edge) {
    return view.project(middle(target, element));
  }
  const auto ends = target.lattice.edges[static_cast<std::size_t>(element)];
  const glm::dvec3 a = view.project(target.points[static_cast<std::size_t>(ends[0])]);
  const glm::dvec3 b = view.project(target.points[static_cast<std::size_t>(ends[1])]);
  const glm::dvec2 along = glm::dvec2(b) - glm::dvec2(a);
  const double length = glm::dot(along, along);
  const double t = length > 0 ? glm::dot(pixel - glm::dvec2(a), along) / length : 0.5;
  return glm::mix(a, b, std::clamp(t, 0.0, 1.0));
}

/// Whether a pixel is inside the picture of a face.
bool covers(const View& view, const PickTarget& target, std::int32_t face,
            const glm::dvec2& pixel) {
  const auto loop = target.lattice.faces[static_cast<std::size_t>(face)];
  bool is_inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3 a = view.project(target.points[static_cast<std::size_t>(loop[i])]);
    const glm::dvec3 b =
        view.project(target.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])]);
    if (!(a.z > 0 && b.z > 0)) {
      return false;
    }
    if ((a.y > pixel.y) != (b.y > pixel.y) &&
        pixel.x < a.x + (b.x - a.x) * (pixel.y - a.y) / (b.y - a.y)) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

}  // namespace

std::optional<std::int32_t> pick(const View& view, const PickTarget& target,
                                 const glm::dvec2& pixel) {
  const bool is_thin = target.kind == ElementKind::Vertex || target.kind == ElementKind::Edge;
  double best = is_thin ? kReach : kMiddleReach;
  double best_depth = 0;
  std::optional<std::int32_t> found;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(target.lattice.count(target.kind)); ++i) {
    if (!target.has(target.kind, static_cast<std::size_t>(i))) {
      continue;
    }
    const glm::dvec3 place = nearest_place(view, target, i, pixel);
    const bool is_covered = target.kind == ElementKind::Face && covers(view, target, i, pixel);
    const double distance = is_covered ? 0 : glm::length(glm::dvec2(place) - pixel);
    constexpr double kSame = 0.5;  // pixels
    const bool is_better =
        distance < best - kSame || (distance <= best + kSame && (!found || place.z < best_depth));
    if (place.z > 0 && distance <= (is_thin ? kReach : kMiddleReach) && is_better &&
        (target.is_through || !is_hidden(view, target, middle(target, i)))) {
      best = distance;
      best_depth = place.z;
      found = i;
    }
  }
  return found;
}

Selection pick_box(const View& view, const PickTarget& target, const glm::dvec2& from,
                   const glm::dvec2& to) {
  const glm::dvec2 low = glm::min(from, to);
  const glm::dvec2 high = glm::max(from, to);
  Selection found;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(target.lattice.count(target.kind)); ++i) {
    const glm::dvec3 point = middle(target, i);
    const glm::dvec3 place = view.project(point);
    if (target.has(target.kind, static_cast<std::size_t>(i)) && place.z > 0 && place.x >= low.x &&
        place.x <= high.x && place.y >= low.y && place.y <= high.y &&
        (target.is_through || !is_hidden(view, target, point))) {
      found.insert(i);
    }
  }
  return found;
}

}  // namespace espalier::viewer
