// How boundary faces hang together.

#include "deform/injectivity/boundary_seams.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "lattice/core/box.h"
#include "lattice/core/box_tree.h"

namespace espalier {
namespace {

// What meets lies within these parts of the shorter sides of its faces, but for round-off; between
// these parts of the volume's size.
constexpr double kSamePlaceOfFace = 1e-3;
constexpr double kRoundOff = 3e-14;
constexpr double kSamePlace = 1e-9;
constexpr double kLeafSeam = 0.1;         // of the size of a leaf's face
constexpr double kFinestSplit = 0x1p-24;  // of an edge, by a corner of a finer face
constexpr double kCoarsestSplit = 0x1p-3;
constexpr int kSamples = 9;
constexpr int kNewtonSteps = 12;

/// Where a place of the boundary is, at rest and in the pose.
struct TwoPlaces {
  glm::dvec3 rest{0};
  glm::dvec3 pose{0};
};

/// Lengths at rest and in the pose.
struct TwoSizes {
  double rest = 0;
  double pose = 0;
};

/// A place where faces have corners.
struct Corner {
  TwoPlaces at;
  TwoSizes tolerance;
};

TwoSizes shorter(const TwoSizes& a, const TwoSizes& b) {
  return {std::min(a.rest, b.rest), std::min(a.pose, b.pose)};
}

bool is_near(const TwoPlaces& a, const TwoPlaces& b, const TwoSizes& within) {
  return glm::distance(a.rest, b.rest) <= within.rest &&
         glm::distance(a.pose, b.pose) <= within.pose;
}

/// A point on an edge where another face's corner lies.
struct Break {
  double at = 0;
  std::int32_t corner = 0;
  double distance = 0;  // between the two at rest
};

/// A stretch of an edge between two corners.
struct Stretch {
  std::int32_t low = 0;  // its corners, ascending
  std::int32_t high = 0;
  std::int32_t face = 0;
  SeamUse use;
};

glm::dvec2 edge_place(int across, int side, double t) {
  glm::dvec2 st(side);
  st[1 - across] = t;
  return st;
}

Box box_of_nets(std::span<const FaceNet> nets) {
  Box box;
  std::vector<glm::dvec3> points;
  for (const FaceNet& net : nets) {
    net.positions(points);
    box.add(points);
  }
  return box;
}

/// The longer of its diagonals.
double size_of(const FaceNet& net) {
  return std::max(glm::distance(net.value({0, 0}), net.value({1, 1})),
                  glm::distance(net.value({1, 0}), net.value({0, 1})));
}

double shortest_side(const FaceNet& net) {
  const glm::dvec3 low = net.value({0, 0});
  const glm::dvec3 high = net.value({1, 1});
  double shortest = std::numeric_limits<double>::infinity();
  for (const glm::dvec2 other : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
    const glm::dvec3 at = net.value(other);
    shortest = std::min({shortest, glm::distance(low, at), glm::distance(high, at)});
  }
  return shortest;
}

class SeamFinder {
 public:
  explicit SeamFinder(BoundaryMesh& mesh)
      : mesh_(mesh), rest_size_(mesh.rest_size), pose_size_(2 * box_of_nets(mesh.pose).radius()) {}

  void find() {
    find_corners();
    find_breaks();
    std::vector<Stretch> stretches = find_stretches();
    number_seams(stretches);
    fill(stretches);
  }

 private:
  [[nodiscard]] TwoPlaces places(std::size_t face, const glm::dvec2& st) const {
    return {mesh_.rest[face].value(st), mesh_.pose[face].value(st)};
  }
  /// How far apart places may be that are one, if one of them is of this face.
  [[nodiscard]] TwoSizes tolerance(std::size_t face) const {
    const auto within = [](double side, double size) {
      return std::clamp(kSamePlaceOfFace * side, kRoundOff * size, kSamePlace * size);
    };
    return {within(shortest_side(mesh_.rest[face]), rest_size_),
            within(shortest_side(mesh_.pose[face]), pose_size_)};
  }

  /// Gives the corners of all faces numbers, the same to those at one place.
  void find_corners() {
    const double reach = kSamePlace * rest_size_;
    const double cell = std::max(4 * reach, 1e-300);
    const auto key_of = [&](const glm::dvec3& at) {
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::int64_t>(std::floor(at[axis] / cell));
        key = key * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(index);
      }
      return key;
    };
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> in_cell;
    const auto find = [&](const Corner& corner) {
      for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 side(octant & 1, octant >> 1 & 1, octant >> 2);
        const auto found = in_cell.find(key_of(corner.at.rest + reach * (2.0 * side - 1.0)));
        if (found == in_cell.end()) {
          continue;
        }
        for (const std::int32_t i : found->second) {
          Corner& known = corners_[static_cast<std::size_t>(i)];
          const TwoSizes both = shorter(known.tolerance, corner.tolerance);
          if (is_near(known.at, corner.at, both)) {
            known.tolerance = both;
            return i;
          }
        }
      }
      in_cell[key_of(corner.at.rest)].push_back(static_cast<std::int32_t>(corners_.size()));
      corners_.push_back(corner);
      return static_cast<std::int32_t>(corners_.size()) - 1;
    };
    for (std::size_t face = 0; face < mesh_.faces.size(); ++face) {
      for (int c = 0; c < 4; ++c) {
        face_corners_.push_back(find({places(face, {c & 1, c >> 1}), tolerance(face)}));
      }
    }
  }

  /// The corners at the ends of an edge.
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> ends(std::size_t edge) const {
    const std::size_t face = edge / 4;
    const auto across = static_cast<int>(edge % 4 / 2);
    const auto side = static_cast<int>(edge % 2);
    const auto corner = [&](double t) {
      const glm::dvec2 st = edge_place(across, side, t);
      return face_corners_[4 * face + static_cast<std::size_t>(st.x + 2 * st.y)];
    };
    return {corner(0), corner(1)};
  }

  /// The parameter of an edge that is closest to a place at rest.
  [[nodiscard]] double closest(std::size_t face, int across, int side, const glm::dvec3& to) const {
    double best = 0;
    double least = std::numeric_limits<double>::infinity();
    const FaceNet& net = mesh_.rest[face];
    for (int i = 0; i < kSamples; ++i) {
      const double t = static_cast<double>(i) / (kSamples - 1);
      const double distance = glm::distance(net.value(edge_place(across, side, t)), to);
      if (distance < least) {
        least = distance;
        best = t;
      }
    }
    for (int step = 0; step < kNewtonSteps; ++step) {
      glm::dvec3 value;
      glm::dmat2x3 derivative;
      net.evaluate(edge_place(across, side, best), value, derivative);
      const glm::dvec3 along = derivative[1 - across];
      const double square = glm::dot(along, along);
      best = square > 0 ? std::clamp(best + glm::dot(to - value, along) / square, 0.0, 1.0) : best;
    }
    if (mesh_.faces[face].is_leaf) {
      // Beyond an end neighbours are halved again and again.
      const double near = std::exp2(std::round(std::log2(std::min(best, 1 - best))));
      return best < 0.5 ? near : 1 - near;
    }
    // Round-off is a larger part of a shorter edge.
    const double length = glm::distance(net.value(edge_place(across, side, 0)),
                                        net.value(edge_place(across, side, 1)));
    double split = kFinestSplit;
    while (split < kCoarsestSplit && !(kRoundOff * rest_size_ < 0.1 * split * length)) {
      split *= 2;
    }
    const double dyadic = std::round(best / split) * split;
    return std::abs(dyadic - best) < 0.1 * split ? dyadic : best;
  }

  /// How far from a place of a face's edge a corner may lie that counts as there; `end`: how far
  /// the place is from the edge's nearer end.
  [[nodiscard]] TwoSizes reach(std::size_t face, double end) const {
    const TwoSizes least = tolerance(face);
    if (!mesh_.faces[face].is_leaf) {
      return least;
    }
    return {std::max(least.rest, 4 * kLeafSeam * end * shortest_side(mesh_.rest[face])),
            std::max(least.pose, 4 * kLeafSeam * end * shortest_side(mesh_.pose[face]))};
  }

  /// Finds the corners that lie within edges.
  void find_breaks() {
    const std::size_t n_edges = 4 * mesh_.faces.size();
    breaks_.resize(n_edges);
    std::vector<Box> boxes(n_edges);
    std::vector<glm::dvec3> points;
    for (std::size_t edge = 0; edge < n_edges; ++edge) {
      const auto across = static_cast<int>(edge % 4 / 2);
      const auto side = static_cast<int>(edge % 2);
      const FaceNet& net = mesh_.rest[edge / 4];
      net.positions(points);
      const int n = net.degree(0) + 1;
      const int m = net.degree(1) + 1;
      for (int k = 0; k < (across == 0 ? m : n); ++k) {
        const int i = across == 0 ? side * (n - 1) : k;
        const int j = across == 0 ? k : side * (m - 1);
        boxes[edge].add(points[static_cast<std::size_t>(i + n * j)]);
      }
      boxes[edge] = boxes[edge].grown(reach(edge / 4, 0.5).rest);
    }
    const BoxTree tree(std::move(boxes));
    for (std::size_t corner = 0; corner < corners_.size(); ++corner) {
      const TwoPlaces& at = corners_[corner].at;
      tree.visit_overlapping({at.rest, at.rest}, [&](std::size_t edge) {
        add_break(edge, static_cast<std::int32_t>(corner));
      });
    }
    for (std::vector<Break>& found : breaks_) {
      std::sort(found.begin(), found.end(), [](const Break& a, const Break& b) {
        return std::tuple(a.at, a.distance, a.corner) < std::tuple(b.at, b.distance, b.corner);
      });
      const auto is_same_place = [](const Break& a, const Break& b) { return a.at == b.at; };
      found.erase(std::unique(found.begin(), found.end(), is_same_place), found.end());
    }
  }

  void add_break(std::size_t edge, std::int32_t corner) {
    const auto [begin, end] = ends(edge);
    if (corner == begin || corner == end) {
      return;
    }
    const auto across = static_cast<int>(edge % 4 / 2);
    const auto side = static_cast<int>(edge % 2);
    const Corner& found = corners_[static_cast<std::size_t>(corner)];
    const double t = closest(edge / 4, across, side, found.at.rest);
    TwoSizes within = reach(edge / 4, std::min(t, 1 - t));
    if (!mesh_.faces[edge / 4].is_leaf) {
      within = shorter(within, found.tolerance);
    }
    const TwoPlaces there = places(edge / 4, edge_place(across, side, t));
    if (t > 0 && t < 1 && is_near(there, found.at, within)) {
      breaks_[edge].push_back({t, corner, glm::distance(there.rest, found.at.rest)});
    }
  }

  [[nodiscard]] std::vector<Stretch> find_stretches() const {
    std::vector<Stretch> stretches;
    for (std::size_t edge = 0; edge < breaks_.size(); ++edge) {
      const auto [begin, end] = ends(edge);
      Break last{0, begin, 0};
      const auto add = [&](const Break& next) {
        if (next.corner != last.corner) {
          const bool is_forward = last.corner < next.corner;
          stretches.push_back({std::min(last.corner, next.corner),
                               std::max(last.corner, next.corner),
                               static_cast<std::int32_t>(edge / 4),
                               {-1, static_cast<int>(edge % 4 / 2), static_cast<int>(edge % 2),
                                is_forward ? last.at : next.at, is_forward ? next.at : last.at}});
        }
        last = next;
      };
      for (const Break& found : breaks_[edge]) {
        add(found);
      }
      add({1, end, 0});
    }
    std::stable_sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
      return std::pair(a.low, a.high) < std::pair(b.low, b.high);
    });
    return stretches;
  }

  /// Whether two stretches between the same corners are one curve.
  [[nodiscard]] bool is_one_curve(const Stretch& a, const Stretch& b) const {
    const auto at = [&](const Stretch& s, double part) {
      return places(
          static_cast<std::size_t>(s.face),
          edge_place(s.use.across, s.use.side, s.use.begin + part * (s.use.end - s.use.begin)));
    };
    const auto face_of = [](const Stretch& s) { return static_cast<std::size_t>(s.face); };
    TwoSizes within = shorter(tolerance(face_of(a)), tolerance(face_of(b)));
    for (const std::size_t face : {face_of(a), face_of(b)}) {
      if (mesh_.faces[face].is_leaf) {
        within.rest = std::max(within.rest, kLeafSeam * size_of(mesh_.rest[face]));
        within.pose = std::max(within.pose, kLeafSeam * size_of(mesh_.pose[face]));
      }
    }
    for (int i = 1; i < kSamples - 1; ++i) {
      const double part = static_cast<double>(i) / (kSamples - 1);
      if (!is_near(at(a, part), at(b, part), within)) {
        return false;
      }
    }
    return true;
  }

  void number_seams(std::vector<Stretch>& stretches) const {
    std::int32_t n_seams = 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      for (std::size_t k = i; k-- > 0 && stretches[k].low == stretches[i].low &&
                              stretches[k].high == stretches[i].high;) {
        if (is_one_curve(stretches[k], stretches[i])) {
          stretches[i].use.seam = stretches[k].use.seam;
          break;
        }
      }
      if (stretches[i].use.seam < 0) {
        stretches[i].use.seam = n_seams++;
      }
    }
  }

  void fill(const std::vector<Stretch>& stretches) {
    std::vector<std::vector<SeamUse>> seams(mesh_.faces.size());
    for (const Stretch& stretch : stretches) {
      seams[static_cast<std::size_t>(stretch.face)].push_back(stretch.use);
    }
    std::vector<CornerUse> corners;
    for (std::size_t face = 0; face < mesh_.faces.size(); ++face) {
      mesh_.seams.push_back(seams[face]);
      corners.clear();
      for (std::size_t c = 0; c < 4; ++c) {
        corners.push_back({face_corners_[4 * face + c], {c & 1, c >> 1}});
      }
      for (std::size_t edge = 4 * face; edge < 4 * face + 4; ++edge) {
        for (const Break& found : breaks_[edge]) {
          corners.push_back({found.corner, edge_place(static_cast<int>(edge % 4 / 2),
                                                      static_cast<int>(edge % 2), found.at)});
        }
      }
      mesh_.corners.push_back(corners);
    }
  }

  BoundaryMesh& mesh_;
  double rest_size_;
  double pose_size_;
  std::vector<Corner> corners_;
  std::vector<std::int32_t> face_corners_;  // 4 a face: (0,0), (1,0), (0,1), (1,1)
  std::vector<std::vector<Break>> breaks_;  // of each edge: 4 · face + 2 · across + side
};

}  // namespace

BoundaryMesh boundary_mesh(const Volume& volume, std::span<const glm::dvec3> pose,
                           std::span<const double> pose_weights) {
  BoundaryMesh mesh;
  BezierPatch rest;
  BezierPatch posed;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const Patch& patch = volume.patch(i);
    if (patch.boundary_faces == 0) {
      continue;
    }
    volume.bezier(i, volume.rest_points(), rest);
    volume.bezier(i, pose, pose_weights.empty() ? volume.weights() : pose_weights, posed);
    for (int face = 0; face < 6; ++face) {
      if (patch.is_on_boundary(face)) {
        mesh.faces.push_back({static_cast<std::int32_t>(i), face, patch.is_leaf});
        mesh.rest.emplace_back(rest, face);
        mesh.pose.emplace_back(posed, face);
      }
    }
  }
  mesh.rest_size = 2 * box_of_nets(mesh.rest).radius();
  SeamFinder(mesh).find();
  return mesh;
}

}  // namespace espalier
