#pragma once

/// One axis of a tensor lattice: its knots, and what they make of its control points.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lattice/volume/extraction.h"

namespace espalier {

/// How an axis ends.
enum class Ends : std::uint8_t {
  Open,      ///< clamped, uniform inside: the volume reaches the outermost control points
  Uniform,   ///< uniform beyond the ends: the volume spans the inner part
  Natural,   ///< uniform with a phantom point 2 P0 − P1 beyond; degree 3, or 1, which is open
  Tripled,   ///< uniform, border points counted as often as the degree, moving as one [HHK92]
  Periodic,  ///< uniform, closed to a ring: the first control point follows the last
  Explicit   ///< knots of its own
};

/// The name in files, and back; nothing for a name of none. Explicit ends are named by their knots.
[[nodiscard]] std::string_view name_of(Ends ends);
[[nodiscard]] std::optional<Ends> ends_named(std::string_view name);

/// Degrees that axes may have.
inline constexpr int kMostDegree = 50;
/// Control points that an axis may have.
inline constexpr int kMostControlsOnAxis = 65536;

/// A combination of values: indices with weights, each index once.
using SparseRow = std::vector<std::pair<std::int32_t, double>>;
using SparseRows = std::vector<SparseRow>;

/// An interval between knots.
struct AxisSpan {
  double begin = 0;
  double end = 1;
  std::vector<std::int32_t> controls;  ///< those that it sees
  Extraction extraction;               ///< its Bézier points over them
};

struct RefinedAxis;

/// Control points along an axis and their basis functions: B-splines, with what lies beyond
/// natural, tripled and periodic ends folded in. Functions are not negative but at natural ends,
/// and sum to
/// 1. Immutable.
class TensorAxis {
 public:
  /// One control point, of degree 0: nothing varies along the axis.
  TensorAxis();

  /// Uniform knots 0, 1, … inside. Throws ParameterError for a degree below 1 (0 with one control
  /// point) or above kMostDegree, for too few control points (degree + 1 if open or uniform, 2 if
  /// natural or tripled, 3 and degree + 1 if periodic), for natural ends of degree other than 3 and
  /// 1, and for explicit ends.
  [[nodiscard]] static TensorAxis make(int n_controls, int degree, Ends ends);

  /// knots: #controls + degree + 1, the spline lives on [knots[degree], knots[#controls]]. Throws
  /// ParameterError naming the knot that is not finite, decreases, or is repeated more often than
  /// the degree allows: inside `degree` times, at an end `degree` + 1 times.
  [[nodiscard]] static TensorAxis from_knots(int degree, std::vector<double> knots);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] int n_controls() const { return n_controls_; }
  [[nodiscard]] Ends ends() const { return ends_; }
  /// Of the coefficients, which are the control points and what is folded in beyond them.
  [[nodiscard]] std::span<const double> knots() const { return knots_; }
  /// No interior knot, and all control points open: the functions are Bernstein polynomials.
  [[nodiscard]] bool is_bezier() const;

  /// The spans of positive length, in order.
  [[nodiscard]] const std::vector<AxisSpan>& spans() const { return spans_; }
  /// Where the spline begins and ends.
  [[nodiscard]] double begin() const { return spans_.front().begin; }
  [[nodiscard]] double end() const { return spans_.back().end; }
  /// The span of u, the last of all at its end; u is clamped to the range.
  [[nodiscard]] std::size_t span_at(double u) const;

  /// The control points' own places: where a map with its control points there is the identity,
  /// except with tripled and periodic ends, where such places do not exist and these are evenly
  /// spaced. Ascending. #controls
  [[nodiscard]] std::vector<double> greville() const;

  /// The functions that do not vanish at u, and their derivatives, as rows over control points.
  [[nodiscard]] SparseRow values(double u) const;
  [[nodiscard]] SparseRow slopes(double u) const;

  /// The control point that is coefficient number `control_coefficient(i)` of the knots alone.
  [[nodiscard]] std::size_t control_coefficient(std::size_t control) const;

  bool operator==(const TensorAxis& other) const {
    return degree_ == other.degree_ && n_controls_ == other.n_controls_ && ends_ == other.ends_ &&
           knots_ == other.knots_;
  }

 private:
  friend RefinedAxis refined_onto(const TensorAxis& axis, TensorAxis finer, double scale);
  void make_spans();
  /// A row over coefficients as a row over control points.
  [[nodiscard]] SparseRow over_controls(std::size_t first, std::span<const double> weights) const;

  int degree_ = 0;
  int n_controls_ = 1;
  Ends ends_ = Ends::Open;
  std::vector<double> knots_;
  SparseRows coefficients_;  // over control points
  std::vector<AxisSpan> spans_;
};

/// An axis with more control points, and those over the ones before: the same functions of u but
/// for its scale.
struct RefinedAxis {
  TensorAxis axis;
  SparseRows controls;  ///< rows sum to 1
};

/// Every span halved. Ends stay what they are, but tripled ones become uniform, as their control
/// points part. The range of a uniform axis doubles, that of explicit knots stays.
[[nodiscard]] RefinedAxis refined(const TensorAxis& axis);

/// With more knots, which may repeat; the ends become explicit, natural ones clamped. Throws
/// ParameterError for a knot outside the range, or one that would be repeated more often than the
/// degree, and for periodic ends.
[[nodiscard]] RefinedAxis with_knots(const TensorAxis& axis, std::span<const double> knots);

/// One degree higher, with knots clamped at the ends. Throws ParameterError for periodic ends, for
/// one control point, and at kMostDegree.
[[nodiscard]] RefinedAxis elevated(const TensorAxis& axis);

}  // namespace espalier
