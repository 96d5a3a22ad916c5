// Determinants by products of derivative nets.

#include "deform/injectivity/determinant_nets.h"

#include <algorithm>
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

std::array<double, 4> grown(const std::array<double, 4>& sizes, double by) {
  return {sizes[0] + by, sizes[1] + by, sizes[2] + by, sizes[3] + by};
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
      wide[n] = grown(net->largest, net->error);
      ++n;
      n_additions += 4.0 * static_cast<double>(net->shape.n());
    }
    const unsigned rows = (1U << n) - 1;
    const double largest = permanent(std::span(wide).first(n), rows);
    absolute += largest;
    spread += std::max(0.0, largest - permanent(std::span(exact).first(n), rows));
    n_additions += 40;
  }
};

Collapse common_collapse(const BezierView& a, const BezierView& b) {
  assert(a.degree == b.degree);
  Collapse result;
  for (int derivative = 0; derivative < 3; ++derivative) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int end = 0; end < 2 && axis != derivative; ++end) {
        if (is_zero_at(a, derivative, axis, end) && is_zero_at(b, derivative, axis, end)) {
          auto& factors = result.factors[static_cast<std::size_t>(derivative)];
          factors = static_cast<std::uint8_t>(factors | 1U << (2 * axis + end));
        }
      }
    }
  }
  return result;
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

/// The derivative along an axis, or the map itself for axis 3. A factor 1 − t of a polynomial is
/// divided out of coefficients times binomials by dropping the last, which is zero; t by dropping
/// the first.
void DeterminantNets::derive(const double* points, int n_components,
                             const std::array<int, 3>& degree, int axis, const Collapse& collapse,
                             double input_error, Net& net) {
  NetShape full{{degree[0] + 1, degree[1] + 1, degree[2] + 1}};
  const std::array<int, 3> stride = {1, full.size[0], full.size[0] * full.size[1]};
  int step = 0;
  double slope = 1;
  if (axis < 3) {
    const auto a = static_cast<std::size_t>(axis);
    step = stride[a];
    slope = degree[a];
    --full.size[a];
  }
  std::array<int, 3> first{};
  net.shape = full;
  net.error = (axis < 3 ? 2 * slope : 1) * input_error;
  for (int b = 0; b < 3 && axis < 3; ++b) {
    for (int end = 0; end < 2; ++end) {
      if (collapse.has(axis, b, end)) {
        const auto at = static_cast<std::size_t>(b);
        first[at] += end == 0 ? 1 : 0;
        --net.shape.size[at];
        net.error *= degree[at];
      }
    }
  }
  const std::vector<double>& scales = binomials(full);
  const std::vector<double>& own = binomials(net.shape);
  net.largest = {};
  for (int c = 0; c < n_components; ++c) {
    auto& values = net.values[static_cast<std::size_t>(c)];
    values.resize(net.shape.n());
    double largest = 0;
    std::size_t out = 0;
    for (int k = 0; k < net.shape.size[2]; ++k) {
      for (int j = 0; j < net.shape.size[1]; ++j) {
        const int row = first[0] + stride[1] * (j + first[1]) + stride[2] * (k + first[2]);
        const int scale_row =
            first[0] + full.size[0] * (j + first[1] + full.size[1] * (k + first[2]));
        for (int i = 0; i < net.shape.size[0]; ++i, ++out) {
          const double* at = points + n_components * (row + i) + c;
          const double value = step == 0 ? *at : slope * (at[n_components * step] - *at);
          values[out] = scales[static_cast<std::size_t>(scale_row + i)] * value;
          largest = std::max(largest, std::abs(values[out]) / own[out]);
        }
      }
    }
    net.largest[static_cast<std::size_t>(c)] = largest;
  }
}

void DeterminantNets::derive(const BezierView& patch, const Collapse& collapse, double input_error,
                             Nets& nets) {
  assert(patch.points.size() == n_coefficients(patch.degree));
  for (int axis = 0; axis < 3; ++axis) {
    derive(glm::value_ptr(patch.points[0]), 3, patch.degree, axis, collapse, input_error,
           nets[static_cast<std::size_t>(axis)]);
  }
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
  const std::size_t n = product_shape(a.shape, b.shape).n();
  for (std::size_t i = 0; i < 6; ++i) {
    const auto [y, z] = kPairs[i];
    const std::array<NetProduct, 2> terms = {{{a.values[y].data(), b.values[z].data(), 1},
                                              {a.values[z].data(), b.values[y].data(), -1}}};
    set_zero(out[i], n);
    add_products(terms, a.shape, b.shape, out[i].data(), room_);
  }
}

void DeterminantNets::rational_determinant(const std::array<int, 3>& degree,
                                           std::span<const glm::dvec4> points, double input_error,
                                           BoundedPolynomial& out) {
  assert(points.size() == n_coefficients(degree));
  const double* numbers = glm::value_ptr(points[0]);
  for (int axis = 0; axis < 3; ++axis) {
    derive(numbers, 4, degree, axis, {}, input_error, still_[static_cast<std::size_t>(axis)]);
  }
  derive(numbers, 4, degree, 3, {}, input_error, position_);
  add_minors(still_[0], still_[1], minors_[0]);
  add_minors(still_[2], position_, minors_[1]);
  const NetShape first = product_shape(still_[0].shape, still_[1].shape);
  const NetShape second = product_shape(still_[2].shape, position_.shape);
  out.shape = product_shape(first, second);
  set_zero(out.coefficients, out.shape.n());
  for (std::size_t i = 0; i < 6; i += 3) {
    std::array<NetProduct, 3> terms{};
    for (std::size_t j = 0; j < 3; ++j) {
      terms[j] = {minors_[0][i + j].data(), minors_[1][5 - i - j].data(), kPairSigns[i + j]};
    }
    add_products(terms, first, second, out.coefficients.data(), room_);
  }
  Sizes sizes;
  sizes.add({&still_[0], &still_[1], &still_[2], &position_});
  // The second factor of the expansion has more coefficients than any single net.
  sizes.n_additions += 6.0 * static_cast<double>(std::min(first.n(), second.n()));
  finish(sizes, out);
}

}  // namespace espalier
