// [CC78] E. Catmull, J. Clark, "Recursively generated B-spline surfaces on arbitrary topological
// meshes", 1978. [L87] C. Loop, "Smooth subdivision surfaces based on triangles", 1987.

#include "deform/model/dense_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <unordered_map>
#include <utility>

#include "deform/model/mesh_edges.h"
#include "deform/model/normals.h"
#include "deform/model/polygon_cuts.h"
#include "lattice/core/error.h"
#include "lattice/osd/refine_values.h"
#include "lattice/topology/face_triangles.h"

namespace espalier {
namespace {

constexpr int kMostRounds = 60;
constexpr std::size_t kMostCorners = 2000;  // of a polygon

double longest_edge(const DenseMesh& mesh) {
  double longest = 0;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const auto loop = mesh.faces[face];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t next = loop[(i + 1) % loop.size()].point;
      longest =
          std::max(longest, glm::distance(mesh.points[static_cast<std::size_t>(loop[i].point)],
                                          mesh.points[static_cast<std::size_t>(next)]));
    }
  }
  return longest;
}

[[noreturn]] void refuse_growth(double n_faces, double longest, double longest_now) {
  throw ParameterError(fmt::format(
      "densify: edges of at most {} would take {:.3g} faces or more, the limit is {:.3g}; the "
      "longest edge is {:.4g}: give a larger length",
      longest, n_faces, kMostDenseFaces, longest_now));
}

/// Faces that the result surely has: a triangle with sides of at most h has an area of at most
/// √3/4 h², and a quadrilateral h².
double least_faces(const DenseMesh& mesh, double longest) {
  double area = 0;
  std::vector<glm::dvec3> loop;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    loop.clear();
    for (const DenseCorner& corner : mesh.faces[face]) {
      loop.push_back(mesh.points[static_cast<std::size_t>(corner.point)]);
    }
    area += 0.5 * glm::length(area_vector(loop));
  }
  return area / (longest * longest);
}

void check(const DenseMesh& mesh, DensifyMethod method, double longest) {
  if (!(longest > 0)) {
    throw ParameterError(fmt::format("densify: the length is {}, must be positive", longest));
  }
  std::vector<std::int32_t> loop;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    if (method == DensifyMethod::Loop && mesh.faces[face].size() != 3) {
      throw ParameterError(fmt::format(
          "densify: face {} has {} corners, Loop's method is for triangles: use catmull-clark",
          face, mesh.faces[face].size()));
    }
    if (mesh.faces[face].size() > kMostCorners) {
      throw ParameterError(fmt::format("densify: face {} has {} corners, the limit is {}", face,
                                       mesh.faces[face].size(), kMostCorners));
    }
    if (method == DensifyMethod::Midpoint) {
      continue;
    }
    loop.clear();
    for (const DenseCorner& corner : mesh.faces[face]) {
      loop.push_back(corner.point);
    }
    std::sort(loop.begin(), loop.end());
    if (std::adjacent_find(loop.begin(), loop.end()) != loop.end()) {
      throw ParameterError(
          fmt::format("densify: face {} contains point {} twice, only midpoint takes such faces",
                      face, *std::adjacent_find(loop.begin(), loop.end())));
    }
  }
  const double longest_now = longest_edge(mesh);
  double n_faces = least_faces(mesh, longest);
  if (method != DensifyMethod::Midpoint && longest_now > longest) {
    // Smooth methods halve edges roughly; two rounds of doubt.
    const double rounds = std::ceil(std::log2(longest_now / longest)) - 2;
    n_faces = static_cast<double>(mesh.faces.n_rows()) * std::pow(4.0, std::max(rounds, 0.0));
  }
  if (n_faces > kMostDenseFaces) {
    refuse_growth(n_faces, longest, longest_now);
  }
}

/// One halving of long edges. Libraries refine everywhere, or keep neither polygons nor seams, so
/// this is our own.
class Halving {
 public:
  Halving(DenseMesh& mesh, double longest) : mesh_(mesh), edges_(mesh) { mark(longest); }

  [[nodiscard]] bool is_done() const { return n_marked_ == 0; }
  [[nodiscard]] double n_faces() const {
    double n = 0;
    for (std::size_t face = 0; face < mesh_.faces.n_rows(); ++face) {
      const auto n_cut = n_marked(face);
      const std::size_t size = mesh_.faces[face].size();
      const bool is_fan = size > 3 && n_cut < size;
      n += n_cut == 0 ? 1 : static_cast<double>(is_fan ? size + n_cut : n_cut + 1);
    }
    return n;
  }

  void run() {
    add_edge_points();
    CompressedRows<DenseCorner> faces;
    std::vector<std::int32_t> parents;
    std::vector<std::vector<DenseCorner>> children;
    for (std::size_t face = 0; face < mesh_.faces.n_rows(); ++face) {
      children.clear();
      split(face, children);
      for (const auto& child : children) {
        faces.push_back(child);
        parents.push_back(mesh_.parents[face]);
      }
    }
    mesh_.faces = std::move(faces);
    mesh_.parents = std::move(parents);
  }

 private:
  [[nodiscard]] std::size_t n_marked(std::size_t face) const {
    std::size_t n = 0;
    for (const std::int32_t edge : edges_.of_face(face)) {
      n += new_points_[static_cast<std::size_t>(edge)] != -1 ? 1 : 0;
    }
    return n;
  }

  /// Marks edges that get a point with -2.
  void mark(double longest) {
    new_points_.assign(edges_.n_edges(), -1);
    for (std::size_t edge = 0; edge < edges_.n_edges(); ++edge) {
      const auto [a, b] = edges_.ends(edge);
      if (glm::distance(point(a), point(b)) > longest) {
        new_points_[edge] = -2;
        ++n_marked_;
      }
    }
  }

  [[nodiscard]] const glm::dvec3& point(std::int32_t i) const {
    return mesh_.points[static_cast<std::size_t>(i)];
  }

  /// A point in the middle of others.
  std::int32_t add_point(std::span<const std::int32_t> among) {
    const double part = 1.0 / static_cast<double>(among.size());
    glm::dvec3 sum(0);
    std::vector<double> extras(mesh_.n_extras, 0.0);
    for (const std::int32_t i : among) {
      sum += part * point(i);
      for (std::size_t k = 0; k < extras.size(); ++k) {
        extras[k] += part * mesh_.extras[static_cast<std::size_t>(i) * mesh_.n_extras + k];
      }
    }
    mesh_.points.push_back(sum);
    mesh_.extras.insert(mesh_.extras.end(), extras.begin(), extras.end());
    return static_cast<std::int32_t>(mesh_.points.size()) - 1;
  }

  void add_edge_points() {
    for (std::size_t edge = 0; edge < edges_.n_edges(); ++edge) {
      if (new_points_[edge] == -2) {
        new_points_[edge] = add_point(edges_.ends(edge));
      }
    }
  }

  /// The number of what lies between two or more attributes; the same for the same ones.
  template <bool kIsNormal>
  std::int32_t between(std::vector<glm::dvec3>& values, std::span<const std::int32_t> among) {
    if (std::ranges::any_of(among, [](std::int32_t i) { return i < 0; })) {
      return -1;
    }
    if (std::ranges::all_of(among, [&](std::int32_t i) { return i == among[0]; })) {
      return among[0];
    }
    auto* known = kIsNormal ? &normals_between_ : &textures_between_;
    const std::uint64_t key = static_cast<std::uint64_t>(std::min(among[0], among[1])) << 32 |
                              static_cast<std::uint64_t>(std::max(among[0], among[1]));
    if (among.size() == 2) {
      if (const auto found = known->find(key); found != known->end()) {
        return found->second;
      }
    }
    glm::dvec3 sum(0);
    for (const std::int32_t i : among) {
      const glm::dvec3& value = values[static_cast<std::size_t>(i)];
      sum += kIsNormal ? unit_or_zero(value) : value;
    }
    const glm::dvec3 normal = unit_or_zero(sum);
    const glm::dvec3& first = values[static_cast<std::size_t>(among[0])];
    values.push_back(kIsNormal ? (normal == glm::dvec3(0) ? first : normal)
                               : sum / static_cast<double>(among.size()));
    const auto number = static_cast<std::int32_t>(values.size()) - 1;
    if (among.size() == 2) {
      known->emplace(key, number);
    }
    return number;
  }

  DenseCorner corner_between(std::int32_t at, std::span<const DenseCorner> among) {
    std::vector<std::int32_t> textures;
    std::vector<std::int32_t> normals;
    for (const DenseCorner& corner : among) {
      textures.push_back(corner.texture);
      normals.push_back(corner.normal);
    }
    return {at, between<false>(mesh_.textures, textures), between<true>(mesh_.normals, normals)};
  }

  /// The faces that a face becomes.
  void split(std::size_t face, std::vector<std::vector<DenseCorner>>& out) {
    const auto row = mesh_.faces[face];
    const std::vector<DenseCorner> loop(row.begin(), row.end());
    const auto edges = edges_.of_face(face);
    std::vector<DenseCorner> middles(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t at = new_points_[static_cast<std::size_t>(edges[i])];
      if (at >= 0) {
        middles[i] = corner_between(at, std::array{loop[i], loop[(i + 1) % loop.size()]});
      }
    }
    if (loop.size() == 3) {
      split_triangle({loop[0], loop[1], loop[2]}, {middles[0], middles[1], middles[2]}, out);
    } else if (n_marked(face) == 0) {
      out.push_back(loop);
    } else if (n_marked(face) == loop.size()) {
      split_polygon(loop, middles, out);
    } else if (loop.size() == 4 && n_marked(face) == 2 &&
               (middles[0].point >= 0) == (middles[2].point >= 0)) {
      const std::size_t i = middles[0].point >= 0 ? 0 : 1;
      out.push_back({loop[i], middles[i], middles[i + 2], loop[(i + 3) % 4]});
      out.push_back({middles[i], loop[i + 1], loop[i + 2], middles[i + 2]});
    } else {
      split_fan(loop, middles, out);
    }
  }

  void split_triangle(std::array<DenseCorner, 3> p, std::array<DenseCorner, 3> m,
                      std::vector<std::vector<DenseCorner>>& out) const {
    const auto is_cut = [&](std::size_t i) { return m[i].point >= 0; };
    const std::size_t n_cut =
        static_cast<std::size_t>(is_cut(0)) + is_cut(1) + static_cast<std::size_t>(is_cut(2));
    // Turned so that edge 0 is the only one cut, or edge 2 the only one that is not.
    while ((n_cut == 1 && !is_cut(0)) || (n_cut == 2 && is_cut(2))) {
      std::rotate(p.begin(), p.begin() + 1, p.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    switch (n_cut) {
      case 0:
        out.push_back({p[0], p[1], p[2]});
        break;
      case 1:
        out.push_back({p[0], m[0], p[2]});
        out.push_back({m[0], p[1], p[2]});
        break;
      case 2:
        out.push_back({m[0], p[1], m[1]});
        if (glm::distance(point(p[0].point), point(m[1].point)) <=
            glm::distance(point(m[0].point), point(p[2].point))) {
          out.push_back({p[0], m[0], m[1]});
          out.push_back({p[0], m[1], p[2]});
        } else {
          out.push_back({p[0], m[0], p[2]});
          out.push_back({m[0], m[1], p[2]});
        }
        break;
      default:
        out.push_back({p[0], m[0], m[2]});
        out.push_back({m[0], p[1], m[1]});
        out.push_back({m[2], m[1], p[2]});
        out.push_back({m[0], m[1], m[2]});
    }
  }

  void split_polygon(const std::vector<DenseCorner>& loop, const std::vector<DenseCorner>& middles,
                     std::vector<std::vector<DenseCorner>>& out) {
    std::vector<std::int32_t> points;
    for (const DenseCorner& corner : loop) {
      points.push_back(corner.point);
    }
    const DenseCorner centre = corner_between(add_point(points), loop);
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      out.push_back({loop[i], middles[i], centre, middles[(i + n - 1) % n]});
    }
  }

  /// Triangles round the middle of a polygon of which not all edges are cut.
  void split_fan(const std::vector<DenseCorner>& loop, const std::vector<DenseCorner>& middles,
                 std::vector<std::vector<DenseCorner>>& out) {
    std::vector<std::int32_t> points;
    std::vector<DenseCorner> rim;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      points.push_back(loop[i].point);
      rim.push_back(loop[i]);
      if (middles[i].point >= 0) {
        rim.push_back(middles[i]);
      }
    }
    const DenseCorner centre = corner_between(add_point(points), loop);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      out.push_back({rim[i], rim[(i + 1) % rim.size()], centre});
    }
  }

  DenseMesh& mesh_;
  MeshEdges edges_;
  std::size_t n_marked_ = 0;
  std::vector<std::int32_t> new_points_;  // of edges; -1: none, -2: to be made
  std::unordered_map<std::uint64_t, std::int32_t> textures_between_;
  std::unordered_map<std::uint64_t, std::int32_t> normals_between_;
};

/// Concave polygons with a long edge as triangles.
void cut_concave(DenseMesh& mesh, double longest) {
  CompressedRows<DenseCorner> faces;
  std::vector<std::int32_t> parents;
  std::vector<glm::dvec3> loop;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    const auto corners = mesh.faces[face];
    loop.clear();
    for (const DenseCorner& corner : corners) {
      loop.push_back(mesh.points[static_cast<std::size_t>(corner.point)]);
    }
    bool is_long = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      is_long |= glm::distance(loop[i], loop[(i + 1) % loop.size()]) > longest;
    }
    if (loop.size() == 3 || !is_long || is_seen_from_middle(loop)) {
      faces.push_back(corners);
      parents.push_back(mesh.parents[face]);
      continue;
    }
    for (const auto& [a, b, c] : ear_triangles(loop)) {
      faces.push_back(std::array{corners[a], corners[b], corners[c]});
      parents.push_back(mesh.parents[face]);
    }
  }
  mesh.faces = std::move(faces);
  mesh.parents = std::move(parents);
}

void halve_long_edges(DenseMesh& mesh, double longest, const Progress& progress) {
  const double longest_before = longest_edge(mesh);
  cut_concave(mesh, longest);
  for (int round = 0; round < kMostRounds; ++round) {
    progress.update("densify", 1 - std::exp2(-round));
    Halving next(mesh, longest);
    if (next.is_done()) {
      break;
    }
    if (next.n_faces() > kMostDenseFaces) {
      refuse_growth(next.n_faces(), longest, longest_before);
    }
    next.run();
  }
}

/// Texture coordinates, then normals.
osd::SurfaceValues surface_of(DenseMesh mesh) {
  osd::SurfaceValues surface{
      std::move(mesh.points), mesh.n_extras, std::move(mesh.extras), {}, {}, {}};
  surface.channels.resize(2);
  surface.channels[0].values = std::move(mesh.textures);
  surface.channels[1].values = std::move(mesh.normals);
  std::vector<std::int32_t> loop;
  for (std::size_t face = 0; face < mesh.faces.n_rows(); ++face) {
    loop.clear();
    for (const DenseCorner& corner : mesh.faces[face]) {
      loop.push_back(corner.point);
      surface.channels[0].of_corners.push_back(corner.texture);
      surface.channels[1].of_corners.push_back(corner.normal);
    }
    surface.faces.push_back(loop);
  }
  return surface;
}

/// parents: of the faces that the surface is refined from.
DenseMesh mesh_of(osd::SurfaceValues surface, std::span<const std::int32_t> parents) {
  DenseMesh mesh;
  std::vector<DenseCorner> corners;
  std::size_t corner = 0;
  for (std::size_t face = 0; face < surface.faces.n_rows(); ++face) {
    corners.clear();
    for (const std::int32_t point : surface.faces[face]) {
      corners.push_back(
          {point, surface.channels[0].of_corners[corner], surface.channels[1].of_corners[corner]});
      ++corner;
    }
    mesh.faces.push_back(corners);
    mesh.parents.push_back(parents[static_cast<std::size_t>(surface.parents[face])]);
  }
  mesh.points = std::move(surface.points);
  mesh.n_extras = surface.n_extras;
  mesh.extras = std::move(surface.extras);
  mesh.textures = std::move(surface.channels[0].values);
  mesh.normals = std::move(surface.channels[1].values);
  return mesh;
}

void make_unit(std::vector<glm::dvec3>& normals) {
  for (glm::dvec3& normal : normals) {
    normal = unit_or_zero(normal);
  }
}

void refine_smoothly(DenseMesh& mesh, osd::SurfaceScheme scheme, double longest,
                     const Progress& progress) {
  const double longest_before = longest_edge(mesh);
  double longest_now = longest_before;
  make_unit(mesh.normals);
  for (int round = 0; round < kMostRounds && longest_now > longest; ++round) {
    progress.update("densify", 1 - std::exp2(-round));
    const double n_faces = scheme == osd::SurfaceScheme::Loop
                               ? 4 * static_cast<double>(mesh.faces.n_rows())
                               : static_cast<double>(mesh.faces.n_values());
    if (n_faces > kMostDenseFaces) {
      refuse_growth(n_faces, longest, longest_before);
    }
    const std::vector<std::int32_t> parents = std::move(mesh.parents);
    mesh = mesh_of(osd::refine_values(surface_of(std::move(mesh)), scheme), parents);
    make_unit(mesh.normals);
    longest_now = longest_edge(mesh);
  }
}

}  // namespace

DenseMesh densified(DenseMesh mesh, DensifyMethod method, double longest,
                    const Progress& progress) {
  check(mesh, method, longest);
  const std::vector<glm::dvec3> normals = mesh.normals;
  switch (method) {
    case DensifyMethod::Midpoint:
      halve_long_edges(mesh, longest, progress);
      break;
    case DensifyMethod::Loop:
      refine_smoothly(mesh, osd::SurfaceScheme::Loop, longest, progress);
      break;
    case DensifyMethod::CatmullClark:
      refine_smoothly(mesh, osd::SurfaceScheme::CatmullClark, longest, progress);
      break;
  }
  std::copy(normals.begin(), normals.end(), mesh.normals.begin());
  progress.update("densify", 1.0);
  return mesh;
}

}  // namespace espalier
