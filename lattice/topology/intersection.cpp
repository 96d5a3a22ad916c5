/// Broad phase: a tree over the cells' boxes. Narrow phase: a plane that separates two cells, else
/// edges of triangles that pierce triangles, else winding numbers of points beneath the surface.

#include "lattice/topology/intersection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "lattice/core/box_tree.h"
#include "lattice/topology/cell_surface.h"
#include "lattice/topology/defect_collection.h"

namespace espalier {
namespace {

constexpr std::size_t kMostPartners = 16;
/// Points beneath the surface that are tried in a cell: beyond it, some are left out.
constexpr std::size_t kMostSamples = 64;

/// Compares one cell with others; every thread has its own.
class PairTest {
 public:
  PairTest(const CellComplex& complex, std::span<const glm::dvec3> points, double tolerance)
      : a_(complex, points, tolerance), b_(complex, points, tolerance), tolerance_(tolerance) {}

  /// The cell that is compared.
  void set_cell(CellId cell) { a_.load(cell); }

  bool overlaps(CellId other) {
    b_.load(other);
    if (are_apart() || a_.is_beyond(b_.vertices(), tolerance_) ||
        b_.is_beyond(a_.vertices(), tolerance_)) {
      return false;
    }
    collect_near(a_, b_, tolerance_, triangles_a_);
    collect_near(b_, a_, tolerance_, triangles_b_);
    return surfaces_cross() || reaches_into(a_, triangles_a_, b_) ||
           reaches_into(b_, triangles_b_, a_);
  }

 private:
  /// The vertices of the two cells that are farthest from being apart along an axis.
  struct Extremes {
    glm::dvec3 last_of_a;
    glm::dvec3 first_of_b;
  };

  [[nodiscard]] Extremes extremes_along(const glm::dvec3& axis) const {
    const auto at = [&](const glm::dvec3& vertex) { return glm::dot(axis, vertex); };
    return {*std::ranges::max_element(a_.vertices(), {}, at),
            *std::ranges::min_element(b_.vertices(), {}, at)};
  }

  /// Whether a plane with all of a on one side and all of b on the other is found: first the one
  /// across the line between their centroids; then each is turned so that the two vertices that are
  /// worst pass. All turns keep the plane on an edge that the cells share.
  [[nodiscard]] bool are_apart() const {
    constexpr int kMostTurns = 12;
    constexpr double kOverturn = 1.5;  // so that there is an end where a whole cone of axes serves
    const glm::dvec3 shared = shared_edge();
    const auto off_edge = [&](const glm::dvec3& x) { return x - glm::dot(x, shared) * shared; };
    glm::dvec3 axis = off_edge(b_.centroid() - a_.centroid());
    for (int turn = 0; turn < kMostTurns; ++turn) {
      const double length = glm::length(axis);
      if (!(length > 0)) {
        return false;
      }
      axis /= length;
      const auto [last_of_a, first_of_b] = extremes_along(axis);
      const glm::dvec3 between = first_of_b - last_of_a;
      const double gap = glm::dot(axis, between);
      if (gap >= -tolerance_) {
        return true;
      }
      const glm::dvec3 turned = off_edge(between);
      axis -= kOverturn * gap / glm::dot(turned, turned) * turned;
    }
    return false;
  }

  /// The direction of the line through two vertices that both cells have; zero if they have one in
  /// common, or none.
  [[nodiscard]] glm::dvec3 shared_edge() const {
    const glm::dvec3* first = nullptr;
    for (const glm::dvec3& vertex : a_.vertices()) {
      if (std::ranges::find(b_.vertices(), vertex) == b_.vertices().end()) {
        continue;
      }
      if (first != nullptr && vertex != *first) {
        return glm::normalize(vertex - *first);
      }
      first = &vertex;
    }
    return glm::dvec3(0);
  }

  /// The triangles of a cell that the other's hull does not exclude, those flush with it among
  /// them, sorted along x.
  static void collect_near(CellSurface& cell, CellSurface& other, double tolerance,
                           std::vector<const SurfaceTriangle*>& near) {
    near.clear();
    for (const SurfaceTriangle& triangle : cell.triangles()) {
      if (triangle.slack > 0 && triangle.box.overlaps(other.box()) &&
          !other.is_beyond(triangle.corners, -tolerance)) {
        near.push_back(&triangle);
      }
    }
    std::sort(near.begin(), near.end(), [](const SurfaceTriangle* s, const SurfaceTriangle* t) {
      return s->box.min.x < t->box.min.x;
    });
  }

  [[nodiscard]] bool surfaces_cross() const {
    std::size_t first = 0;
    for (const SurfaceTriangle* s : triangles_a_) {
      while (first < triangles_b_.size() && triangles_b_[first]->box.max.x < s->box.min.x) {
        ++first;
      }
      for (std::size_t j = first; j < triangles_b_.size(); ++j) {
        const SurfaceTriangle* t = triangles_b_[j];
        if (t->box.min.x > s->box.max.x) {
          break;
        }
        if (s->face != t->face && s->box.overlaps(t->box) && cross(*s, *t)) {
          return true;
        }
      }
    }
    return false;
  }

  using Heights = std::array<double, 3>;

  /// Heights of the corners of s over the plane of t.
  static Heights heights_over(const SurfaceTriangle& s, const SurfaceTriangle& t) {
    return {glm::dot(t.normal, s.corners[0] - t.corners[0]),
            glm::dot(t.normal, s.corners[1] - t.corners[0]),
            glm::dot(t.normal, s.corners[2] - t.corners[0])};
  }

  static bool is_on_one_side(const Heights& heights, double slack) {
    return std::max({heights[0], heights[1], heights[2]}) <= slack ||
           std::min({heights[0], heights[1], heights[2]}) >= -slack;
  }

  /// Whether a triangle of a and one of b cross properly.
  [[nodiscard]] bool cross(const SurfaceTriangle& s, const SurfaceTriangle& t) const {
    const Heights s_over_t = heights_over(s, t);
    if (is_on_one_side(s_over_t, t.slack)) {
      return false;
    }
    const Heights t_over_s = heights_over(t, s);
    return !is_on_one_side(t_over_s, s.slack) &&
           (pierces(s, t, s_over_t, b_) || pierces(t, s, t_over_s, a_));
  }

  /// Whether an edge of s passes through t, away from the border of t's face; t belongs to `cell`.
  static bool pierces(const SurfaceTriangle& s, const SurfaceTriangle& t, const Heights& height,
                      const CellSurface& cell) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if ((height[i] > t.slack && height[j] < -t.slack) ||
          (height[j] > t.slack && height[i] < -t.slack)) {
        const double along = height[i] / (height[i] - height[j]);
        const glm::dvec3 at = s.corners[i] + along * (s.corners[j] - s.corners[i]);
        if (is_over(at, t) && cell.is_off_border(at, t.face, t.slack)) {
          return true;
        }
      }
    }
    return false;
  }

  static bool is_over(const glm::dvec3& at, const SurfaceTriangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 edge = t.corners[(i + 1) % 3] - t.corners[i];
      if (glm::dot(t.normal, glm::cross(edge, at - t.corners[i])) < -t.slack * glm::length(edge)) {
        return false;
      }
    }
    return true;
  }

  /// Whether a point close beneath the surface of `cell`, away from faces of both, is in `other`.
  bool reaches_into(CellSurface& cell, const std::vector<const SurfaceTriangle*>& triangles,
                    CellSurface& other) const {
    // Places in a triangle that symmetric arrangements do not put on a border.
    constexpr std::array<double, 3> kWeights = {0.413, 0.321, 0.266};
    const std::size_t step = (triangles.size() + kMostSamples - 1) / kMostSamples;
    for (std::size_t i = 0; i < triangles.size(); i += step) {
      const SurfaceTriangle& t = *triangles[i];
      if (other.has_face(t.face)) {
        continue;
      }
      const glm::dvec3 at =
          kWeights[0] * t.corners[0] + kWeights[1] * t.corners[1] + kWeights[2] * t.corners[2];
      const double size = glm::distance(t.corners[0], t.corners[1]);
      for (const double depth : {1e-3, 1e-4, 1e-6}) {
        const glm::dvec3 sample = at - std::max(depth * size, 4 * tolerance_) * t.normal;
        if (other.is_beyond({&sample, 1}, 0) || other.winding(sample) < 0.5) {
          break;
        }
        if (cell.winding(sample) > 0.5) {
          return true;
        }
      }
    }
    return false;
  }

  CellSurface a_;
  CellSurface b_;
  double tolerance_;
  std::vector<const SurfaceTriangle*> triangles_a_;
  std::vector<const SurfaceTriangle*> triangles_b_;
};

/// Boxes of the cells; an inside-out box for cells that are not sound, which overlaps none.
std::vector<Box> cell_boxes(const CellComplex& complex, std::span<const glm::dvec3> points,
                            const IdVector<CellId, bool>& is_sound) {
  std::vector<Box> boxes(complex.n_cells());
  for (const CellId cell : complex.cells()) {
    for (const VertexId vertex : complex.vertices(cell)) {
      boxes[cell.index()].add(points[vertex.index()]);
    }
    if (!is_sound[cell]) {
      std::swap(boxes[cell.index()].min, boxes[cell.index()].max);
    }
  }
  return boxes;
}

}  // namespace

std::vector<Defect> find_intersecting_cells(const CellComplex& complex,
                                            std::span<const glm::dvec3> points,
                                            const IdVector<CellId, bool>& is_sound,
                                            double tolerance, const Progress& progress) {
  const BoxTree tree(cell_boxes(complex, points, is_sound));
  const auto id = [](std::size_t cell) { return CellId{static_cast<std::int32_t>(cell)}; };
  const auto check_cell = [&](std::size_t i, PairTest& test) {
    std::vector<std::size_t> partners;
    if (is_sound[id(i)]) {
      test.set_cell(id(i));
      tree.visit_overlapping(tree.box(i).grown(-tolerance), [&](std::size_t j) {
        if (j < i && partners.size() < kMostPartners && is_sound[id(j)] && test.overlaps(id(j))) {
          partners.push_back(j);
        }
      });
    }
    std::sort(partners.begin(), partners.end());
    std::vector<Defect> found;
    found.reserve(partners.size());
    for (const std::size_t j : partners) {
      found.push_back(make_defect(DefectKind::IntersectingCells, "cell", i,
                                  fmt::format("intersects cell {}", j)));
    }
    return found;
  };
  constexpr std::size_t kBlock = 16384;
  std::vector<Defect> defects;
  for (std::size_t begin = 0; begin < complex.n_cells(); begin += kBlock) {
    progress.update("checking cells for intersections",
                    static_cast<double>(begin) / static_cast<double>(complex.n_cells()));
    const std::size_t n = std::min(kBlock, complex.n_cells() - begin);
    constexpr std::size_t kGrain = 256;
    const auto make_check = [&] {
      return [&, test = PairTest(complex, points, tolerance)](std::size_t i) mutable {
        return check_cell(begin + i, test);
      };
    };
    collect_defects_with(n, make_check, defects, kGrain);
  }
  return defects;
}

}  // namespace espalier
