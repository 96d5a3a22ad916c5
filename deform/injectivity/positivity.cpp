// Signs of polynomials by Bernstein coefficients and subdivision.

#include "deform/injectivity/positivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnit = std::numeric_limits<double>::epsilon();

/// The halves of the lines along an axis by de Casteljau's algorithm: `values` becomes the lower.
void halve_lines(const NetShape& shape, int axis, std::vector<double>& values,
                 std::vector<double>& upper) {
  upper.resize(values.size());
  const auto n = static_cast<std::size_t>(shape.size[static_cast<std::size_t>(axis)]);
  std::size_t stride = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(axis); ++a) {
    stride *= static_cast<std::size_t>(shape.size[a]);
  }
  for (std::size_t first = 0; first < values.size(); first += n * stride) {
    double* line = values.data() + first;
    double* high = upper.data() + first;
    for (std::size_t left = n; left > 0; --left) {  // the last of each round is final
      std::copy_n(line + (n - 1) * stride, stride, high + (left - 1) * stride);
      for (std::size_t i = n - 1; i > n - left; --i) {
        if (stride == 1) {  // a loop over one number costs more than the number
          line[i] = 0.5 * (line[i] + line[i - 1]);
          continue;
        }
        double* at = line + i * stride;
        const double* before = at - stride;
        for (std::size_t s = 0; s < stride; ++s) {
          at[s] = 0.5 * (at[s] + before[s]);
        }
      }
    }
  }
}

double largest_size(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// Halving adds a rounding error a round to every coefficient.
double error_of_halving(const NetShape& shape, int axis, double largest) {
  return kUnit * shape.size[static_cast<std::size_t>(axis)] * largest;
}

std::array<int, 3> place_of(const NetShape& shape, std::size_t index) {
  const int at = static_cast<int>(index);
  return {at % shape.size[0], at / shape.size[0] % shape.size[1],
          at / (shape.size[0] * shape.size[1])};
}

/// The axis along which a coefficient lies farthest from both ends of the net, in units of the
/// degree; of several the one with the longest side of the box.
int axis_to_halve(const NetShape& shape, std::size_t index, const ParameterBox& box) {
  const std::array<int, 3> place = place_of(shape, index);
  int best = -1;
  double best_depth = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (shape.size[a] == 1) {
      continue;
    }
    const bool is_inner = place[a] > 0 && place[a] < shape.size[a] - 1;
    const double depth = (is_inner ? 1 : 1e-3) * (box.high[axis] - box.low[axis]);
    if (depth > best_depth) {
      best_depth = depth;
      best = axis;
    }
  }
  return std::max(best, 0);
}

/// Calls visit(index, uvw) for the corners of a box.
template <class Visit>
void for_each_corner(const NetShape& shape, const ParameterBox& box, const Visit& visit) {
  const auto [nu, nv, nw] = shape.size;
  for (int corner = 0; corner < 8; ++corner) {
    const bool i = (corner & 1) != 0;
    const bool j = (corner & 2) != 0;
    const bool k = (corner & 4) != 0;
    const int at = (i ? nu - 1 : 0) + nu * ((j ? nv - 1 : 0) + nv * (k ? nw - 1 : 0));
    visit(static_cast<std::size_t>(at),
          glm::dvec3(i ? box.high.x : box.low.x, j ? box.high.y : box.low.y,
                     k ? box.high.z : box.low.z));
  }
}

/// A t below which c[0] + c[1] t + c[2] t² + c[3] t³ has no zero: the first zero, rounded down.
double first_zero(const std::array<double, 4>& c) {
  if (!(c[0] > 0)) {
    return 0;
  }
  const double down = -std::min(c[1], 0.0);
  if (c[2] == 0 && c[3] == 0) {
    return down > 0 ? c[0] / down * (1 - 4 * kUnit) : kInfinity;
  }
  // Each term against its share of c0 gives a first step without a zero; then the same from there.
  double t = 0;
  std::array<double, 4> at = c;
  for (int round = 0; round < 200; ++round) {
    double step = kInfinity;
    const double share = at[0] / 3;
    for (std::size_t k = 1; k < 4; ++k) {
      if (at[k] < 0) {
        step = std::min(step, std::pow(share / -at[k], 1.0 / static_cast<double>(k)));
      }
    }
    if (step == kInfinity) {
      return kInfinity;
    }
    const double next = (t + step) * (1 - 4 * kUnit);
    const double slack =
        32 * kUnit *
        (std::abs(c[0]) +
         next * (std::abs(c[1]) + next * (std::abs(c[2]) + next * std::abs(c[3]))));
    const double value = c[0] + next * (c[1] + next * (c[2] + next * c[3])) - slack;
    if (!(next > t * (1 + 1e-9)) || !(value > 0)) {
      break;
    }
    t = next;
    at = {value, c[1] + t * (2 * c[2] + 3 * t * c[3]), c[2] + 3 * t * c[3], c[3]};
    // Slopes are rounded too: lower them.
    at[1] -= 32 * kUnit * (std::abs(c[1]) + t * (2 * std::abs(c[2]) + 3 * t * std::abs(c[3])));
    at[2] -= 32 * kUnit * (std::abs(c[2]) + 3 * t * std::abs(c[3]));
  }
  return t * (1 - 4 * kUnit);
}

struct Part {
  ParameterBox box;
  std::vector<double> coefficients;
  double error;
};

/// Whether a part is positive; at a corner that is surely negative `found` is filled in.
bool is_positive(const NetShape& shape, const Part& part, std::size_t& least, Positivity& found) {
  const auto& c = part.coefficients;
  least = static_cast<std::size_t>(std::min_element(c.begin(), c.end()) - c.begin());
  const bool all_numbers =
      std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); });
  if (all_numbers && c[least] > part.error) {
    return true;
  }
  for_each_corner(shape, part.box, [&](std::size_t at, const glm::dvec3& uvw) {
    if (all_numbers && c[at] < -part.error && c[at] < found.value) {
      found.verdict = Verdict::Folded;
      found.value = c[at];
      found.witness = uvw;
    }
  });
  return false;
}

}  // namespace

Positivity positivity(BoundedPolynomial& polynomial, std::size_t most_boxes) {
  Positivity result;
  const NetShape shape = polynomial.shape;
  std::vector<Part> parts;
  parts.push_back({{}, std::move(polynomial.coefficients), polynomial.error});
  std::vector<double> spare;
  while (!parts.empty()) {
    Part& part = parts.back();
    std::size_t least = 0;
    ++result.n_boxes;
    if (is_positive(shape, part, least, result)) {
      spare = std::move(part.coefficients);
      parts.pop_back();
      continue;
    }
    if (result.verdict == Verdict::Folded) {
      result.undecided.clear();
      break;
    }
    const double largest = largest_size(part.coefficients);
    const int axis = axis_to_halve(shape, least, part.box);
    const double width = part.box.high[axis] - part.box.low[axis];
    if (result.n_boxes >= most_boxes || !(largest > part.error) || width < 1e-6) {
      result.undecided.push_back(part.box);
      parts.pop_back();
      continue;
    }
    Part high{part.box, std::move(spare), part.error + error_of_halving(shape, axis, largest)};
    spare = {};
    halve_lines(shape, axis, part.coefficients, high.coefficients);
    part.error = high.error;
    part.box.high[axis] -= 0.5 * width;
    high.box.low[axis] = part.box.high[axis];
    parts.push_back(std::move(high));
  }
  if (result.verdict != Verdict::Folded && !result.undecided.empty()) {
    result.verdict = Verdict::Undecided;
  }
  polynomial.coefficients = std::move(spare);
  return result;
}

PositiveRange range_of(const MovingBox& box, int& axis) {
  PositiveRange range{kInfinity, kInfinity, {}, false};
  std::size_t tightest = 0;
  const std::size_t n = box.coefficients[0].size();
  const auto at = [&](std::size_t i, double error_sign) {
    std::array<double, 4> c{};
    for (std::size_t k = 0; k < box.n_powers; ++k) {
      c[k] = box.coefficients[k][i] + error_sign * box.errors[k];
    }
    return c;
  };
  const double* start = box.coefficients[0].data();
  const double* slope = box.coefficients[1].data();
  const double slack = box.errors[0] * (1 + 8 * kUnit);
  for (std::size_t i = 0; i < n; ++i) {
    // Most coefficients of a linear range are told from the tightest so far at once.
    if (box.n_powers == 2 &&
        (start[i] - slack) * (1 - 8 * kUnit) + range.lower * (slope[i] - box.errors[1]) >
            8 * kUnit * std::abs(slope[i]) * range.lower) {
      continue;
    }
    const std::array<double, 4> c = at(i, -1);
    // Cheaper than the zero itself, and mostly enough: nothing before the least so far.
    const double t = range.lower;
    const bool is_safe =
        t < kInfinity &&
        c[0] + t * (std::min(c[1], 0.0) + t * (std::min(c[2], 0.0) + t * std::min(c[3], 0.0))) >
            8 * kUnit * c[0];
    if (!is_safe) {
      const double zero = first_zero(c);
      if (zero < range.lower) {
        range.lower = zero;
        tightest = i;
      }
    }
  }
  for_each_corner(box.shape, box.box, [&](std::size_t corner, const glm::dvec3& uvw) {
    const std::array<double, 4> c = at(corner, 1);
    const double zero = first_zero(c);
    if (zero < range.upper) {
      range.upper = zero;
      range.limit = uvw;
      range.is_negative = c[0] < 0;
    }
  });
  axis = axis_to_halve(box.shape, tightest, box.box);
  return range;
}

void halve(MovingBox& box, int axis, MovingBox& upper) {
  upper.box = box.box;
  upper.shape = box.shape;
  upper.n_powers = box.n_powers;
  for (std::size_t k = 0; k < box.n_powers; ++k) {
    box.errors[k] += error_of_halving(box.shape, axis, largest_size(box.coefficients[k]));
    halve_lines(box.shape, axis, box.coefficients[k], upper.coefficients[k]);
  }
  upper.errors = box.errors;
  const double middle = 0.5 * (box.box.low[axis] + box.box.high[axis]);
  box.box.high[axis] = middle;
  upper.box.low[axis] = middle;
}

}  // namespace espalier
