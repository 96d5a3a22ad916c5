#pragma once

/// Moving a selection of control points by one displacement, frame after frame [THB18].

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "deform/evaluate/drag_kernels.h"
#include "deform/evaluate/drag_model.h"
#include "lattice/core/cache_aligned.h"
#include "lattice/core/instruction_set.h"

namespace espalier {

/// How far an update went.
struct DragStep {
  double fraction = 1;         ///< of the displacement asked for
  glm::dvec3 displacement{0};  ///< of the selected control points, each times its weight

  [[nodiscard]] bool is_stopped() const { return fraction < 1; }
};

/// A drag from mouse-down on: every update starts from the state then, so that nothing drifts, and
/// the same displacement gives the same bits. The same bits for any number of threads; they depend
/// on the instruction set. Real: float, for positions within 1e-6 of the model's extent of a full
/// evaluation, or double.
///
/// With g the slope of the selection's influence w at a point and J0 the deformation gradient at
/// mouse-down, a displacement D gives x0 + w D and J0 + D gᵀ, so that det J = det J0 (1 + p · D)
/// with p = J0⁻ᵀ g: the farthest step without a fold is 1 / max(−p · D). The normal goes along
/// cof(J0) n + D × J0 (n × g).
template <class Real>
class Drag {
 public:
  /// Mouse-down. selection: #controls in [0, 1]: how much of the displacement each takes. Throws as
  /// require_valid() and combined_points(). O(#points).
  Drag(const DragModel& model, std::span<const double> selection,
       InstructionSet set = instruction_set());

  /// The model with the selection displaced from mouse-down. margin: the drag stops where a
  /// determinant would fall to `margin` times that at mouse-down; none: it goes on. Folds between
  /// the points are not seen. Throws ParameterError for a displacement that is not finite or beyond
  /// 1e12 of the lattice's diagonals, for a margin outside [0, 1), for spans of another length, and
  /// for what the model was not given for. Allocates nothing once this thread has worked.
  /// O(#reached).
  DragStep update(const glm::dvec3& displacement, std::optional<double> margin,
                  const DraggedPoints<Real>& out) const;

  /// How much of a displacement keeps all determinants above `margin` times those at mouse-down: 1
  /// or, to a part in 10^7, the most. Points folded at mouse-down are left out, they would stop
  /// every drag. Throws as update().
  [[nodiscard]] double safe_fraction(const glm::dvec3& displacement, double margin) const;

  [[nodiscard]] std::size_t n_points() const { return n_points_; }
  /// Points that the selection reaches, ascending.
  [[nodiscard]] std::vector<std::uint32_t> reached() const;
  /// Reached points with det J < 1e-12 at mouse-down, ascending: they hinder no drag, so
  /// that it can free them.
  [[nodiscard]] std::vector<std::uint32_t> folded_at_start() const;
  /// Heap memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// Blocks that are written together: whole ones, or one in part.
  struct Run {
    std::uint32_t first_block = 0;
    std::uint32_t n_blocks = 1;
    std::uint32_t first_point = 0;
    std::uint16_t lanes = 0;  ///< bit i: point i of the block is reached
  };
  /// A point without p: det J has the sign of start + D · slope.
  struct FoldedPoint {
    std::uint32_t point = 0;
    double start = 0;
    glm::dvec3 slope{0};
  };
  /// Around p of a segment's points.
  struct SlopeBox {
    glm::vec<3, Real> low{0};
    glm::vec<3, Real> high{0};

    /// No −p · D inside is larger.
    [[nodiscard]] Real largest_fall(const glm::vec<3, Real>& d) const;
  };
  static constexpr std::uint16_t kAllLanes = 0xFFFF;
  static constexpr std::uint32_t kMostBlocks = 256;  // a run
  static constexpr std::uint32_t kFoldBlocks = 8;    // a segment of folds_
  static constexpr std::size_t kSegment = kFoldBlocks * kDragFoldRows * kDragBlock;

  void add_runs(std::span<const char> is_reached);
  void fill_places(const DragStart& start, const DragField& field, double unit);
  void fill_turns(const DragStart& start, const DragField& field, double unit,
                  std::span<const glm::dvec3> normals);
  void fill_folds(const DragStart& start, const DragField& field, double unit);
  void fill_slope_boxes();
  [[nodiscard]] std::size_t n_blocks_of_segment(std::size_t segment) const;
  /// Calls visit(point, the place of its first number among rows) for all reached points.
  template <class Visit>
  void for_each_reached(std::size_t n_rows, const Visit& visit) const;
  /// The largest −p · D, 0 where all are below `least`. falls: #segments, of each its largest, or
  /// any number below the result and `least` by more than 2 × rounding.
  double find_falls(const glm::vec<3, Real>& d, double least, double rounding,
                    std::span<Real> falls) const;
  void write(const Run& run, const Real* displacement, const DraggedPoints<Real>& out) const;
  void write_streamed(const Run& run, const Real* displacement,
                      const DraggedPoints<Real>& out) const;
  /// Whether an update reads and writes more than the caches hold.
  [[nodiscard]] bool is_streamed(const DraggedPoints<Real>& out) const;
  void write_part(const Run& run, const Real* displacement, const DraggedPoints<Real>& out) const;
  void mark(const glm::dvec3& displacement, std::span<std::uint8_t> folded) const;
  void require_possible(const DraggedPoints<Real>& out) const;
  void require_near(const glm::dvec3& displacement) const;

  const DragKernels<Real>* kernels_;
  const DragKernels<double>* exact_kernels_;
  std::size_t n_points_ = 0;
  double farthest_ = 0;  ///< that a displacement may be
  double steepest_ = 0;  ///< the largest |p|
  bool has_folds_ = false;
  std::vector<Run> runs_;
  AlignedVector<Real> places_, turns_, folds_;  ///< blocks (drag_kernels.h)
  AlignedVector<double> exact_folds_;
  std::vector<SlopeBox> slope_boxes_;  ///< of the segments of folds_
  std::vector<FoldedPoint> folded_;    ///< at mouse-down
};

}  // namespace espalier
