// Finding points in a volume: a grid of boxes or a tree, closed-form guesses, Newton's method,
// subdivision.

#include "lattice/volume/point_locator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>

#include "lattice/core/parallel.h"
#include "lattice/core/spatial_order.h"
#include "lattice/volume/bezier_inverse.h"

namespace espalier {
namespace {

/// Relative to the lattice's diagonal: round-off of an exact solution, and the closed border.
constexpr double kExact = 1e-14;
constexpr double kBorder = 1e-9;

/// Of a sum of coordinates as large as these.
double round_off(std::span<const glm::dvec3> points) {
  const Box box = box_of(points);
  const glm::dvec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
  return 8 * std::numeric_limits<double>::epsilon() * std::max({largest.x, largest.y, largest.z});
}

/// A patch's preimage of x, in [0,1]³: in closed form if the patch is affine, else by Newton's
/// method.
std::optional<Preimage> invert_in(const PatchFrame& frame, const BezierView& map,
                                  const glm::dvec3& x, const glm::dvec3& local) {
  if (frame.is_affine()) {
    const glm::dvec3 uvw = glm::clamp(local, 0.0, 1.0);
    return Preimage{uvw, glm::distance(frame.map().value(uvw), x), true, 0};
  }
  return invert_from(map, x, frame.guess_from(local));
}

/// uvw moved onto the faces of the volume's boundary that it lies beyond.
glm::dvec3 held_by_boundary(const Patch& patch, glm::dvec3 uvw) {
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

/// Points that are searched at a time, and by one thread.
constexpr std::size_t kChunk = std::size_t{1} << 15;
constexpr std::size_t kGrain = 512;
/// How many points before it is asked for a point is fetched from memory.
constexpr std::size_t kAhead = 24;

/// Calls work(numbers) for all points, a chunk at a time: neighbours one after the other, or as
/// they are, if they need no search that would gain from it.
template <class Work>
void for_each_chunk(std::span<const glm::dvec3> points, bool as_they_are, const Progress& progress,
                    const Work& work) {
  std::vector<std::size_t> chunk;
  for (std::size_t first = 0; first < points.size(); first += kChunk) {
    const std::size_t n = std::min(kChunk, points.size() - first);
    chunk.resize(n);
    if (as_they_are) {
      std::iota(chunk.begin(), chunk.end(), first);
    } else {
      const std::vector<std::uint32_t> order = spatial_order(points.subspan(first, n));
      std::transform(order.begin(), order.end(), chunk.begin(),
                     [&](std::uint32_t i) { return first + i; });
    }
    work(std::span<const std::size_t>(chunk));
    progress.update("embed", static_cast<double>(first + n) / static_cast<double>(points.size()));
  }
}

}  // namespace

std::string_view name_of(PointStatus status) {
  static constexpr std::array<std::string_view, 4> kNames = {"inside", "border", "outside",
                                                             "unconverged"};
  return kNames[static_cast<std::size_t>(status)];
}

/// The search for one point. Its memory is kept from point to point.
class PointLocator::Query {
 public:
  explicit Query(const PointLocator& locator) : locator_(locator), volume_(*locator.volume_) {}

  [[nodiscard]] Location locate(const glm::dvec3& x) {
    x_ = x;
    find_candidates();
    if (candidates_.empty()) {
      return {};
    }
    if (const auto found = search(locator_.exact_, [&](const Map& map) {
          return invert_in(*map.frame, map.view, x_, map.frame->local(x_));
        })) {
      return *found;
    }
    may_be_missed_ = false;
    if (const auto found = by_subdivision(locator_.exact_)) {
      return *found;
    }
    if (const auto found = leaf_within_reach()) {
      return *found;
    }
    if (const auto found = by_subdivision(locator_.border_)) {
      return *found;
    }
    return {may_be_missed_ ? PointStatus::Unconverged : PointStatus::Outside, -1, glm::dvec3(0), 0};
  }

 private:
  /// A candidate at rest.
  struct Map {
    BezierView view;
    const PatchFrame* frame;
  };

  /// The patches that may hold x or lie within the border of it, ascending.
  void find_candidates() {
    candidates_.clear();
    locator_.tree_.visit_overlapping(Box{x_, x_}.grown(locator_.border_), [&](std::size_t patch) {
      const PatchFrame* frame = locator_.patches_.frame(patch);
      if (frame == nullptr || frame->may_hold(frame->local(x_))) {
        candidates_.push_back(static_cast<std::int32_t>(patch));
      }
    });
    std::sort(candidates_.begin(), candidates_.end());
  }

  [[nodiscard]] Map map_of(std::int32_t candidate) {
    const auto i = static_cast<std::size_t>(candidate);
    const BezierView view = locator_.patches_.view(i, patch_);
    const PatchFrame* frame = locator_.patches_.frame(i);
    if (frame == nullptr) {
      frame_ = PatchFrame(view);
      frame = &frame_;
    }
    return {view, frame};
  }

  /// The first candidate whose preimage of x is within the tolerance.
  template <class Inverter>
  [[nodiscard]] std::optional<Location> search(double tolerance, const Inverter& inverter) {
    for (const std::int32_t candidate : candidates_) {
      const Map map = map_of(candidate);
      const auto found = inverter(map);
      if (found && found->residual <= tolerance) {
        return location(candidate, map, *found);
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Location> by_subdivision(double tolerance) {
    return search(tolerance, [&](const Map& map) -> std::optional<Preimage> {
      if (map.frame->is_affine()) {
        return invert_in(*map.frame, map.view, x_, map.frame->local(x_));
      }
      const auto found = invert_by_subdivision(map.view, x_, tolerance);
      may_be_missed_ = may_be_missed_ || (found && !found->is_converged);
      return found;
    });
  }

  [[nodiscard]] Location location(std::int32_t candidate, const Map& map,
                                  const Preimage& found) const {
    const Patch& patch = volume_.patch(static_cast<std::size_t>(candidate));
    const bool is_border = is_near_boundary(patch, map, found.uvw);
    return {is_border ? PointStatus::Border : PointStatus::Inside, candidate, found.uvw,
            found.n_steps};
  }

  /// Whether the value at uvw is within the border of the volume's boundary.
  [[nodiscard]] bool is_near_boundary(const Patch& patch, const Map& map,
                                      const glm::dvec3& uvw) const {
    std::optional<glm::dvec3> at;
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      const double step = std::abs(face % 2 - uvw[axis]);
      if (!patch.is_on_boundary(face) ||
          (!patch.is_leaf && map.frame->least_distance(axis, step) > 2 * locator_.border_)) {
        continue;
      }
      if (!at) {
        at = map.view.value(uvw);
      }
      glm::dvec3 on_face = uvw;
      on_face[axis] = face % 2;
      if (glm::distance(map.view.value(on_face), *at) <= locator_.border_) {
        return true;
      }
    }
    return false;
  }

  /// The leaf that x lies least beyond, the lowest of equals, by extrapolating its map.
  [[nodiscard]] std::optional<Location> leaf_within_reach() {
    std::optional<Location> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t candidate : candidates_) {
      const Patch& patch = volume_.patch(static_cast<std::size_t>(candidate));
      if (!patch.is_leaf) {
        continue;
      }
      const Map map = map_of(candidate);
      auto found = invert_from(map.view, x_, map.frame->guess(x_), kLeafReach);
      if (!found || !(found->residual <= locator_.exact_)) {
        continue;
      }
      const glm::dvec3 uvw = held_by_boundary(patch, found->uvw);
      if (uvw != found->uvw && !(glm::distance(map.view.value(uvw), x_) <= locator_.border_)) {
        continue;
      }
      found->uvw = uvw;
      // As a length: leaves along a line are far longer than they are wide.
      const double beyond = glm::distance(map.view.value(glm::clamp(uvw, 0.0, 1.0)), x_);
      if (beyond < least) {
        least = beyond;
        best = location(candidate, map, *found);
      }
    }
    return best;
  }

  const PointLocator& locator_;
  const Volume& volume_;
  glm::dvec3 x_{0};
  std::vector<std::int32_t> candidates_;
  BezierPatch patch_;  // memory for a trilinear candidate, and its frame
  PatchFrame frame_;
  bool may_be_missed_ = false;
};

PointLocator::PointLocator(const Volume& volume, PatchSearch search)
    : volume_(&volume),
      exact_(kExact * volume.diagonal() + round_off(volume.rest_controls())),
      border_(kBorder * volume.diagonal()),
      patches_(volume, 2 * border_),
      grid_(search == PatchSearch::Tree ? PatchGrid()
                                        : PatchGrid(patches_, 2 * border_ + 4 * exact_)),
      tree_(volume.patch_boxes()) {}

Location PointLocator::locate(const glm::dvec3& x) const {
  if (const auto inside = grid_.find(x)) {
    return {PointStatus::Inside, inside->patch, inside->uvw, 0};
  }
  return Query(*this).locate(x);
}

std::vector<Location> PointLocator::locate(std::span<const glm::dvec3> points,
                                           const Progress& progress) const {
  std::vector<Location> locations(points.size());
  for_each_chunk(points, !grid_.is_empty(), progress, [&](std::span<const std::size_t> chunk) {
    parallel_ranges(chunk.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Query query(*this);
      for (const std::size_t i : chunk.subspan(begin, end - begin)) {
        if (const auto inside = grid_.find(points[i])) {
          locations[i] = {PointStatus::Inside, inside->patch, inside->uvw, 0};
        } else {
          locations[i] = query.locate(points[i]);
        }
      }
    });
  });
  return locations;
}

/// The steps of hold(): finds the patch of every point, brings the points in order, and then places
/// them, so that little is written before it is where it belongs.
class PointLocator::Holding {
 public:
  Holding(const PointLocator& locator, std::span<const glm::dvec3> points)
      : locator_(locator), points_(points), codes_(points.size()) {
    result_.status.resize(points.size());
  }

  [[nodiscard]] HeldPoints run(const Progress& progress) {
    for_each_chunk(points_, !locator_.grid_.is_empty(), progress,
                   [&](std::span<const std::size_t> chunk) { find_patches(chunk); });
    sort_by_patch();
    find_places();
    return std::move(result_);
  }

 private:
  /// A point that takes more than the grid.
  struct Other {
    std::size_t point;
    std::int32_t patch;
    glm::dvec3 uvw;
  };

  /// A code is the patch that the grid gave, kNoPatch, or below that one for each of others_.
  static constexpr std::int32_t kNoPatch = -1;
  [[nodiscard]] static std::size_t other_of(std::int32_t code) {
    return static_cast<std::size_t>(kNoPatch - 1 - code);
  }
  [[nodiscard]] std::int32_t patch_of(std::int32_t code) const {
    return code >= kNoPatch ? code : others_[other_of(code)].patch;
  }

  void find_patches(std::span<const std::size_t> chunk) {
    const PatchGrid& grid = locator_.grid_;
    const bool has_grid = !grid.is_empty();
    std::vector<std::vector<Other>> others((chunk.size() + kGrain - 1) / kGrain);
    parallel_ranges(chunk.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Query query(locator_);
      for (const std::size_t i : chunk.subspan(begin, end - begin)) {
        codes_[i] = has_grid ? std::max(grid.find_patch(points_[i]), kNoPatch) : kNoPatch;
        if (codes_[i] == kNoPatch) {
          const Location found = query.locate(points_[i]);
          result_.status[i] = found.status;
          if (found.patch >= 0) {
            others[begin / kGrain].push_back({i, found.patch, found.uvw});
          }
        }
      }
    });
    for (const std::vector<Other>& of_range : others) {
      for (const Other& other : of_range) {
        codes_[other.point] = kNoPatch - 1 - static_cast<std::int32_t>(others_.size());
        others_.push_back(other);
      }
    }
  }

  /// Numbers and patches; only numbers are moved to where they belong.
  void sort_by_patch() {
    std::vector<std::size_t> next(locator_.volume_->n_patches() + 1, 0);  // where a patch's next is
    for (const std::int32_t code : codes_) {
      if (code != kNoPatch) {
        ++next[static_cast<std::size_t>(patch_of(code)) + 1];
      }
    }
    result_.patches.reserve(points_.size());
    for (std::size_t patch = 0; patch + 1 < next.size(); ++patch) {
      result_.patches.insert(result_.patches.end(), next[patch + 1],
                             static_cast<std::int32_t>(patch));
      next[patch + 1] += next[patch];
    }
    result_.points.resize(next.back());
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      if (codes_[i] != kNoPatch) {
        result_.points[next[static_cast<std::size_t>(patch_of(codes_[i]))]++] =
            static_cast<std::int32_t>(i);
      }
    }
  }

  void find_places() {
    const PatchGrid& grid = locator_.grid_;
    result_.uvw.resize(result_.points.size());
    parallel_ranges(result_.points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto i = static_cast<std::size_t>(result_.points[k]);
        if (grid.is_empty()) {
          result_.uvw[k] = others_[other_of(codes_[i])].uvw;
          continue;
        }
        if (k + kAhead < end) {
          __builtin_prefetch(&points_[static_cast<std::size_t>(result_.points[k + kAhead])]);
        }
        result_.uvw[k] = grid.uvw_in(result_.patches[k], points_[i]);
      }
    });
    for (std::size_t n = 0; n < others_.size() && !grid.is_empty(); ++n) {
      result_.uvw[place_of(others_[n])] = others_[n].uvw;
    }
  }

  /// Where a point is among those held.
  [[nodiscard]] std::size_t place_of(const Other& other) const {
    const auto patch = std::ranges::equal_range(result_.patches, other.patch);
    const auto first = result_.points.begin() + (patch.begin() - result_.patches.begin());
    const auto last = first + static_cast<std::ptrdiff_t>(patch.size());
    return static_cast<std::size_t>(
        std::lower_bound(first, last, static_cast<std::int32_t>(other.point)) -
        result_.points.begin());
  }

  const PointLocator& locator_;
  std::span<const glm::dvec3> points_;
  std::vector<std::int32_t> codes_;  // #points
  std::vector<Other> others_;
  HeldPoints result_;
};

HeldPoints PointLocator::hold(std::span<const glm::dvec3> points, const Progress& progress) const {
  return Holding(*this, points).run(progress);
}

}  // namespace espalier
