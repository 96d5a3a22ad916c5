#include "deform/embed/embed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "lattice/core/box_tree.h"
#include "lattice/core/parallel.h"
#include "lattice/volume/bezier_inverse.h"

namespace espalier {
namespace {

/// Relative to the lattice's diagonal: round-off of an exact solution, and the closed border.
constexpr double kExact = 1e-14;
constexpr double kBorder = 1e-9;

struct Location {
  PointStatus status = PointStatus::Outside;
  std::int32_t patch = -1;
  glm::dvec3 uvw{0};
};

/// Whether a point of a patch is within `tolerance` (a length) of the volume's boundary.
bool is_near_boundary(const Patch& patch, const BezierView& map, const glm::dvec3& uvw,
                      double tolerance) {
  if (patch.boundary_faces == 0) {
    return false;
  }
  const glm::dvec3 at = map.value(uvw);
  for (int face = 0; face < 6; ++face) {
    if (patch.is_on_boundary(face)) {
      glm::dvec3 on_face = uvw;
      on_face[face / 2] = face % 2;
      if (glm::distance(map.value(on_face), at) <= tolerance) {
        return true;
      }
    }
  }
  return false;
}

/// Of a sum of coordinates as large as these.
double round_off(std::span<const glm::dvec3> points) {
  const Box box = box_of(points);
  const glm::dvec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
  return 8 * std::numeric_limits<double>::epsilon() * std::max({largest.x, largest.y, largest.z});
}

/// The patches at rest in Bézier form. Made once, all in one array; trilinear patches, of which
/// there may be millions, when they are asked for.
class RestPatches {
 public:
  explicit RestPatches(const Volume& volume) : volume_(volume), first_(volume.n_patches(), 0) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      first_[i] = n;
      const auto [p, q, r] = volume.degree(i);
      const auto n_points = static_cast<std::size_t>((p + 1) * (q + 1) * (r + 1));
      n += n_points > 8 ? n_points : 0;
    }
    points_.resize(n);
    weights_.resize(volume.is_rational() ? n : 0);
    parallel_ranges(first_.size(), 256, [&](std::size_t begin, std::size_t end) {
      BezierPatch patch;
      for (std::size_t i = begin; i < end; ++i) {
        if (n_points(i) > 0) {
          volume.bezier(i, volume.rest_points(), patch);
          std::copy(patch.points.begin(), patch.points.end(), points_.begin() + offset(i));
          std::copy(patch.weights.begin(), patch.weights.end(), weights_.begin() + offset(i));
        }
      }
    });
  }

  /// scratch: memory that the view may use.
  [[nodiscard]] BezierView view(std::size_t i, BezierPatch& scratch) const {
    if (n_points(i) == 0) {
      volume_.bezier(i, volume_.rest_points(), scratch);
      return scratch;
    }
    const std::span<const double> weights(weights_);
    return {volume_.degree(i),
            {&points_[first_[i]], n_points(i)},
            volume_.patch(i).is_pyramid,
            weights.empty() ? weights : weights.subspan(first_[i], n_points(i))};
  }

 private:
  [[nodiscard]] std::size_t n_points(std::size_t i) const {
    return (i + 1 < first_.size() ? first_[i + 1] : points_.size()) - first_[i];
  }
  [[nodiscard]] std::ptrdiff_t offset(std::size_t i) const {
    return static_cast<std::ptrdiff_t>(first_[i]);
  }

  const Volume& volume_;
  std::vector<std::size_t> first_;
  std::vector<glm::dvec3> points_;
  std::vector<double> weights_;  // #points_, or empty
};

/// Memory for one thread's searches.
struct Workspace {
  std::vector<std::int32_t> candidates;  // patches whose box holds the point, ascending
  BezierPatch patch;
};

/// Finds places in one volume.
class Locator {
 public:
  explicit Locator(const Volume& volume)
      : volume_(volume),
        patches_(volume),
        tree_(volume.patch_boxes()),
        exact_(kExact * volume.diagonal() + round_off(volume.rest_controls())),
        border_(kBorder * volume.diagonal()) {}

  [[nodiscard]] Location locate(const glm::dvec3& x, Workspace& workspace) const {
    workspace.candidates.clear();
    tree_.visit_overlapping(Box{x, x}.grown(border_), [&](std::size_t patch) {
      workspace.candidates.push_back(static_cast<std::int32_t>(patch));
    });
    std::sort(workspace.candidates.begin(), workspace.candidates.end());
    if (workspace.candidates.empty()) {
      return {};
    }
    const auto by_newton = [&](const BezierView& map) { return invert(map, x); };
    if (const auto found = search(workspace, exact_, by_newton)) {
      return *found;
    }
    bool may_be_missed = false;
    const auto by_subdivision = [&](double tolerance) {
      return search(workspace, tolerance, [&](const BezierView& map) {
        const auto found = invert_by_subdivision(map, x, tolerance);
        may_be_missed = may_be_missed || (found && !found->is_converged);
        return found;
      });
    };
    if (const auto found = by_subdivision(exact_)) {
      return *found;
    }
    if (const auto found = leaf_within_reach(x, workspace)) {
      return *found;
    }
    if (const auto found = by_subdivision(border_)) {
      return *found;
    }
    return {may_be_missed ? PointStatus::Unconverged : PointStatus::Outside, -1, glm::dvec3(0)};
  }

 private:
  [[nodiscard]] Location location(std::int32_t patch, const BezierView& map,
                                  const glm::dvec3& uvw) const {
    const bool is_border =
        is_near_boundary(volume_.patch(static_cast<std::size_t>(patch)), map, uvw, border_);
    return {is_border ? PointStatus::Border : PointStatus::Inside, patch, uvw};
  }

  /// The first candidate whose preimage of x is within the tolerance.
  template <class Inverter>
  [[nodiscard]] std::optional<Location> search(Workspace& workspace, double tolerance,
                                               const Inverter& inverter) const {
    for (const std::int32_t candidate : workspace.candidates) {
      const BezierView map = patches_.view(static_cast<std::size_t>(candidate), workspace.patch);
      const auto found = inverter(map);
      if (found && found->residual <= tolerance) {
        return location(candidate, map, found->uvw);
      }
    }
    return std::nullopt;
  }

  /// The leaf that x lies least beyond, the lowest of equals, by extrapolating its map.
  [[nodiscard]] std::optional<Location> leaf_within_reach(const glm::dvec3& x,
                                                          Workspace& workspace) const {
    std::optional<Location> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t candidate : workspace.candidates) {
      const auto i = static_cast<std::size_t>(candidate);
      if (!volume_.patch(i).is_leaf) {
        continue;
      }
      const BezierView map = patches_.view(i, workspace.patch);
      const auto found = invert(map, x, kLeafReach);
      if (!found || !(found->residual <= exact_)) {
        continue;
      }
      const glm::dvec3 uvw = held_by_boundary(volume_.patch(i), found->uvw);
      if (uvw != found->uvw && !(glm::distance(map.value(uvw), x) <= border_)) {
        continue;
      }
      const glm::dvec3 beyond = glm::max(-uvw, uvw - 1.0);
      const double overshoot = std::max({beyond.x, beyond.y, beyond.z});
      if (overshoot < least) {
        least = overshoot;
        best = location(candidate, map, uvw);
      }
    }
    return best;
  }

  /// uvw moved onto the faces of the volume's boundary that it lies beyond.
  [[nodiscard]] static glm::dvec3 held_by_boundary(const Patch& patch, glm::dvec3 uvw) {
    for (int axis = 0; axis < 3; ++axis) {
      if (patch.is_on_boundary(2 * axis)) {
        uvw[axis] = std::max(uvw[axis], 0.0);
      }
      if (patch.is_on_boundary(2 * axis + 1)) {
        uvw[axis] = std::min(uvw[axis], 1.0);
      }
    }
    return uvw;
  }

  const Volume& volume_;
  RestPatches patches_;
  BoxTree tree_;
  double exact_;
  double border_;
};

/// The held points, sorted by patch, then by point.
Binding sorted_by_patch(const std::vector<Location>& locations) {
  Binding binding;
  binding.status.reserve(locations.size());
  for (std::size_t i = 0; i < locations.size(); ++i) {
    binding.status.push_back(locations[i].status);
    if (locations[i].patch >= 0) {
      binding.points.push_back(static_cast<std::int32_t>(i));
    }
  }
  const auto location = [&](std::int32_t point) -> const Location& {
    return locations[static_cast<std::size_t>(point)];
  };
  std::stable_sort(
      binding.points.begin(), binding.points.end(),
      [&](std::int32_t a, std::int32_t b) { return location(a).patch < location(b).patch; });
  binding.patches.reserve(binding.points.size());
  binding.uvw.reserve(binding.points.size());
  for (const std::int32_t point : binding.points) {
    binding.patches.push_back(location(point).patch);
    binding.uvw.push_back(location(point).uvw);
  }
  return binding;
}

}  // namespace

std::string_view name_of(PointStatus status) {
  static constexpr std::array<std::string_view, 4> kNames = {"inside", "border", "outside",
                                                             "unconverged"};
  return kNames[static_cast<std::size_t>(status)];
}

StatusCounts Binding::counts() const {
  std::array<std::size_t, 4> n{};
  for (const PointStatus one : status) {
    ++n[static_cast<std::size_t>(one)];
  }
  return {n[0], n[1], n[2], n[3]};
}

Binding embed(const Volume& volume, std::span<const glm::dvec3> points, const Progress& progress) {
  constexpr std::size_t kPointsPerUpdate = 1 << 16;
  progress.update("embed", 0.0);
  const Locator locator(volume);
  std::vector<Location> locations(points.size());
  for (std::size_t first = 0; first < points.size(); first += kPointsPerUpdate) {
    const std::size_t n = std::min(kPointsPerUpdate, points.size() - first);
    parallel_ranges(n, 512, [&](std::size_t begin, std::size_t end) {
      Workspace workspace;
      for (std::size_t i = first + begin; i < first + end; ++i) {
        locations[i] = locator.locate(points[i], workspace);
      }
    });
    progress.update("embed", static_cast<double>(first + n) / static_cast<double>(points.size()));
  }
  return sorted_by_patch(locations);
}

}  // namespace espalier
