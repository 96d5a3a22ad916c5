/// Drags by one displacement. [THB18] section 3, with the determinant lemma in place of trials.

#include "deform/evaluate/drag.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <string>

#include "deform/evaluate/packed_turn.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/core/streamed_copy.h"

namespace espalier {
namespace {

/// A step where a drag stopped is safe once more: it may be longer by this part, from round-off.
constexpr double kSameStep = 1e-9;
constexpr double kFarthest = 1e12;  // diagonals
/// No thread is worth starting for fewer.
constexpr std::size_t kPointsPerThread = 65536;

/// The first row.
glm::dvec3 slope_of_x(const glm::dmat3& slope) {
  return {slope[0].x, slope[1].x, slope[2].x};
}

template <class Real>
void put(AlignedVector<Real>& rows, std::size_t at, const glm::dvec3& vector) {
  for (int c = 0; c < 3; ++c) {
    rows[at + static_cast<std::size_t>(c) * kDragBlock] = static_cast<Real>(vector[c]);
  }
}

template <class Real>
Real* numbers(std::span<glm::vec<3, Real>> points, std::size_t first) {
  return points.empty() ? nullptr : glm::value_ptr(points[first]);
}

}  // namespace

template <class Real>
Drag<Real>::Drag(const DragModel& model, std::span<const double> selection, InstructionSet set)
    : kernels_(&drag_kernels<Real>(set)),
      exact_kernels_(&drag_kernels<double>(set)),
      n_points_(model.rest_points.size()),
      has_folds_(model.has_fold_check) {
  require_valid(model, selection);
  const double diagonal = model.volume().diagonal();
  farthest_ = kFarthest * diagonal;
  // As long as the lattice, so that round-off of J is small beside the slope; a power of two.
  const double unit = diagonal > 0 ? std::exp2(std::ilogb(diagonal)) : 1;
  std::vector<glm::dvec3> vectors(selection.size());
  std::transform(selection.begin(), selection.end(), vectors.begin(),
                 [unit](double weight) { return glm::dvec3(unit * weight, 0, 0); });
  const DragStart start = drag_start(model);
  const DragField field = drag_field(model, vectors);
  std::vector<char> is_reached(n_points_);
  for (std::size_t i = 0; i < n_points_; ++i) {
    is_reached[i] =
        static_cast<char>(field.values[i].x != 0 ||
                          (!field.slopes.empty() && slope_of_x(field.slopes[i]) != glm::dvec3(0)));
  }
  add_runs(is_reached);
  fill_places(start, field, unit);
  if (!model.normals.empty()) {
    fill_turns(start, field, unit, model.normals);
  }
  if (has_folds_) {
    fill_folds(start, field, unit);
  }
}

template <class Real>
void Drag<Real>::add_runs(std::span<const char> is_reached) {
  std::uint32_t n_blocks = 0;
  for (std::size_t first = 0; first < n_points_; first += kDragBlock) {
    std::uint16_t lanes = 0;
    for (std::size_t i = first; i < std::min(first + kDragBlock, n_points_); ++i) {
      lanes = static_cast<std::uint16_t>(lanes | (is_reached[i] != 0 ? 1U : 0U) << (i - first));
    }
    if (lanes == 0) {
      continue;
    }
    const bool is_joined = lanes == kAllLanes && !runs_.empty() &&
                           runs_.back().lanes == kAllLanes && runs_.back().n_blocks < kMostBlocks &&
                           runs_.back().first_point + runs_.back().n_blocks * kDragBlock == first;
    if (is_joined) {
      ++runs_.back().n_blocks;
    } else {
      runs_.push_back({n_blocks, 1, static_cast<std::uint32_t>(first), lanes});
    }
    ++n_blocks;
  }
}

template <class Real>
template <class Visit>
void Drag<Real>::for_each_reached(std::size_t n_rows, const Visit& visit) const {
  for (const Run& run : runs_) {
    for (std::size_t i = 0; i < run.n_blocks * kDragBlock; ++i) {
      if ((run.lanes >> i % kDragBlock & 1) != 0) {
        visit(run.first_point + i,
              (run.first_block + i / kDragBlock) * n_rows * kDragBlock + i % kDragBlock);
      }
    }
  }
}

template <class Real>
void Drag<Real>::fill_places(const DragStart& start, const DragField& field, double unit) {
  const std::size_t n_blocks = runs_.empty() ? 0 : runs_.back().first_block + runs_.back().n_blocks;
  places_.assign(n_blocks * kDragPlaceRows * kDragBlock, 0);
  for_each_reached(kDragPlaceRows, [&](std::size_t point, std::size_t at) {
    const std::size_t lane = at % kDragBlock;
    for (int c = 0; c < 3; ++c) {
      places_[at + 2 * lane + static_cast<std::size_t>(c)] =
          static_cast<Real>(start.points[point][c]);
    }
    places_[at + 3 * kDragBlock] = static_cast<Real>(field.values[point].x / unit);
  });
}

template <class Real>
void Drag<Real>::fill_turns(const DragStart& start, const DragField& field, double unit,
                            std::span<const glm::dvec3> normals) {
  turns_.assign(places_.size() / kDragPlaceRows * kDragTurnRows, 0);
  for_each_reached(kDragTurnRows, [&](std::size_t point, std::size_t at) {
    const glm::dmat3& J = start.gradients[point];
    const glm::dvec3 g = slope_of_x(field.slopes[point]) / unit;
    const auto turn =
        packed_turn<Real>(cofactors(J) * normals[point], J * glm::cross(normals[point], g), unit);
    turns_[at] = turn.x;
    turns_[at + kDragBlock] = turn.y;
    turns_[at + 2 * kDragBlock] = turn.qx;
    turns_[at + 3 * kDragBlock] = turn.qy;
  });
}

template <class Real>
void Drag<Real>::fill_folds(const DragStart& start, const DragField& field, double unit) {
  exact_folds_.assign(places_.size() / kDragPlaceRows * kDragFoldRows, 0);
  for_each_reached(kDragFoldRows, [&](std::size_t point, std::size_t at) {
    const glm::dmat3& J = start.gradients[point];
    const glm::dvec3 g = slope_of_x(field.slopes[point]) / unit;
    const glm::dvec3 slope = cofactors(J) * g;
    const double determinant = glm::determinant(J);
    if (!(determinant >= kLeastDeterminant)) {
      folded_.push_back({static_cast<std::uint32_t>(point), determinant, slope});
    } else {
      put(exact_folds_, at, slope / determinant);
      steepest_ = std::max(steepest_, glm::length(slope) / determinant);
    }
  });
  folds_.assign(exact_folds_.begin(), exact_folds_.end());
  fill_slope_boxes();
}

template <class Real>
void Drag<Real>::fill_slope_boxes() {
  slope_boxes_.resize((folds_.size() + kSegment - 1) / kSegment);
  for (std::size_t at = 0; at < folds_.size(); ++at) {
    SlopeBox& box = slope_boxes_[at / kSegment];
    const auto c = static_cast<int>(at / kDragBlock % kDragFoldRows);
    box.low[c] = std::min(box.low[c], folds_[at]);
    box.high[c] = std::max(box.high[c], folds_[at]);
  }
}

template <class Real>
Real Drag<Real>::SlopeBox::largest_fall(const glm::vec<3, Real>& d) const {
  const glm::vec<3, Real> falls = glm::max(-d * low, -d * high);
  return falls.x + falls.y + falls.z;
}

template <class Real>
std::size_t Drag<Real>::n_blocks_of_segment(std::size_t segment) const {
  return std::min(kSegment, folds_.size() - segment * kSegment) / (kDragFoldRows * kDragBlock);
}

template <class Real>
double Drag<Real>::find_falls(const glm::vec<3, Real>& d, double least, double rounding,
                              std::span<Real> falls) const {
  std::transform(slope_boxes_.begin(), slope_boxes_.end(), falls.begin(),
                 [&d](const SlopeBox& box) { return box.largest_fall(d); });
  double largest = 0;
  const auto look_at = [&](std::size_t segment) {
    falls[segment] = kernels_->largest_fall(&folds_[segment * kSegment],
                                            n_blocks_of_segment(segment), glm::value_ptr(d));
    largest = std::max(largest, static_cast<double>(falls[segment]));
  };
  const auto may_count = [&](Real fall) {
    return static_cast<double>(fall) + 3 * rounding >= std::max(least, largest);
  };
  const auto first = std::max_element(falls.begin(), falls.end());
  if (first == falls.end() || !may_count(*first)) {
    return 0;
  }
  look_at(static_cast<std::size_t>(first - falls.begin()));
  for (std::size_t i = 0; i < falls.size(); ++i) {
    if (may_count(falls[i])) {
      look_at(i);
    }
  }
  return largest;
}

template <class Real>
double Drag<Real>::safe_fraction(const glm::dvec3& displacement, double margin) const {
  require_near(displacement);
  require_margin(margin);
  if (!has_folds_) {
    throw ParameterError("the drag was begun without a fold check");
  }
  const std::size_t n_segments = slope_boxes_.size();
  thread_local std::vector<Real> falls;
  falls.resize(n_segments);
  const double rounding =
      8 * std::numeric_limits<Real>::epsilon() * steepest_ * glm::length(displacement);
  const double limit = (1 - margin) * (1 - kFoldGuard);
  const double rounded = find_falls(glm::vec<3, Real>(displacement), limit, rounding, falls);
  if (rounded + rounding < limit) {
    return 1;
  }
  double fall = 0;
  for (std::size_t i = 0; i < n_segments; ++i) {
    if (static_cast<double>(falls[i]) + 2 * rounding >= rounded) {
      fall = std::max(
          fall, exact_kernels_->largest_fall(&exact_folds_[i * kSegment], n_blocks_of_segment(i),
                                             glm::value_ptr(displacement)));
    }
  }
  return fall > (1 + kSameStep) * limit ? limit / fall : 1;
}

template <class Real>
DragStep Drag<Real>::update(const glm::dvec3& displacement, std::optional<double> margin,
                            const DraggedPoints<Real>& out) const {
  require_near(displacement);
  require_possible(out);
  DragStep step;
  step.fraction = margin ? safe_fraction(displacement, *margin) : 1;
  step.displacement = step.fraction * displacement;
  const glm::vec<3, Real> d(step.displacement);
  const std::size_t n_ranges = std::max<std::size_t>(1, n_points_ / kPointsPerThread);
  const bool streams = is_streamed(out);
  const auto write_run = [&](std::size_t i) {
    if (streams) {
      write_streamed(runs_[i], glm::value_ptr(d), out);
    } else {
      write(runs_[i], glm::value_ptr(d), out);
    }
  };
  parallel_for(runs_.size(), write_run, runs_.size() / n_ranges + 1);
  if (!out.folded.empty()) {
    mark(step.displacement, out.folded);
  }
  return step;
}

template <class Real>
void Drag<Real>::write(const Run& run, const Real* displacement,
                       const DraggedPoints<Real>& out) const {
  if (run.lanes != kAllLanes) {
    write_part(run, displacement, out);
    return;
  }
  const std::size_t first = run.first_block * kDragBlock;
  const DragBlocks<Real> blocks = {
      .n_blocks = run.n_blocks,
      .places = &places_[first * kDragPlaceRows],
      .turns = turns_.empty() ? nullptr : &turns_[first * kDragTurnRows],
      .points = numbers(out.points, run.first_point),
      .normals = numbers(out.normals, run.first_point)};
  if (blocks.points != nullptr && blocks.normals != nullptr) {
    kernels_->move_and_turn(blocks, displacement);
  } else if (blocks.points != nullptr) {
    kernels_->move(blocks, displacement);
  } else if (blocks.normals != nullptr) {
    kernels_->turn(blocks, displacement);
  }
}

template <class Real>
bool Drag<Real>::is_streamed(const DraggedPoints<Real>& out) const {
  const std::size_t n_reached =
      runs_.empty() ? 0 : (runs_.back().first_block + runs_.back().n_blocks) * kDragBlock;
  const std::size_t n_numbers =
      (out.points.empty() ? 0 : kDragPlaceRows + 3) + (out.normals.empty() ? 0 : kDragTurnRows + 3);
  return n_reached * n_numbers * sizeof(Real) > last_cache_bytes();
}

/// By way of the first cache, a few blocks at a time.
template <class Real>
void Drag<Real>::write_streamed(const Run& run, const Real* displacement,
                                const DraggedPoints<Real>& out) const {
  if (run.lanes != kAllLanes) {
    write_part(run, displacement, out);
    return;
  }
  constexpr std::uint32_t kBlocks = 16;
  using Vector = glm::vec<3, Real>;
  std::array<Vector, kBlocks * kDragBlock> points;
  std::array<Vector, kBlocks * kDragBlock> normals;
  const DraggedPoints<Real> here = {.points = out.points.empty() ? std::span<Vector>() : points,
                                    .normals = out.normals.empty() ? std::span<Vector>() : normals};
  for (std::uint32_t begin = 0; begin < run.n_blocks; begin += kBlocks) {
    Run some = run;
    some.first_block = run.first_block + begin;
    some.n_blocks = std::min(kBlocks, run.n_blocks - begin);
    some.first_point = 0;
    write(some, displacement, here);
    const std::size_t first = run.first_point + begin * kDragBlock;
    const std::size_t n = 3 * some.n_blocks * kDragBlock;
    if (!out.points.empty()) {
      streamed_copy(glm::value_ptr(points[0]), n, numbers(out.points, first));
    }
    if (!out.normals.empty()) {
      streamed_copy(glm::value_ptr(normals[0]), n, numbers(out.normals, first));
    }
  }
  finish_streaming();
}

/// By way of memory on the stack.
template <class Real>
void Drag<Real>::write_part(const Run& run, const Real* displacement,
                            const DraggedPoints<Real>& out) const {
  using Vector = glm::vec<3, Real>;
  std::array<Vector, kDragBlock> points;
  std::array<Vector, kDragBlock> normals;
  Run whole = run;
  whole.first_point = 0;
  whole.lanes = kAllLanes;
  write(whole, displacement,
        {.points = out.points.empty() ? std::span<Vector>() : points,
         .normals = out.normals.empty() ? std::span<Vector>() : normals});
  for (unsigned lanes = run.lanes; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    if (!out.points.empty()) {
      out.points[run.first_point + i] = points[i];
    }
    if (!out.normals.empty()) {
      out.normals[run.first_point + i] = normals[i];
    }
  }
}

template <class Real>
void Drag<Real>::mark(const glm::dvec3& displacement, std::span<std::uint8_t> folded) const {
  for_each_reached(kDragFoldRows, [&](std::size_t point, std::size_t at) {
    const glm::dvec3 p(exact_folds_[at], exact_folds_[at + kDragBlock],
                       exact_folds_[at + 2 * kDragBlock]);
    folded[point] = static_cast<std::uint8_t>(-glm::dot(p, displacement) >= 1);
  });
  for (const FoldedPoint& point : folded_) {
    folded[point.point] =
        static_cast<std::uint8_t>(point.start + glm::dot(point.slope, displacement) <= 0);
  }
}

template <class Real>
void Drag<Real>::require_possible(const DraggedPoints<Real>& out) const {
  require_fits(out, n_points_, !turns_.empty() || runs_.empty(), has_folds_);
}

template <class Real>
void Drag<Real>::require_near(const glm::dvec3& displacement) const {
  if (!(glm::length(displacement) <= farthest_)) {
    throw ParameterError("a drag by (" + std::to_string(displacement.x) + ", " +
                         std::to_string(displacement.y) + ", " + std::to_string(displacement.z) +
                         ") given, must be finite and at most 1e12 times the lattice's diagonal");
  }
}

template <class Real>
std::vector<std::uint32_t> Drag<Real>::reached() const {
  std::vector<std::uint32_t> points;
  for_each_reached(1, [&](std::size_t point, std::size_t) {
    points.push_back(static_cast<std::uint32_t>(point));
  });
  return points;
}

template <class Real>
std::vector<std::uint32_t> Drag<Real>::folded_at_start() const {
  std::vector<std::uint32_t> points;
  for (const FoldedPoint& point : folded_) {
    points.push_back(point.point);
  }
  return points;
}

template <class Real>
std::size_t Drag<Real>::bytes() const {
  return runs_.capacity() * sizeof(Run) +
         (places_.capacity() + turns_.capacity() + folds_.capacity()) * sizeof(Real) +
         slope_boxes_.capacity() * sizeof(SlopeBox) + exact_folds_.capacity() * sizeof(double) +
         folded_.capacity() * sizeof(FoldedPoint);
}

template class Drag<float>;
template class Drag<double>;

}  // namespace espalier
