#include "lattice/tensor/knots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// B-spline i by the recursion of Cox and de Boor; the span before the last place holds it.
double recursive_basis(const std::vector<double>& knots, std::size_t i, int degree, double u,
                       double last) {
  if (degree == 0) {
    const bool holds =
        u == last ? knots[i] < u && u <= knots[i + 1] : knots[i] <= u && u < knots[i + 1];
    return holds ? 1 : 0;
  }
  const auto p = static_cast<std::size_t>(degree);
  double sum = 0;
  if (knots[i + p] > knots[i]) {
    sum +=
        (u - knots[i]) / (knots[i + p] - knots[i]) * recursive_basis(knots, i, degree - 1, u, last);
  }
  if (knots[i + p + 1] > knots[i + 1]) {
    sum += (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) *
           recursive_basis(knots, i + 1, degree - 1, u, last);
  }
  return sum;
}

std::vector<double> dense(const SparseRow& row, int n) {
  std::vector<double> values(static_cast<std::size_t>(n), 0.0);
  for (const auto& [index, weight] : row) {
    values[static_cast<std::size_t>(index)] += weight;
  }
  return values;
}

/// A spline's value, its control values being sin(i).
double wavy(const TensorAxis& axis, const std::vector<double>& controls, double u) {
  double sum = 0;
  for (const auto& [index, weight] : axis.values(u)) {
    sum += weight * controls[static_cast<std::size_t>(index)];
  }
  return sum;
}

std::vector<double> wave(int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) {
    values.push_back(std::sin(2.0 * i + 1));
  }
  return values;
}

std::vector<double> applied(const SparseRows& rows, const std::vector<double>& values) {
  std::vector<double> result;
  for (const SparseRow& row : rows) {
    double sum = 0;
    for (const auto& [index, weight] : row) {
      sum += weight * values[static_cast<std::size_t>(index)];
    }
    result.push_back(sum);
  }
  return result;
}

/// Every kind of ends in several degrees and counts.
std::vector<TensorAxis> axes() {
  std::vector<TensorAxis> all = {TensorAxis()};
  for (const int degree : {1, 2, 3, 4, 5}) {
    for (const int more : {1, 2, 5}) {
      for (const Ends ends : {Ends::Open, Ends::Uniform}) {
        all.push_back(TensorAxis::make(degree + more, degree, ends));
      }
      all.push_back(TensorAxis::make(1 + more, degree, Ends::Tripled));
      all.push_back(TensorAxis::make(degree + more + 1, degree, Ends::Periodic));
    }
  }
  for (const int n : {2, 3, 4, 9}) {
    all.push_back(TensorAxis::make(n, 3, Ends::Natural));
    all.push_back(TensorAxis::make(n, 1, Ends::Natural));
  }
  all.push_back(TensorAxis::from_knots(2, {0, 0, 0, 1, 1, 2.5, 4, 4, 4}));
  all.push_back(TensorAxis::from_knots(3, {-1, -0.5, 0, 0.25, 1, 1, 2, 2.5, 4, 5, 5}));
  return all;
}

std::vector<double> places(const TensorAxis& axis) {
  std::vector<double> result;
  for (int i = 0; i <= 40; ++i) {
    result.push_back(axis.begin() + (axis.end() - axis.begin()) * i / 40.0);
  }
  return result;
}

TEST(TensorAxis, functions_are_those_of_the_recursion_over_its_knots) {
  for (const TensorAxis& axis : axes()) {
    if (axis.ends() != Ends::Open && axis.ends() != Ends::Uniform &&
        axis.ends() != Ends::Explicit) {
      continue;
    }
    const std::vector<double> knots(axis.knots().begin(), axis.knots().end());
    for (const double u : places(axis)) {
      const std::vector<double> values = dense(axis.values(u), axis.n_controls());
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], recursive_basis(knots, i, axis.degree(), u, axis.end()), 1e-14);
      }
    }
  }
}

TEST(TensorAxis, functions_sum_to_one_and_are_not_negative_but_at_natural_ends) {
  for (const TensorAxis& axis : axes()) {
    for (const double u : places(axis)) {
      double sum = 0;
      for (const auto& [index, weight] : axis.values(u)) {
        sum += weight;
        EXPECT_TRUE(axis.ends() == Ends::Natural || weight >= -1e-15);
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
  }
}

TEST(TensorAxis, slopes_are_difference_quotients) {
  for (const TensorAxis& axis : axes()) {
    for (const AxisSpan& span : axis.spans()) {
      const double h = 1e-4 * (span.end - span.begin);
      const double u = span.begin + 0.3 * (span.end - span.begin);
      const auto slopes = dense(axis.slopes(u), axis.n_controls());
      const auto after = dense(axis.values(u + h), axis.n_controls());
      const auto before = dense(axis.values(u - h), axis.n_controls());
      for (std::size_t i = 0; i < slopes.size(); ++i) {
        EXPECT_NEAR(slopes[i], (after[i] - before[i]) / (2 * h), 2e-6);
      }
    }
  }
}

TEST(TensorAxis, functions_reach_only_degree_plus_one_spans_of_knots) {
  const TensorAxis axis = TensorAxis::make(12, 3, Ends::Open);
  for (const double u : places(axis)) {
    for (const auto& [index, weight] : axis.values(u)) {
      EXPECT_TRUE(weight == 0 || (axis.knots()[static_cast<std::size_t>(index)] <= u &&
                                  u <= axis.knots()[static_cast<std::size_t>(index) + 4]));
    }
  }
}

TEST(TensorAxis, functions_are_linearly_independent) {
  for (const TensorAxis& axis : axes()) {
    // Gaussian elimination on their values at many places.
    std::vector<std::vector<double>> rows;
    for (const AxisSpan& span : axis.spans()) {
      for (int i = 0; i <= axis.degree(); ++i) {
        const double t = (i + 0.5) / (axis.degree() + 1);
        rows.push_back(
            dense(axis.values(span.begin + t * (span.end - span.begin)), axis.n_controls()));
      }
    }
    const auto n = static_cast<std::size_t>(axis.n_controls());
    ASSERT_GE(rows.size(), n);
    for (std::size_t column = 0; column < n; ++column) {
      const auto pivot = std::max_element(
          rows.begin() + static_cast<std::ptrdiff_t>(column), rows.end(),
          [&](const auto& a, const auto& b) { return std::abs(a[column]) < std::abs(b[column]); });
      ASSERT_GT(std::abs((*pivot)[column]), 1e-9) << name_of(axis.ends()) << axis.degree();
      std::swap(*pivot, rows[column]);
      for (std::size_t row = column + 1; row < rows.size(); ++row) {
        const double factor = rows[row][column] / rows[column][column];
        for (std::size_t k = column; k < n; ++k) {
          rows[row][k] -= factor * rows[column][k];
        }
      }
    }
  }
}

TEST(TensorAxis, spans_are_bezier_curves_of_their_controls) {
  for (const TensorAxis& axis : axes()) {
    const std::vector<double> controls = wave(axis.n_controls());
    for (const AxisSpan& span : axis.spans()) {
      std::vector<double> line;
      for (int i = 0; i <= axis.degree(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < span.controls.size(); ++k) {
          sum += span.extraction.row(i, static_cast<int>(k)) *
                 controls[static_cast<std::size_t>(span.controls[k])];
        }
        line.push_back(sum);
      }
      for (const double t : {0.0, 0.3, 0.9}) {
        std::vector<double> points = line;
        for (std::size_t left = points.size(); left > 1; --left) {
          for (std::size_t i = 0; i + 1 < left; ++i) {
            points[i] = (1 - t) * points[i] + t * points[i + 1];
          }
        }
        EXPECT_NEAR(points[0], wavy(axis, controls, span.begin + t * (span.end - span.begin)),
                    1e-13);
      }
    }
  }
}

TEST(TensorAxis, greville_places_reproduce_the_parameter) {
  for (const TensorAxis& axis : axes()) {
    if (axis.n_controls() == 1 || axis.ends() == Ends::Tripled || axis.ends() == Ends::Periodic) {
      continue;
    }
    for (const double u : places(axis)) {
      EXPECT_NEAR(wavy(axis, axis.greville(), u), u, 2e-14);
    }
  }
}

TEST(TensorAxis, a_natural_spline_has_the_folded_extractions_of_the_uniform_cubic) {
  const TensorAxis axis = TensorAxis::make(4, 3, Ends::Natural);
  ASSERT_EQ(axis.spans().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Extraction wanted = uniform_cubic_extraction(i == 0, i == 2);
    ASSERT_EQ(axis.spans()[i].extraction.n_coefficients, wanted.n_coefficients);
    for (std::size_t k = 0; k < wanted.rows.size(); ++k) {
      EXPECT_NEAR(axis.spans()[i].extraction.rows[k], wanted.rows[k], 2e-16);
    }
  }
}

TEST(TensorAxis, tripled_ends_reach_the_border_points_and_periodic_ones_close) {
  const TensorAxis tripled = TensorAxis::make(4, 3, Ends::Tripled);
  const auto begin = dense(tripled.values(tripled.begin()), 4);
  const auto end = dense(tripled.values(tripled.end()), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(begin[i], i == 0 ? 1 : 0, 1e-15);
    EXPECT_NEAR(end[i], i == 3 ? 1 : 0, 1e-15);
  }
  const TensorAxis ring = TensorAxis::make(6, 3, Ends::Periodic);
  const auto first = dense(ring.values(ring.begin()), 6);
  const auto last = dense(ring.values(ring.end()), 6);
  const auto slope = dense(ring.slopes(ring.begin()), 6);
  const auto last_slope = dense(ring.slopes(ring.end()), 6);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(first[i], last[i], 1e-15);
    EXPECT_NEAR(slope[i], last_slope[i], 1e-15);
  }
}

TEST(TensorAxis, refining_changes_nothing_and_keeps_the_ends) {
  for (const TensorAxis& axis : axes()) {
    const std::vector<double> controls = wave(axis.n_controls());
    const RefinedAxis fine = refined(axis);
    EXPECT_EQ(fine.axis.ends(),
              axis.ends() == Ends::Tripled && axis.n_controls() > 1 ? Ends::Uniform : axis.ends());
    EXPECT_EQ(fine.axis.n_controls() > axis.n_controls(), axis.n_controls() > 1);
    const std::vector<double> fine_controls = applied(fine.controls, controls);
    const double scale = (fine.axis.end() - fine.axis.begin()) / (axis.end() - axis.begin());
    for (const double u : places(axis)) {
      EXPECT_NEAR(wavy(fine.axis, fine_controls, fine.axis.begin() + scale * (u - axis.begin())),
                  wavy(axis, controls, u), 1e-13);
    }
  }
}

TEST(TensorAxis, elevating_and_inserting_knots_change_nothing) {
  for (const TensorAxis& axis : axes()) {
    if (axis.n_controls() == 1 || axis.ends() == Ends::Periodic) {
      EXPECT_THROW((void)elevated(axis), ParameterError);
      continue;
    }
    const std::vector<double> controls = wave(axis.n_controls());
    const double middle = axis.begin() + 0.37 * (axis.end() - axis.begin());
    const std::vector<double> new_knots(static_cast<std::size_t>(axis.degree()), middle);
    for (const RefinedAxis& finer : {elevated(axis), with_knots(axis, new_knots)}) {
      const std::vector<double> fine_controls = applied(finer.controls, controls);
      for (const double u : places(axis)) {
        EXPECT_NEAR(wavy(finer.axis, fine_controls, u), wavy(axis, controls, u), 1e-13);
      }
    }
  }
}

TEST(TensorAxis, refuses_what_is_no_axis) {
  EXPECT_THROW((void)TensorAxis::make(3, 3, Ends::Open), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(3, 3, Ends::Uniform), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(3, 3, Ends::Periodic), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(2, 1, Ends::Periodic), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(4, 2, Ends::Natural), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(4, 0, Ends::Open), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(1, 3, Ends::Open), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(0, 3, Ends::Open), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(90, 51, Ends::Open), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(70000, 3, Ends::Open), ParameterError);
  EXPECT_THROW((void)TensorAxis::make(4, 3, Ends::Explicit), ParameterError);
}

/// What the error for knots of a degree says.
std::string complaint(int degree, std::vector<double> knots) {
  try {
    (void)TensorAxis::from_knots(degree, std::move(knots));
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(TensorAxis, names_the_knot_that_is_wrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(1, {0, 0, 2, 1, 3}), "knot 3 is 1, less than knot 2, which is 2");
  EXPECT_EQ(complaint(1, {0, 0, nan, 1, 3}), "knot 2 is nan, must be finite");
  EXPECT_EQ(complaint(2, {0, 0, 0}), "3 knots, degree 2 needs at least 6");
  EXPECT_EQ(complaint(1, {0, 0, 1, 1, 2, 2}),
            "knot 3 is 1, repeated 2 times, at most 1 fit degree 1");
  EXPECT_EQ(complaint(0, {0, 1}), "the degree is 0, must be 1 to 50");
  EXPECT_NE(complaint(2, {0, 0, 1, 1, 1, 1, 2, 2}), "");
}

TEST(Ends, are_known_by_name) {
  for (const Ends ends :
       {Ends::Open, Ends::Uniform, Ends::Natural, Ends::Tripled, Ends::Periodic}) {
    EXPECT_EQ(ends_named(name_of(ends)), ends);
  }
  EXPECT_EQ(ends_named("explicit"), std::nullopt);
  EXPECT_EQ(ends_named("closed"), std::nullopt);
}

}  // namespace
}  // namespace espalier
