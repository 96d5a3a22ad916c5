#pragma once

/// Patches that are boxes with parallel axes: the patch of a point without a search.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "lattice/core/box.h"
#include "lattice/volume/rest_patches.h"

namespace espalier {

/// Intervals on a line, and which of them holds a number, in O(1) where they are of like lengths
/// and in O(log n) in any case.
class IntervalTable {
 public:
  IntervalTable() = default;
  /// Between neighbours of `bounds` less `margin` at both ends. bounds: ascending, at least two.
  IntervalTable(std::vector<double> bounds, double margin);

  [[nodiscard]] std::size_t n_intervals() const { return n_intervals_; }
  /// The interval with x inside, by more than the margin; -1: none.
  [[nodiscard]] std::int32_t find(double x) const {
    const double at = (x - bounds_.front()) * buckets_per_length_;
    if (!(at >= 0 && at < static_cast<double>(first_.size()))) {
      return -1;
    }
    auto i = static_cast<std::size_t>(first_[static_cast<std::size_t>(at)]);
    i += bounds_[i + 1] <= x ? 1 : 0;  // without a branch: nobody could guess it
    if (bounds_[i + 1] <= x) {
      i = last_not_above(x);
    }
    const bool is_inside = x > bounds_[i] + margin_ && x < bounds_[i + 1] - margin_;
    return is_inside && i < n_intervals_ ? static_cast<std::int32_t>(i) : -1;
  }

 private:
  [[nodiscard]] std::size_t last_not_above(double x) const;

  std::vector<double> bounds_;  // and two that are infinite
  std::size_t n_intervals_ = 0;
  double margin_ = 0;
  double buckets_per_length_ = 0;
  std::vector<std::int32_t> first_;  // a bucket: the last bound before it, or 0
};

/// Finds places in a volume whose patches are affine boxes with parallel axes, as those of lattices
/// that are at rest undeformed: the bounds of all boxes along their axes make a rectilinear grid,
/// and a table tells the patch that covers a cell of it.
class PatchGrid {
 public:
  /// A place inside a patch.
  struct Place {
    std::int32_t patch = -1;
    glm::dvec3 uvw{0};  ///< in (0,1)³, with the bits that the patch's frame gives
  };

  /// Empty: finds nothing.
  PatchGrid() = default;
  /// Empty if the patches are no such boxes, are too oblique, or would need far more cells than
  /// there are patches. margin: a length around the bounds where nothing is found, far above
  /// round-off. O(#patches log #patches).
  PatchGrid(const RestPatches& patches, double margin);

  [[nodiscard]] bool is_empty() const { return cells_.empty(); }

  /// The patch that holds x, if x is farther than about the margin from every bound, and one patch
  /// only holds it; else -1, and x may be anywhere. Not for an empty grid. O(1).
  [[nodiscard]] std::int32_t find_patch(const glm::dvec3& x) const {
    const glm::dvec3 at = to_frame_ * (x - origin_);
    const std::int32_t i = intervals_[0].find(at.x);
    const std::int32_t j = intervals_[1].find(at.y);
    const std::int32_t k = intervals_[2].find(at.z);
    return (i | j | k) < 0 ? -1 : cells_[cell(i, j, k)];
  }

  /// Where in a patch that find_patch() gave x is.
  [[nodiscard]] glm::dvec3 uvw_in(std::int32_t patch, const glm::dvec3& x) const {
    const ToLocal& local = to_local_[static_cast<std::size_t>(patch)];
    return local.inverse * (x - local.centre) + 0.5;
  }

  /// Both; nothing if the grid is empty.
  [[nodiscard]] std::optional<Place> find(const glm::dvec3& x) const {
    const std::int32_t patch = cells_.empty() ? -1 : find_patch(x);
    return patch < 0 ? std::nullopt : std::optional(Place{patch, uvw_in(patch, x)});
  }

 private:
  /// As PatchFrame::local().
  struct ToLocal {
    glm::dmat3 inverse{0};
    glm::dvec3 centre{0};
  };
  [[nodiscard]] std::size_t cell(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const auto along = [](std::int32_t n) { return static_cast<std::size_t>(n); };
    return along(i) +
           intervals_[0].n_intervals() * (along(j) + intervals_[1].n_intervals() * along(k));
  }

  /// Of the first patch; false if it is no box, or too oblique.
  [[nodiscard]] bool set_frame(const RestPatches& patches);
  /// The patches in the frame; false if one is no box there.
  [[nodiscard]] bool set_boxes(const RestPatches& patches, double tolerance,
                               std::vector<Box>& boxes);
  [[nodiscard]] bool set_cells(const std::vector<Box>& boxes,
                               const std::array<std::vector<double>, 3>& bounds);

  glm::dvec3 origin_{0};
  glm::dmat3 to_frame_{0};  // the frame's coordinates are lengths along the patches' axes
  std::array<IntervalTable, 3> intervals_;
  std::vector<std::int32_t> cells_;  // u fastest: the patch, kNone or kSeveral
  std::vector<ToLocal> to_local_;    // #patches
};

}  // namespace espalier
