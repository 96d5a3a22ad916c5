/// [TW98] G. Thürmer, C. Wüthrich, "Computing vertex normals from polygonal facets", 1998.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "deform/model/normals.h"
#include "deform/model/pairs.h"
#include "lattice/core/disjoint_sets.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

/// Faces at one edge that are compared with each; more is no surface.
constexpr std::size_t kMostAtEdge = 8;

/// Twice the area of a polygon along its mean normal, by Newell's sums about its first point.
glm::dvec3 area_vector(std::span<const glm::dvec3> points, std::span<const std::int32_t> face) {
  glm::dvec3 area(0);
  const glm::dvec3 origin = points[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    area += glm::cross(points[face[i]] - origin, points[face[i + 1]] - origin);
  }
  return area;
}

/// Between the edges that leave corner i, 0 if one has no length.
double corner_angle(std::span<const glm::dvec3> points, std::span<const std::int32_t> face,
                    std::size_t i) {
  const std::size_t n = face.size();
  const glm::dvec3 a = unit_or_zero(points[face[(i + 1) % n]] - points[face[i]]);
  const glm::dvec3 b = unit_or_zero(points[face[(i + n - 1) % n]] - points[face[i]]);
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The corners of a mesh, and which of them at one point share a normal.
class CornerGroups {
 public:
  CornerGroups(std::span<const glm::dvec3> points, const CompressedRows<std::int32_t>& faces,
               const SharpEdges& sharp)
      : faces_(faces),
        sharp_(sharp),
        least_cosine_(std::cos(sharp.angle * std::numbers::pi / 180)),
        sets_(faces.n_values()) {
    for (std::size_t face = 0; face < faces.n_rows(); ++face) {
      directions_.push_back(unit_or_zero(area_vector(points, faces[face])));
      faces_of_.insert(faces_of_.end(), faces[face].size(), static_cast<std::int32_t>(face));
    }
  }

  /// Joins the corners of one point over its edges that are not sharp.
  void join(std::span<const std::int32_t> corners) {
    spokes_.clear();
    for (const std::int32_t corner : corners) {
      const auto face = static_cast<std::size_t>(faces_of_[static_cast<std::size_t>(corner)]);
      const std::span<const std::int32_t> loop = faces_[face];
      const std::size_t i = static_cast<std::size_t>(corner) - faces_.offset(face);
      spokes_.push_back({loop[(i + 1) % loop.size()], corner});
      spokes_.push_back({loop[(i + loop.size() - 1) % loop.size()], corner});
    }
    std::sort(spokes_.begin(), spokes_.end());
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      for (std::size_t k = i; k-- > 0 && i - k <= kMostAtEdge;) {
        if (spokes_[k].first != spokes_[i].first) {
          break;
        }
        if (is_smooth(spokes_[k].second, spokes_[i].second)) {
          sets_.join(static_cast<std::size_t>(spokes_[k].second),
                     static_cast<std::size_t>(spokes_[i].second));
        }
      }
    }
  }

  /// The first corner of the group that a corner is in.
  [[nodiscard]] std::size_t first(std::int32_t corner) {
    return sets_.first(static_cast<std::size_t>(corner));
  }

  [[nodiscard]] std::size_t face_of(std::int32_t corner) const {
    return static_cast<std::size_t>(faces_of_[static_cast<std::size_t>(corner)]);
  }
  [[nodiscard]] const glm::dvec3& direction(std::size_t face) const { return directions_[face]; }

 private:
  [[nodiscard]] bool is_smooth(std::int32_t a, std::int32_t b) const {
    const std::size_t face_a = face_of(a);
    const std::size_t face_b = face_of(b);
    if (!sharp_.smoothing_groups.empty()) {
      const std::int64_t group = sharp_.smoothing_groups[face_a];
      return group != 0 && group == sharp_.smoothing_groups[face_b];
    }
    const glm::dvec3& n_a = directions_[face_a];
    const glm::dvec3& n_b = directions_[face_b];
    // A face without area has no say.
    return n_a == glm::dvec3(0) || n_b == glm::dvec3(0) ||
           glm::dot(n_a, n_b) >= least_cosine_ - 1e-12;
  }

  const CompressedRows<std::int32_t>& faces_;
  const SharpEdges& sharp_;
  double least_cosine_;
  DisjointSets sets_;  // of corners
  std::vector<glm::dvec3> directions_;
  std::vector<std::int32_t> faces_of_;
  std::vector<std::pair<std::int32_t, std::int32_t>> spokes_;  // the other end of an edge, a corner
};

}  // namespace

CornerNormals corner_normals(std::span<const glm::dvec3> points,
                             const CompressedRows<std::int32_t>& faces, const SharpEdges& sharp) {
  CornerNormals result;
  result.of_corners.assign(faces.n_values(), -1);
  CornerGroups groups(points, faces, sharp);
  const CompressedRows<std::int32_t> corners_of = rows_by_key(faces.values(), points.size());
  for (std::size_t point = 0; point < points.size(); ++point) {
    groups.join(corners_of[point]);
    for (const std::int32_t corner : corners_of[point]) {
      std::int32_t& normal = result.of_corners[groups.first(corner)];
      if (normal < 0) {
        normal = static_cast<std::int32_t>(result.normals.size());
        result.points.push_back(static_cast<std::int32_t>(point));
        result.normals.emplace_back(0);
      }
      result.of_corners[static_cast<std::size_t>(corner)] = normal;
      const std::size_t face = groups.face_of(corner);
      result.normals[static_cast<std::size_t>(normal)] +=
          corner_angle(points, faces[face], static_cast<std::size_t>(corner) - faces.offset(face)) *
          groups.direction(face);
    }
  }
  for (glm::dvec3& normal : result.normals) {
    normal = unit_or_zero(normal);
    normal = normal == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : normal;
  }
  return result;
}

std::vector<std::int64_t> smoothing_groups(const Model& model) {
  std::vector<std::int64_t> groups;
  if (model.format() != ModelFormat::Obj) {
    return groups;
  }
  TextScanner scanner(model.path(), model.bytes(), {.comment = '#', .joins_lines = true});
  std::int64_t group = 0;
  bool has_groups = false;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.next_word();
    if (keyword == "s") {
      has_groups = true;
      group = 0;
      (void)parse_integer(scanner.next_word(), group);  // "off" is none
    } else if (keyword == "f" || keyword == "fo") {
      groups.push_back(group);
    }
  }
  groups.resize(has_groups ? model.faces().n_rows() : 0);
  return groups;
}

}  // namespace espalier
