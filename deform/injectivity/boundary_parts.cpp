#include "deform/injectivity/boundary_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "lattice/core/box.h"
#include "lattice/core/disjoint_sets.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {
namespace {

constexpr int kMostCuts = 16;
constexpr int kFineness = 4;  // quadrilaterals a side that a face's volume is summed over

/// Solid angle of a face seen from a point outside its hull; a face whose hull holds the point is
/// cut first. None if the point is too near.
std::optional<double> angle_of_face(const FaceNet& net, const glm::dvec3& from, int n_cuts = 0) {
  std::vector<glm::dvec3> points;
  net.positions(points);
  if (box_of(points).contains(from)) {
    if (n_cuts == kMostCuts) {
      return std::nullopt;
    }
    double sum = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const glm::dvec2 low = 0.5 * glm::dvec2(quarter & 1, quarter >> 1);
      const auto part = angle_of_face(net.part({low, low + 0.5}), from, n_cuts + 1);
      if (!part) {
        return std::nullopt;
      }
      sum += *part;
    }
    return sum;
  }
  const auto n = static_cast<std::size_t>(net.degree(0));
  const glm::dvec3& p01 = points[points.size() - 1 - n];
  return solid_angle(from, {points.front(), points[n], points.back()}) +
         solid_angle(from, {points.front(), points.back(), p01});
}

/// 1 if ∂s × ∂t points out of the volume, else −1.
double outward_sign(const BoundaryFaceId& id, bool is_mirrored) {
  const bool is_high = id.face % 2 == 1;
  const bool is_odd = id.face / 2 == 1;  // u × w = −v
  return (is_high != is_odd) != is_mirrored ? 1 : -1;
}

/// Six times the volume under a face, seen from a point.
double volume_under(const FaceNet& net, const glm::dvec3& from) {
  const auto at = [&](int i, int j) {
    return net.value(glm::dvec2(i, j) / static_cast<double>(kFineness)) - from;
  };
  double sum = 0;
  for (int j = 0; j < kFineness; ++j) {
    for (int i = 0; i < kFineness; ++i) {
      const glm::dvec3 a = at(i, j);
      const glm::dvec3 c = at(i + 1, j + 1);
      sum += glm::dot(a, glm::cross(at(i + 1, j), c)) + glm::dot(a, glm::cross(c, at(i, j + 1)));
    }
  }
  return sum;
}

}  // namespace

std::vector<std::int32_t> boundary_parts(const BoundaryMesh& mesh) {
  DisjointSets sets(mesh.faces.size());
  std::vector<std::vector<std::size_t>> faces_of_seam;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    for (const SeamUse& use : mesh.seams[face]) {
      const auto seam = static_cast<std::size_t>(use.seam);
      faces_of_seam.resize(std::max(faces_of_seam.size(), seam + 1));
      faces_of_seam[seam].push_back(face);
    }
  }
  for (const std::vector<std::size_t>& faces : faces_of_seam) {
    if (faces.size() == 2) {
      sets.join(faces[0], faces[1]);
    }
  }
  std::vector<std::int32_t> numbers(mesh.faces.size(), -1);
  std::vector<std::int32_t> parts;
  std::int32_t n_parts = 0;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    std::int32_t& number = numbers[sets.first(face)];
    number = number < 0 ? n_parts++ : number;
    parts.push_back(number);
  }
  return parts;
}

bool is_covered_once(const BoundaryMesh& mesh, std::span<const std::int32_t> parts,
                     bool is_mirrored) {
  const std::size_t n_faces = mesh.faces.size();
  const std::int32_t n_parts =
      parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end()) + 1;
  if (n_parts <= 1) {
    return true;  // what is covered outside of it is covered nowhere
  }
  for (std::int32_t part = 0; part < n_parts; ++part) {
    const auto first =
        static_cast<std::size_t>(std::find(parts.begin(), parts.end(), part) - parts.begin());
    const glm::dvec3 from = mesh.pose[first].value({0.5, 0.5});
    double own_volume = 0;
    double angle = 0;  // of the other parts
    Box box;
    for (std::size_t face = 0; face < n_faces; ++face) {
      const double sign = outward_sign(mesh.faces[face], is_mirrored);
      if (parts[face] == part) {
        own_volume += sign * volume_under(mesh.pose[face], from);
        box.add(mesh.pose[face].value({0.5, 0.5}));
      } else if (const auto seen = angle_of_face(mesh.pose[face], from)) {
        angle += sign * *seen;
      } else {
        return false;
      }
    }
    const double windings = angle / (4 * std::numbers::pi);
    const double beyond = std::round(windings);  // how often the one side is covered
    const double radius = box.radius();
    const bool is_certain =
        std::abs(windings - beyond) < 0.2 && std::abs(own_volume) > 1e-6 * radius * radius * radius;
    if (!is_certain || beyond != (own_volume > 0 ? 0 : 1)) {
      return false;
    }
  }
  return true;
}

}  // namespace espalier
