// Everything about knots by blossoms: a coefficient of a spline is the blossom of any of its
// polynomials at consecutive knots, so new coefficients are blossoms at new knots.

#include "lattice/tensor/knots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "lattice/core/error.h"
#include "lattice/volume/bezier_evaluator.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"open",    "uniform",  "natural",
                                                    "tripled", "periodic", "explicit"};

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

/// The blossom of the polynomial over [knots[span], knots[span + 1]] at `at` (#degree), as weights
/// of the coefficients span − degree … span: de Boor's steps, from the last back.
std::vector<double> blossom(std::span<const double> knots, std::size_t span,
                            std::span<const double> at) {
  const std::size_t p = at.size();
  std::vector<double> weights = {1};
  for (std::size_t step = p; step > 0; --step) {
    std::vector<double> before(weights.size() + 1, 0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double low = knots[span - p + step + i];
      const double high = knots[span + 1 + i];
      const double t = (at[step - 1] - low) / (high - low);
      before[i] += (1 - t) * weights[i];
      before[i + 1] += t * weights[i];
    }
    weights = std::move(before);
  }
  return weights;
}

/// The non-empty span that ends last of those that coefficient j of the knots takes part in, inside
/// the range.
std::size_t span_of_coefficient(std::span<const double> knots, int degree, std::size_t j) {
  const std::size_t n = knots.size() - as_size(degree) - 1;
  std::size_t span = std::min(j + as_size(degree), n - 1);
  while (!(knots[span] < knots[span + 1])) {
    --span;
  }
  return span;
}

/// The span of `knots` that holds a place inside the range.
std::size_t span_holding(std::span<const double> knots, int degree, double u) {
  const auto begin = knots.begin() + degree;
  const auto end = knots.end() - degree - 1;
  const auto after = std::upper_bound(begin + 1, end, u);
  std::size_t span = static_cast<std::size_t>(after - knots.begin()) - 1;
  while (!(knots[span] < knots[span + 1])) {
    --span;
  }
  return span;
}

std::vector<double> uniform_knots(std::size_t n, double first) {
  std::vector<double> knots(n);
  for (std::size_t i = 0; i < n; ++i) {
    knots[i] = first + static_cast<double>(i);
  }
  return knots;
}

/// 0 … n − degree, the ends degree + 1 times.
std::vector<double> open_knots(int n, int degree) {
  std::vector<double> knots;
  for (int i = 0; i <= n + degree; ++i) {
    knots.push_back(std::clamp(i - degree, 0, n - degree));
  }
  return knots;
}

void require_counts(int n_controls, int degree, Ends ends) {
  const auto fail = [&](const std::string& what) {
    throw ParameterError(fmt::format("{} {}: {}", n_controls,
                                     n_controls == 1 ? "control point" : "control points", what));
  };
  if (n_controls < 1 || n_controls > kMostControlsOnAxis) {
    fail(fmt::format("an axis has 1 to {}", kMostControlsOnAxis));
  }
  if (n_controls == 1 && degree != 0) {
    fail(fmt::format("one has degree 0 on its axis, not {}", degree));
  }
  if (n_controls > 1 && (degree < 1 || degree > kMostDegree)) {
    fail(fmt::format("the degree is {}, must be 1 to {}", degree, kMostDegree));
  }
  if (ends == Ends::Natural && degree != 0 && degree != 1 && degree != 3) {
    fail(fmt::format("natural ends have degree 3, or 1, not {}", degree));
  }
  const bool is_folded = ends == Ends::Natural || ends == Ends::Tripled;
  const int least =
      n_controls == 1 || is_folded ? 1 : std::max(degree + 1, ends == Ends::Periodic ? 3 : 2);
  if (n_controls < least) {
    fail(fmt::format("{} ends of degree {} need at least {}", name_of(ends), degree, least));
  }
}

/// What coefficients beyond the control points are, by the kind of ends.
SparseRows folded_coefficients(int n, int degree, Ends ends) {
  SparseRows rows;
  const auto control = [](int i) { return SparseRow{{i, 1.0}}; };
  const int repeats = ends == Ends::Tripled ? degree - 1 : 0;
  if (ends == Ends::Natural && degree == 3) {
    rows.push_back({{0, 2.0}, {1, -1.0}});
  }
  rows.insert(rows.end(), as_size(repeats), control(0));
  for (int i = 0; i < n; ++i) {
    rows.push_back(control(i));
  }
  rows.insert(rows.end(), as_size(repeats), control(n - 1));
  if (ends == Ends::Natural && degree == 3) {
    rows.push_back({{n - 1, 2.0}, {n - 2, -1.0}});
  }
  for (int i = 0; ends == Ends::Periodic && i < degree; ++i) {
    rows.push_back(control(i % n));
  }
  return rows;
}

/// Which of a row's entries has an index; a new one with weight 0 if none.
double& weight_of(SparseRow& row, std::int32_t index) {
  for (auto& [known, weight] : row) {
    if (known == index) {
      return weight;
    }
  }
  return row.emplace_back(index, 0.0).second;
}

void require_knots(int degree, std::span<const double> knots) {
  if (degree < 1 || degree > kMostDegree) {
    throw ParameterError(fmt::format("the degree is {}, must be 1 to {}", degree, kMostDegree));
  }
  const std::size_t p = as_size(degree);
  if (knots.size() < 2 * p + 2) {
    throw ParameterError(
        fmt::format("{} knots, degree {} needs at least {}", knots.size(), degree, 2 * p + 2));
  }
  const std::size_t n = knots.size() - p - 1;
  std::size_t n_equal = 1;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) {
      throw ParameterError(fmt::format("knot {} is {}, must be finite", i, knots[i]));
    }
    if (i > 0 && knots[i] < knots[i - 1]) {
      throw ParameterError(fmt::format("knot {} is {}, less than knot {}, which is {}", i, knots[i],
                                       i - 1, knots[i - 1]));
    }
    n_equal = i > 0 && knots[i] == knots[i - 1] ? n_equal + 1 : 1;
    const bool is_end = knots[i] == knots[p] || knots[i] == knots[n];
    if (n_equal > p + (is_end ? 1 : 0)) {
      throw ParameterError(fmt::format("knot {} is {}, repeated {} times, at most {} fit degree {}",
                                       i, knots[i], n_equal, n_equal - 1, degree));
    }
  }
  for (const std::size_t i : {p, n - 1}) {
    if (!(knots[i] < knots[i + 1])) {
      throw ParameterError(
          fmt::format("knots {} and {} are both {}: the range from knot {} to knot {} must begin "
                      "and end with a span",
                      i, i + 1, knots[i], p, n));
    }
  }
}

}  // namespace

std::string_view name_of(Ends ends) {
  return kNames[static_cast<std::size_t>(ends)];
}

std::optional<Ends> ends_named(std::string_view name) {
  const auto* const found = std::find(kNames.begin(), kNames.end() - 1, name);
  return found == kNames.end() - 1 ? std::nullopt
                                   : std::optional(static_cast<Ends>(found - kNames.begin()));
}

TensorAxis::TensorAxis() : knots_{0, 1}, coefficients_{{{0, 1.0}}} {
  make_spans();
}

TensorAxis TensorAxis::make(int n_controls, int degree, Ends ends) {
  if (ends == Ends::Explicit) {
    throw ParameterError("explicit ends need knots");
  }
  require_counts(n_controls, degree, ends);
  TensorAxis axis;
  axis.ends_ = ends;
  if (n_controls == 1) {
    return axis;
  }
  axis.degree_ = degree;
  axis.n_controls_ = n_controls;
  axis.coefficients_ = folded_coefficients(n_controls, degree, ends);
  const bool is_open = ends == Ends::Open || (ends == Ends::Natural && degree == 1);
  axis.knots_ = is_open ? open_knots(n_controls, degree)
                        : uniform_knots(axis.coefficients_.size() + as_size(degree) + 1, -degree);
  axis.make_spans();
  return axis;
}

TensorAxis TensorAxis::from_knots(int degree, std::vector<double> knots) {
  require_knots(degree, knots);
  const std::size_t n = knots.size() - as_size(degree) - 1;
  if (n > as_size(kMostControlsOnAxis)) {
    throw ParameterError(
        fmt::format("{} control points on an axis, at most {}", n, kMostControlsOnAxis));
  }
  TensorAxis axis;
  axis.degree_ = degree;
  axis.n_controls_ = static_cast<int>(n);
  axis.ends_ = Ends::Explicit;
  axis.coefficients_ = folded_coefficients(axis.n_controls_, degree, Ends::Explicit);
  axis.knots_ = std::move(knots);
  axis.make_spans();
  return axis;
}

void TensorAxis::make_spans() {
  spans_.clear();
  const std::size_t p = as_size(degree_);
  for (std::size_t span = p; span < coefficients_.size(); ++span) {
    if (!(knots_[span] < knots_[span + 1])) {
      continue;
    }
    AxisSpan made{knots_[span], knots_[span + 1], {}, {degree_, 0, {}}};
    std::vector<double> at(p, made.begin);
    SparseRow all;  // the controls in the order in which the coefficients name them
    for (std::size_t i = span - p; i <= span; ++i) {
      for (const auto& [control, weight] : coefficients_[i]) {
        static_cast<void>(weight_of(all, control));
      }
    }
    std::sort(all.begin(), all.end());
    if (ends_ == Ends::Periodic) {  // as they follow each other round the ring
      const auto first = std::find_if(all.begin(), all.end(), [&](const auto& entry) {
        return entry.first == coefficients_[span - p].front().first;
      });
      std::rotate(all.begin(), first, all.end());
    }
    for (std::size_t i = 0; i <= p; ++i) {
      SparseRow row = all;
      for (const auto& [control, weight] : over_controls(span - p, blossom(knots_, span, at))) {
        weight_of(row, control) = weight;
      }
      for (const auto& entry : row) {
        made.extraction.rows.push_back(entry.second);
      }
      if (i < p) {
        at[i] = made.end;
      }
    }
    for (const auto& entry : all) {
      made.controls.push_back(entry.first);
    }
    made.extraction.n_coefficients = static_cast<int>(made.controls.size());
    spans_.push_back(std::move(made));
  }
}

SparseRow TensorAxis::over_controls(std::size_t first, std::span<const double> weights) const {
  SparseRow row;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (const auto& [control, part] : coefficients_[first + i]) {
      weight_of(row, control) += weights[i] * part;
    }
  }
  return row;
}

bool TensorAxis::is_bezier() const {
  return spans_.size() == 1 && spans_[0].extraction == bezier_extraction(degree_);
}

std::size_t TensorAxis::span_at(double u) const {
  const auto after =
      std::upper_bound(spans_.begin() + 1, spans_.end(), u,
                       [](double value, const AxisSpan& span) { return value < span.begin; });
  return static_cast<std::size_t>(after - spans_.begin()) - 1;
}

std::vector<double> TensorAxis::greville() const {
  const std::size_t p = as_size(degree_);
  std::vector<double> places(as_size(n_controls_), 0.5);
  for (std::size_t i = 0; i < places.size() && p > 0; ++i) {
    if (ends_ == Ends::Tripled) {
      places[i] = begin() + (end() - begin()) * static_cast<double>(i) / (n_controls_ - 1);
      continue;
    }
    const std::size_t knot = control_coefficient(i) + 1;
    double sum = 0;
    for (std::size_t k = knot; k < knot + p; ++k) {
      sum += knots_[k];
    }
    places[i] = sum / degree_;
  }
  return places;
}

std::size_t TensorAxis::control_coefficient(std::size_t control) const {
  const bool is_folded = coefficients_.size() > as_size(n_controls_) && ends_ != Ends::Periodic;
  return control + (is_folded ? (coefficients_.size() - as_size(n_controls_)) / 2 : 0);
}

SparseRow TensorAxis::values(double u) const {
  const std::vector<double> at(as_size(degree_), std::clamp(u, begin(), end()));
  const std::size_t span = span_holding(knots_, degree_, at.empty() ? 0.0 : at[0]);
  return over_controls(span - as_size(degree_), blossom(knots_, span, at));
}

SparseRow TensorAxis::slopes(double u) const {
  const AxisSpan& span = spans_[span_at(u)];
  const double length = span.end - span.begin;
  const double t = std::clamp((u - span.begin) / length, 0.0, 1.0);
  std::vector<double> values(as_size(degree_ + 1));
  std::vector<double> slopes(values.size());
  bernstein_basis(degree_, t, values.data(), slopes.data());
  SparseRow row;
  for (std::size_t k = 0; k < span.controls.size(); ++k) {
    double sum = 0;
    for (int i = 0; i <= degree_; ++i) {
      sum += slopes[as_size(i)] * span.extraction.row(i, static_cast<int>(k));
    }
    row.emplace_back(span.controls[k], sum / length);
  }
  return row;
}

/// The axis on a finer one: its knots times `scale` are among the finer one's.
RefinedAxis refined_onto(const TensorAxis& axis, TensorAxis finer, double scale) {
  std::vector<double> knots = axis.knots_;
  for (double& knot : knots) {
    knot *= scale;
  }
  const int p = axis.degree_;
  const int elevation = finer.degree_ - p;
  assert(elevation == 0 || elevation == 1);
  RefinedAxis result;
  for (std::size_t i = 0; i < as_size(finer.n_controls_); ++i) {
    const std::size_t j = finer.control_coefficient(i);
    const std::size_t span = span_of_coefficient(finer.knots_, finer.degree_, j);
    const std::size_t coarse = span_holding(knots, p, finer.knots_[span]);
    const auto first = finer.knots_.begin() + static_cast<std::ptrdiff_t>(j) + 1;
    const std::vector<double> at(first, first + finer.degree_);
    std::vector<double> weights;
    if (elevation == 0) {
      weights = blossom(knots, coarse, at);
    } else {  // the mean over the arguments with one left out
      weights.assign(as_size(p) + 1, 0.0);
      for (std::size_t left_out = 0; left_out < at.size(); ++left_out) {
        std::vector<double> rest = at;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
        const std::vector<double> part = blossom(knots, coarse, rest);
        for (std::size_t k = 0; k < weights.size(); ++k) {
          weights[k] += part[k] / static_cast<double>(at.size());
        }
      }
    }
    SparseRow row = axis.over_controls(coarse - as_size(p), weights);
    std::erase_if(row, [](const auto& entry) { return entry.second == 0; });
    std::sort(row.begin(), row.end());
    result.controls.push_back(std::move(row));
  }
  result.axis = std::move(finer);
  return result;
}

RefinedAxis refined(const TensorAxis& axis) {
  const int p = axis.degree();
  const int n_spans = 2 * static_cast<int>(axis.spans().size());
  switch (axis.ends()) {
    case Ends::Explicit: {
      std::vector<double> middles;
      for (const AxisSpan& span : axis.spans()) {
        middles.push_back(span.begin + 0.5 * (span.end - span.begin));
      }
      return with_knots(axis, middles);
    }
    case Ends::Natural:
      return p == 0 ? RefinedAxis{axis, {{{0, 1.0}}}}
                    : refined_onto(axis, TensorAxis::make(n_spans + 1, p, Ends::Natural), 2);
    case Ends::Periodic:
      return p == 0 ? RefinedAxis{axis, {{{0, 1.0}}}}
                    : refined_onto(axis, TensorAxis::make(n_spans, p, Ends::Periodic), 2);
    default:
      return p == 0 ? RefinedAxis{axis, {{{0, 1.0}}}}
                    : refined_onto(
                          axis,
                          TensorAxis::make(n_spans + p, p,
                                           axis.ends() == Ends::Open ? Ends::Open : Ends::Uniform),
                          2);
  }
}

RefinedAxis with_knots(const TensorAxis& axis, std::span<const double> knots) {
  if (axis.ends() == Ends::Periodic) {
    throw ParameterError("knots cannot be inserted into a periodic axis, only halve all its spans");
  }
  for (const double knot : knots) {
    if (!(knot > axis.begin() && knot < axis.end())) {
      throw ParameterError(fmt::format("the new knot {} is not inside the range from {} to {}",
                                       knot, axis.begin(), axis.end()));
    }
  }
  std::vector<double> all(axis.knots().begin(), axis.knots().end());
  if (axis.ends() == Ends::Natural) {  // phantom points are no control points: weights could vanish
    for (double& knot : all) {
      knot = std::clamp(knot, axis.begin(), axis.end());
    }
  }
  all.insert(all.end(), knots.begin(), knots.end());
  std::sort(all.begin(), all.end());
  return refined_onto(axis, TensorAxis::from_knots(axis.degree(), std::move(all)), 1);
}

RefinedAxis elevated(const TensorAxis& axis) {
  if (axis.ends() == Ends::Periodic) {
    throw ParameterError("the degree of a periodic axis cannot be elevated");
  }
  if (axis.n_controls() == 1) {
    throw ParameterError("an axis with one control point has degree 0, which cannot be elevated");
  }
  const int degree = axis.degree() + 1;
  std::vector<double> knots(as_size(degree + 1), axis.begin());
  const auto all = axis.knots();
  for (std::size_t i = 1; i < axis.spans().size(); ++i) {
    const double knot = axis.spans()[i].begin;
    const auto n = std::count(all.begin(), all.end(), knot) + 1;
    knots.insert(knots.end(), static_cast<std::size_t>(n), knot);
  }
  knots.insert(knots.end(), as_size(degree + 1), axis.end());
  TensorAxis finer = axis.spans().size() == 1 && axis.begin() == 0 && axis.end() == 1
                         ? TensorAxis::make(degree + 1, degree, Ends::Open)
                         : TensorAxis::from_knots(degree, std::move(knots));
  return refined_onto(axis, std::move(finer), 1);
}

}  // namespace espalier
