// The cells between the bounds of boxes with parallel axes.

#include "lattice/volume/patch_grid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::int32_t kNone = -1;
constexpr std::int32_t kSeveral = -2;

/// Of length along an axis to distance from the faces across it: more would cost digits.
constexpr double kMostOblique = 4;
/// As many cells as this times the patches, at most, and a few.
constexpr std::size_t kMostCellsAPatch = 64;
constexpr std::size_t kFewCells = 4096;

/// Of the margin: bounds nearer to each other count as one. Points that near are not looked at.
constexpr double kTolerance = 0.125;

constexpr std::size_t kBucketsAnInterval = 2;

PatchFrame frame_of(const RestPatches& patches, std::size_t i, BezierPatch& scratch) {
  const PatchFrame* kept = patches.frame(i);
  return kept != nullptr ? *kept : PatchFrame(patches.view(i, scratch));
}

/// Whether each column, a length, is along an axis of the frame, each along another.
bool is_along_axes(const glm::dmat3& columns, double tolerance) {
  int axes = 0;
  for (int a = 0; a < 3; ++a) {
    const glm::dvec3 length = glm::abs(columns[a]);
    const int axis =
        length.x > length.y ? (length.x > length.z ? 0 : 2) : (length.y > length.z ? 1 : 2);
    axes |= 1 << axis;
    if (!(length.x + length.y + length.z - length[axis] <= tolerance)) {
      return false;
    }
  }
  return axes == 7;
}

/// Ascending, without those within the tolerance of one before.
std::vector<double> distinct(std::vector<double> bounds, double tolerance) {
  std::sort(bounds.begin(), bounds.end());
  std::size_t n = 0;
  for (const double bound : bounds) {
    if (n == 0 || bound - bounds[n - 1] > tolerance) {
      bounds[n++] = bound;
    }
  }
  bounds.resize(n);
  return bounds;
}

/// The bound that x, which was one, counts as.
std::size_t index_of(const std::vector<double>& bounds, double x) {
  const auto after = std::upper_bound(bounds.begin(), bounds.end(), x);
  return static_cast<std::size_t>(after - bounds.begin()) - 1;
}

/// Cells between bounds.
struct Range {
  std::array<std::size_t, 3> first{};
  std::array<std::size_t, 3> end{};
  [[nodiscard]] std::size_t size() const {
    return (end[0] - first[0]) * (end[1] - first[1]) * (end[2] - first[2]);
  }
};

Range range_of(const Box& box, const std::array<std::vector<double>, 3>& bounds) {
  Range range;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range.first[axis] = index_of(bounds[axis], box.min[static_cast<int>(axis)]);
    range.end[axis] = index_of(bounds[axis], box.max[static_cast<int>(axis)]);
  }
  return range;
}

}  // namespace

IntervalTable::IntervalTable(std::vector<double> bounds, double margin)
    : bounds_(std::move(bounds)), n_intervals_(bounds_.size() - 1), margin_(margin) {
  const std::size_t n_buckets = kBucketsAnInterval * n_intervals_;
  buckets_per_length_ = static_cast<double>(n_buckets) / (bounds_.back() - bounds_.front());
  // Bounds are put into buckets as find() does it, so that round-off cannot part the two.
  first_.reserve(n_buckets);
  for (std::size_t i = 0; i <= n_intervals_; ++i) {
    const double at = (bounds_[i] - bounds_.front()) * buckets_per_length_;
    const auto last = std::min(static_cast<std::size_t>(at), n_buckets - 1);
    first_.resize(std::max(first_.size(), last + 1), static_cast<std::int32_t>(i == 0 ? 0 : i - 1));
  }
  bounds_.insert(bounds_.end(), 2, std::numeric_limits<double>::infinity());
}

std::size_t IntervalTable::last_not_above(double x) const {
  return static_cast<std::size_t>(std::upper_bound(bounds_.begin(), bounds_.end(), x) -
                                  bounds_.begin()) -
         1;
}

bool PatchGrid::set_frame(const RestPatches& patches) {
  BezierPatch scratch;
  const PatchFrame frame = frame_of(patches, 0, scratch);
  if (!frame.is_affine()) {
    return false;
  }
  origin_ = frame.map().centre;
  for (int axis = 0; axis < 3; ++axis) {
    to_frame_[axis] = glm::normalize(frame.map().axes[axis]);
  }
  to_frame_ = glm::inverse(to_frame_);
  const glm::dmat3 rows = glm::transpose(to_frame_);
  return glm::length(rows[0]) <= kMostOblique && glm::length(rows[1]) <= kMostOblique &&
         glm::length(rows[2]) <= kMostOblique;
}

bool PatchGrid::set_boxes(const RestPatches& patches, double tolerance, std::vector<Box>& boxes) {
  boxes.resize(patches.size());
  to_local_.resize(patches.size());
  std::atomic<bool> is_grid = true;
  parallel_ranges(patches.size(), 256, [&](std::size_t begin, std::size_t end) {
    BezierPatch scratch;
    for (std::size_t i = begin; i < end && is_grid.load(std::memory_order_relaxed); ++i) {
      const PatchFrame frame = frame_of(patches, i, scratch);
      const glm::dmat3 axes = to_frame_ * frame.map().axes;
      if (!frame.is_affine() || !is_along_axes(axes, tolerance)) {
        is_grid = false;
      }
      const glm::dvec3 centre = to_frame_ * (frame.map().centre - origin_);
      const glm::dvec3 half = 0.5 * (glm::abs(axes[0]) + glm::abs(axes[1]) + glm::abs(axes[2]));
      boxes[i] = {centre - half, centre + half};
      to_local_[i] = {frame.inverse_axes(), frame.map().centre};
    }
  });
  return is_grid;
}

bool PatchGrid::set_cells(const std::vector<Box>& boxes,
                          const std::array<std::vector<double>, 3>& bounds) {
  const std::size_t most = kMostCellsAPatch * boxes.size() + kFewCells;
  std::array<std::size_t, 3> n{};
  std::size_t n_cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    n[axis] = bounds[axis].size() - 1;
    if (n[axis] == 0 || n[axis] > most / n_cells) {
      return false;
    }
    n_cells *= n[axis];
  }
  cells_.assign(n_cells, kNone);
  std::size_t room = 2 * n_cells;  // boxes that overlap everywhere are not worth the time
  for (std::size_t patch = 0; patch < boxes.size(); ++patch) {
    const Range range = range_of(boxes[patch], bounds);
    if (range.size() > room) {
      return false;
    }
    room -= range.size();
    for (std::size_t k = range.first[2]; k < range.end[2]; ++k) {
      for (std::size_t j = range.first[1]; j < range.end[1]; ++j) {
        for (std::size_t i = range.first[0]; i < range.end[0]; ++i) {
          std::int32_t& cell = cells_[i + n[0] * (j + n[1] * k)];
          cell = cell == kNone ? static_cast<std::int32_t>(patch) : kSeveral;
        }
      }
    }
  }
  return true;
}

PatchGrid::PatchGrid(const RestPatches& patches, double margin) {
  const double tolerance = kTolerance * margin;
  std::vector<Box> boxes;
  if (patches.size() == 0 || !set_frame(patches) || !set_boxes(patches, tolerance, boxes)) {
    *this = PatchGrid();
    return;
  }
  std::array<std::vector<double>, 3> bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Box& box : boxes) {
      bounds[axis].push_back(box.min[static_cast<int>(axis)]);
      bounds[axis].push_back(box.max[static_cast<int>(axis)]);
    }
    bounds[axis] = distinct(std::move(bounds[axis]), tolerance);
  }
  if (!set_cells(boxes, bounds)) {
    *this = PatchGrid();
    return;
  }
  // A coordinate changes by at most its row times a length.
  const glm::dmat3 rows = glm::transpose(to_frame_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    intervals_[axis] =
        IntervalTable(std::move(bounds[axis]), glm::length(rows[static_cast<int>(axis)]) * margin);
  }
}

}  // namespace espalier
