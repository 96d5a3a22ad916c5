// Determinants by products of derivative nets.

#include "deform/injectivity/determinant_nets.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>
#include <limits>

#include "lattice/volume/bernstein_lines.h"

namespace espalier {
namespace {

/// Pairs of rows in the order of Laplace's expansion, each with the sign of its term; pair i goes
/// with pair 5 − i.
constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<double, 6> kPairSigns = {1, -1, 1, 1, -1, 1};

/// |c| summed over all ways to take one component of each column, no two of a row: the largest that
/// a determinant's terms can add up to. columns: #components × #components of sizes.
double permanent(std::span<const std::array<double, 4>> columns, unsigned rows_left) {
  if (columns.empty()) {
    return 1;
  }
  double sum = 0;
  for (std::size_t row = 0; row < 4; ++row) {
    if ((rows_left >> row & 1) != 0) {
      sum += columns[0][row] * permanent(columns.subspan(1), rows_left & ~(1U << row));
    }
  }
  return sum;
}

std::array<double, 4> grown(const std::array<double, 4>& sizes, const std::array<double, 4>& by) {
  return {sizes[0] + by[0], sizes[1] + by[1], sizes[2] + by[2], sizes[3] + by[3]};
}

/// Whether the derivative along `derivative` is zero at an end of another axis.
bool is_zero_at(const BezierView& patch, int derivative, int axis, int end) {
  const auto a = static_cast<std::size_t>(derivative);
  const auto b = static_cast<std::size_t>(axis);
  std::array<int, 3> index{};
  const auto& degree = patch.degree;
  for (index[2] = 0; index[2] <= degree[2]; ++index[2]) {
    for (index[1] = 0; index[1] <= degree[1]; ++index[1]) {
      for (index[0] = 0; index[0] <= degree[0]; ++index[0]) {
        if (index[b] != (end == 0 ? 0 : degree[b]) || index[a] == 0) {
          continue;
        }
        const std::array<int, 3> stride = {1, degree[0] + 1, (degree[0] + 1) * (degree[1] + 1)};
        const int at = index[0] + stride[1] * index[1] + stride[2] * index[2];
        if (patch.points[static_cast<std::size_t>(at)] !=
            patch.points[static_cast<std::size_t>(at - stride[a])]) {
          return false;
        }
      }
    }
  }
  return true;
}

void set_zero(std::vector<double>& values, std::size_t n) {
  values.assign(n, 0.0);
}

/// Replaces the lines along an axis by make(line), which changes the shape.
template <class Make>
std::vector<double> with_scaled_lines(BoundedPolynomial& polynomial, int axis, const Make& make) {
  auto& size = polynomial.shape.size;
  std::array<int, 3> degree = {size[0] - 1, size[1] - 1, size[2] - 1};
  std::vector<double> result =
      with_lines(degree, std::span<const double>(polynomial.coefficients), axis, make);
  size = {degree[0] + 1, degree[1] + 1, degree[2] + 1};
  return result;
}

/// What a step does to bounds of the coefficients, and how often it rounds one.
struct Growth {
  double factor = 1;
  double n_roundings = 0;
};

/// Lowers the degree along an axis by one, which must not change the polynomial. Coefficients are
/// times binomials: those of the higher degree are the sums of neighbours, and so each follows from
/// the one before it, from both ends to the middle.
Growth lower_degree(BoundedPolynomial& polynomial, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  const int degree = polynomial.shape.size[a] - 1;
  polynomial.coefficients = with_scaled_lines(polynomial, axis, [](std::span<const double> line) {
    std::vector<double> result(line.size() - 1);
    const std::size_t middle = result.size() / 2;
    for (std::size_t i = 0; i <= middle; ++i) {
      result[i] = line[i] - (i > 0 ? result[i - 1] : 0);
    }
    for (std::size_t i = result.size() - 1; i > middle; --i) {
      result[i] = line[i + 1] - (i + 1 < result.size() ? result[i + 1] : 0);
    }
    return result;
  });
  double sum = 0;
  double factor = 1;
  for (int i = 0; 2 * i <= degree - 1; ++i) {
    sum += binomial(degree, i);
    factor = std::max(factor, sum / binomial(degree - 1, i));
  }
  return {factor, static_cast<double>(degree)};
}

/// Divides by the factors of a collapse: the coefficients at that end, which are zero, go.
Growth drop_factors(BoundedPolynomial& polynomial, const Collapse& collapse) {
  Growth growth;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<std::size_t, 2> n_dropped{};
    for (int derivative = 0; derivative < 3; ++derivative) {
      for (int end = 0; end < 2; ++end) {
        n_dropped[static_cast<std::size_t>(end)] += collapse.has(derivative, axis, end) ? 1 : 0;
      }
    }
    const std::size_t n = n_dropped[0] + n_dropped[1];
    if (n == 0) {
      continue;
    }
    for (std::size_t i = 0; i < n; ++i) {
      growth.factor *=
          polynomial.shape.size[static_cast<std::size_t>(axis)] - 1 - static_cast<int>(i);
    }
    polynomial.coefficients =
        with_scaled_lines(polynomial, axis, [&](std::span<const double> line) {
          const auto kept = line.subspan(n_dropped[0], line.size() - n);
          return std::vector<double>(kept.begin(), kept.end());
        });
  }
  return growth;
}

}  // namespace

/// Bounds of the sums behind one polynomial's coefficients.
struct DeterminantNets::Sizes {
  double absolute = 0;  // sum of absolute values, the input's errors in
  double spread = 0;    // what of it comes from those errors
  double n_additions = 0;

  void add(std::initializer_list<const Net*> columns) {
    std::array<std::array<double, 4>, 4> exact{};
    std::array<std::array<double, 4>, 4> wide{};
    std::size_t n = 0;
    for (const Net* net : columns) {
      exact[n] = net->largest;
      wide[n] = grown(net->largest, net->errors);
      ++n;
      n_additions += 4.0 * static_cast<double>(net->shape.n());
    }
    const unsigned rows = (1U << n) - 1;
    const double largest = permanent(std::span(wide).first(n), rows);
    absolute += largest;
    spread += std::max(0.0, largest - permanent(std::span(exact).first(n), rows));
    n_additions += 40;
  }

  void grow(const Growth& growth) {
    absolute *= growth.factor;
    spread *= growth.factor;
    n_additions += growth.n_roundings;
  }
};

Collapse common_collapse(const BezierView& a, const BezierView& b) {
  assert(a.degree == b.degree);
  Collapse result;
  for (int derivative = 0; derivative < 3; ++derivative) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int end = 0; end < 2 && axis != derivative; ++end) {
        if (is_zero_at(a, derivative, axis, end) && is_zero_at(b, derivative, axis, end)) {
          result.add(derivative, axis, end);
        }
      }
    }
  }
  result.keep_factors(a.degree);
  return result;
}

void Collapse::keep_factors(const std::array<int, 3>& degree) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int derivative = 0; derivative < 3; ++derivative) {
      if (degree[static_cast<std::size_t>(axis)] == 1 && has(derivative, axis, 0) &&
          has(derivative, axis, 1)) {
        auto& bits = factors[static_cast<std::size_t>(derivative)];
        bits = static_cast<std::uint8_t>(bits & ~(3U << (2 * axis)));
      }
    }
  }
}

const std::vector<double>& DeterminantNets::binomials(const NetShape& shape) {
  for (const Table& table : tables_) {
    if (table.shape == shape) {
      return table.binomials;
    }
  }
  Table table{shape, {}};
  for (int k = 0; k < shape.size[2]; ++k) {
    for (int j = 0; j < shape.size[1]; ++j) {
      for (int i = 0; i < shape.size[0]; ++i) {
        table.binomials.push_back(
            binomial(shape.size[0] - 1, i) *
            (binomial(shape.size[1] - 1, j) * binomial(shape.size[2] - 1, k)));
      }
    }
  }
  tables_.push_back(std::move(table));
  return tables_.back().binomials;
}

/// A factor 1 − t of a polynomial is divided out of coefficients times binomials by dropping the
/// last, which is zero; t by dropping the first.
void DeterminantNets::derive(const double* points, std::size_t n_components,
                             const std::array<int, 3>& degree, int axis, NetPart part,
                             const Collapse& collapse, const std::array<double, 4>& errors,
                             Net& net) {
  NetShape full{{degree[0] + 1, degree[1] + 1, degree[2] + 1}};
  const std::array<int, 3> stride = {1, full.size[0], full.size[0] * full.size[1]};
  const auto a = static_cast<std::size_t>(axis);
  const double slope = degree[a];
  --full.size[a];
  std::array<int, 3> first{};
  net.shape = full;
  double growth = part == NetPart::Slope ? 2 * slope : slope;
  for (int b = 0; b < 3; ++b) {
    for (int end = 0; end < 2; ++end) {
      if (collapse.has(axis, b, end)) {
        const auto at = static_cast<std::size_t>(b);
        first[at] += end == 0 ? 1 : 0;
        --net.shape.size[at];
        growth *= degree[at];
      }
    }
  }
  const std::size_t ahead = n_components * static_cast<std::size_t>(stride[a]);
  const auto value_of = [&](const double* at) {
    switch (part) {
      case NetPart::Low:
        return *at;
      case NetPart::High:
        return slope * at[ahead];
      default:
        return slope * (at[ahead] - *at);
    }
  };
  const std::vector<double>& scales = binomials(full);
  const std::vector<double>& own = binomials(net.shape);
  net.largest = {};
  for (std::size_t c = 0; c < n_components; ++c) {
    net.errors[c] = growth * errors[c];
    auto& values = net.values[c];
    values.resize(net.shape.n());
    double largest = 0;
    std::size_t out = 0;
    for (int k = 0; k < net.shape.size[2]; ++k) {
      for (int j = 0; j < net.shape.size[1]; ++j) {
        const int row = first[0] + stride[1] * (j + first[1]) + stride[2] * (k + first[2]);
        const int scale_row =
            first[0] + full.size[0] * (j + first[1] + full.size[1] * (k + first[2]));
        for (int i = 0; i < net.shape.size[0]; ++i, ++out) {
          const double* at = points + n_components * static_cast<std::size_t>(row + i) + c;
          values[out] = scales[static_cast<std::size_t>(scale_row + i)] * value_of(at);
          largest = std::max(largest, std::abs(values[out]) / own[out]);
        }
      }
    }
    net.largest[c] = largest;
  }
}

void DeterminantNets::derive(const BezierView& patch, const Collapse& collapse, double input_error,
                             Nets& nets) {
  assert(patch.points.size() == n_coefficients(patch.degree));
  const std::array<double, 4> errors = {input_error, input_error, input_error, 0};
  for (int axis = 0; axis < 3; ++axis) {
    derive(glm::value_ptr(patch.points[0]), 3, patch.degree, axis, NetPart::Slope, collapse, errors,
           nets[static_cast<std::size_t>(axis)]);
  }
}

/// The columns p P₁, P₀, ∂P/∂v, ∂P/∂w, where P = (1 − u) P₀ + u P₁: as ∂P/∂u = p (P₁ − P₀), their
/// determinant is that of the derivatives and P, but of one degree less along u.
void DeterminantNets::derive(const HomogeneousPatch& patch, Nets& nets) {
  assert(patch.points.size() == n_coefficients(patch.degree));
  const double* points = glm::value_ptr(patch.points[0]);
  const std::array<double, 4> errors = {patch.error.x, patch.error.y, patch.error.z, patch.error.w};
  derive(points, 4, patch.degree, 0, NetPart::High, {}, errors, nets[0]);
  derive(points, 4, patch.degree, 0, NetPart::Low, {}, errors, nets[1]);
  derive(points, 4, patch.degree, 1, NetPart::Slope, {}, errors, nets[2]);
  derive(points, 4, patch.degree, 2, NetPart::Slope, {}, errors, nets[3]);
}

void DeterminantNets::add_cross(const Net& a, const Net& b, Components& out) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t y = (c + 1) % 3;
    const std::size_t z = (c + 2) % 3;
    const std::array<NetProduct, 2> terms = {{{a.values[y].data(), b.values[z].data(), 1},
                                              {a.values[z].data(), b.values[y].data(), -1}}};
    add_products(terms, a.shape, b.shape, out[c].data(), room_);
  }
}

void DeterminantNets::add_dot(const Net& a, const Components& cross, const NetShape& cross_shape,
                              BoundedPolynomial& out) {
  std::array<NetProduct, 3> terms{};
  for (std::size_t c = 0; c < 3; ++c) {
    terms[c] = {a.values[c].data(), cross[c].data(), 1};
  }
  add_products(terms, a.shape, cross_shape, out.coefficients.data(), room_);
}

/// Divides by the binomials and bounds the error. The relative error of a sum of products of a few
/// rounded factors is at most γ_n, n the additions and a few more.
void DeterminantNets::finish(const Sizes& sizes, BoundedPolynomial& out) {
  const std::vector<double>& scales = binomials(out.shape);
  for (std::size_t i = 0; i < out.coefficients.size(); ++i) {
    out.coefficients[i] /= scales[i];
  }
  constexpr double kUnit = std::numeric_limits<double>::epsilon();  // twice the unit round-off
  constexpr double kTiny = 1e-290;                                  // more than underflow loses
  out.error = kUnit * sizes.n_additions * sizes.absolute + 1.001 * sizes.spread + kTiny;
}

void DeterminantNets::determinant(const BezierView& patch, const Collapse& collapse,
                                  double input_error, BoundedPolynomial& out) {
  derive(patch, collapse, input_error, still_);
  const NetShape cross_shape = product_shape(still_[1].shape, still_[2].shape);
  for (std::size_t c = 0; c < 3; ++c) {
    set_zero(crosses_[0][c], cross_shape.n());
  }
  out.shape = product_shape(still_[0].shape, cross_shape);
  set_zero(out.coefficients, out.shape.n());
  add_cross(still_[1], still_[2], crosses_[0]);
  add_dot(still_[0], crosses_[0], cross_shape, out);
  Sizes sizes;
  sizes.add({&still_[0], &still_[1], &still_[2]});
  finish(sizes, out);
}

void DeterminantNets::moving_determinant(const MovingPatch& patch, const Collapse& collapse,
                                         std::array<BoundedPolynomial, 4>& out) {
  derive(patch.start, collapse, patch.start_error, still_);
  derive(patch.motion, collapse, patch.motion_error, moving_);
  const NetShape cross_shape = product_shape(still_[1].shape, still_[2].shape);
  const std::size_t n_powers = patch.is_parallel ? 2 : 4;
  for (std::size_t power = 0; power < 4; ++power) {
    out[power].shape = product_shape(still_[0].shape, cross_shape);
    set_zero(out[power].coefficients, out[power].shape.n());
    out[power].error = 0;
    for (std::size_t c = 0; c < 3 && power < 3; ++c) {
      set_zero(crosses_[power][c], cross_shape.n());
    }
  }
  const std::array<const Nets*, 2> nets = {&still_, &moving_};
  std::array<Sizes, 4> sizes{};
  for (std::size_t v = 0; v < 2; ++v) {
    for (std::size_t w = 0; w < 2; ++w) {
      if (v + w < 2 || !patch.is_parallel) {
        add_cross((*nets[v])[1], (*nets[w])[2], crosses_[v + w]);
      }
      for (std::size_t u = 0; u < 2; ++u) {
        sizes[u + v + w].add({&(*nets[u])[0], &(*nets[v])[1], &(*nets[w])[2]});
      }
    }
  }
  for (std::size_t u = 0; u < 2; ++u) {
    for (std::size_t cross = 0; cross < 3 && u + cross < n_powers; ++cross) {
      add_dot((*nets[u])[0], crosses_[cross], cross_shape, out[u + cross]);
    }
  }
  for (std::size_t power = 0; power < n_powers; ++power) {
    finish(sizes[power], out[power]);
  }
}

void DeterminantNets::add_minors(const Net& a, const Net& b,
                                 std::array<std::vector<double>, 6>& out) {
  for (std::size_t i = 0; i < 6; ++i) {
    const auto [y, z] = kPairs[i];
    const std::array<NetProduct, 2> terms = {{{a.values[y].data(), b.values[z].data(), 1},
                                              {a.values[z].data(), b.values[y].data(), -1}}};
    add_products(terms, a.shape, b.shape, out[i].data(), room_);
  }
}

/// Of columns `first` and first + 1, the powers of t below n_powers.
void DeterminantNets::find_minors(std::size_t first, std::size_t n_powers, Minors& out) {
  const std::array<const Nets*, 2> nets = {&still_, &moving_};
  const std::size_t n = product_shape(still_[first].shape, still_[first + 1].shape).n();
  for (std::size_t power = 0; power < std::min<std::size_t>(n_powers, 3); ++power) {
    for (std::vector<double>& minor : out[power]) {
      set_zero(minor, n);
    }
    for (std::size_t a = 0; a < 2; ++a) {
      if (a <= power && power - a < 2) {
        add_minors((*nets[a])[first], (*nets[power - a])[first + 1], out[power]);
      }
    }
  }
}

/// Laplace's expansion of a power of t.
void DeterminantNets::add_expansion(const Minors& first, const Minors& second, std::size_t power,
                                    BoundedPolynomial& out) {
  const NetShape first_shape = product_shape(still_[0].shape, still_[1].shape);
  const NetShape second_shape = product_shape(still_[2].shape, still_[3].shape);
  out.shape = product_shape(first_shape, second_shape);
  set_zero(out.coefficients, out.shape.n());
  for (std::size_t a = 0; a <= std::min<std::size_t>(power, 2); ++a) {
    for (std::size_t i = 0; i < 6 && power - a < 3; i += 3) {
      std::array<NetProduct, 3> terms{};
      for (std::size_t j = 0; j < 3; ++j) {
        terms[j] = {first[a][i + j].data(), second[power - a][5 - i - j].data(), kPairSigns[i + j]};
      }
      add_products(terms, first_shape, second_shape, out.coefficients.data(), room_);
    }
  }
}

/// The powers of t of the determinant of the columns in still_ and moving_.
void DeterminantNets::expand_rational(std::span<BoundedPolynomial> powers,
                                      const Collapse& collapse) {
  const std::array<const Nets*, 2> nets = {&still_, &moving_};
  find_minors(0, powers.size(), minors_[0]);
  find_minors(2, powers.size(), minors_[1]);
  const double n_additions =
      6.0 * static_cast<double>(std::min(product_shape(still_[0].shape, still_[1].shape).n(),
                                         product_shape(still_[2].shape, still_[3].shape).n()));
  for (std::size_t power = 0; power < powers.size(); ++power) {
    Sizes sizes;
    for (unsigned which = 0; which < 16; ++which) {
      if (static_cast<std::size_t>(std::popcount(which)) == power) {
        const auto column = [&](std::size_t i) { return &(*nets[which >> i & 1])[i]; };
        sizes.add({column(0), column(1), column(2), column(3)});
        sizes.n_additions += n_additions;
      }
    }
    add_expansion(minors_[0], minors_[1], power, powers[power]);
    for (const int axis : {1, 2}) {
      sizes.grow(lower_degree(powers[power], axis));
    }
    sizes.grow(drop_factors(powers[power], collapse));
    finish(sizes, powers[power]);
  }
}

void DeterminantNets::rational_determinant(const HomogeneousPatch& patch, const Collapse& collapse,
                                           BoundedPolynomial& out) {
  derive(patch, still_);
  expand_rational({&out, 1}, collapse);
}

void DeterminantNets::moving_rational_determinant(const HomogeneousPatch& start,
                                                  const HomogeneousPatch& motion, bool is_parallel,
                                                  const Collapse& collapse,
                                                  std::array<BoundedPolynomial, 4>& out) {
  derive(start, still_);
  derive(motion, moving_);
  const std::size_t n_powers = is_parallel ? 2 : 4;
  expand_rational(std::span(out).first(n_powers), collapse);
  for (std::size_t power = n_powers; power < 4; ++power) {
    out[power].shape = out[0].shape;
    set_zero(out[power].coefficients, out[0].shape.n());
    out[power].error = 0;
  }
}

}  // namespace espalier
