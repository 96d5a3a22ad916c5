// Convolution of nets, whole planes of a factor at a time.

#include "deform/injectivity/net_product.h"

#include <algorithm>
#include <cassert>

namespace espalier {
namespace {

constexpr int kMostTerms = 3;
constexpr int kMostShifts = 4;

/// One piece of a row of a's coefficients, times a plane of b, for each term.
struct PlaneStep {
  std::array<std::array<double, kMostShifts>, kMostTerms> a;
  std::array<const double*, kMostTerms> b;
};

/// out[m] += Σ_t Σ_i a_t[i] b_t[m − i]; before b_t[0] there are zeros.
template <int Terms, int Shifts>
void add_plane(const PlaneStep& step, std::size_t n, double* __restrict out) {
  const auto a = step.a;
  const double* __restrict b0 = step.b[0];
  const double* __restrict b1 = Terms > 1 ? step.b[1] : step.b[0];
  const double* __restrict b2 = Terms > 2 ? step.b[2] : step.b[0];
  for (std::size_t m = 0; m < n; ++m) {
    double sum = out[m];
    for (std::size_t i = 0; i < Shifts; ++i) {
      const auto at = static_cast<std::ptrdiff_t>(m) - static_cast<std::ptrdiff_t>(i);
      sum += a[0][i] * b0[at];
      if constexpr (Terms > 1) {
        sum += a[1][i] * b1[at];
      }
      if constexpr (Terms > 2) {
        sum += a[2][i] * b2[at];
      }
    }
    out[m] = sum;
  }
}

using AddPlane = void (*)(const PlaneStep&, std::size_t, double*);
constexpr std::array<std::array<AddPlane, kMostShifts>, kMostTerms> kAddPlane = {
    {{add_plane<1, 1>, add_plane<1, 2>, add_plane<1, 3>, add_plane<1, 4>},
     {add_plane<2, 1>, add_plane<2, 2>, add_plane<2, 3>, add_plane<2, 4>},
     {add_plane<3, 1>, add_plane<3, 2>, add_plane<3, 3>, add_plane<3, 4>}}};

/// b with rows of length `row` that end in zeros, and zeros in front.
const double* with_room(const double* b, const NetShape& shape, std::size_t row, double* room) {
  std::fill_n(room, kMostShifts, 0.0);
  double* at = room + kMostShifts;
  const auto n = static_cast<std::size_t>(shape.size[0]);
  const std::size_t n_rows = shape.n() / n;
  for (std::size_t i = 0; i < n_rows; ++i, at += row, b += n) {
    std::copy_n(b, n, at);
    std::fill(at + n, at + row, 0.0);
  }
  return room + kMostShifts;
}

}  // namespace

NetShape product_shape(const NetShape& a, const NetShape& b) {
  return {{a.size[0] + b.size[0] - 1, a.size[1] + b.size[1] - 1, a.size[2] + b.size[2] - 1}};
}

void add_products(std::span<const NetProduct> terms, const NetShape& a, const NetShape& b,
                  double* out, std::vector<double>& room) {
  assert(!terms.empty() && terms.size() <= kMostTerms);
  const NetShape shape = product_shape(a, b);
  const auto row = static_cast<std::size_t>(shape.size[0]);
  const std::size_t b_plane = row * static_cast<std::size_t>(b.size[1]);
  const std::size_t n_room = b_plane * static_cast<std::size_t>(b.size[2]) + kMostShifts;
  room.resize(std::max(room.size(), n_room * terms.size()));
  std::array<const double*, kMostTerms> planes{};
  for (std::size_t t = 0; t < terms.size(); ++t) {
    planes[t] = with_room(terms[t].b, b, row, room.data() + t * n_room);
  }
  PlaneStep step{};
  const auto a_row = static_cast<std::size_t>(a.size[0]);
  for (std::size_t ka = 0; ka < static_cast<std::size_t>(a.size[2]); ++ka) {
    for (std::size_t ja = 0; ja < static_cast<std::size_t>(a.size[1]); ++ja) {
      for (std::size_t first = 0; first < a_row; first += kMostShifts) {
        const std::size_t n_shifts = std::min<std::size_t>(kMostShifts, a_row - first);
        const std::size_t at = first + a_row * (ja + static_cast<std::size_t>(a.size[1]) * ka);
        for (std::size_t t = 0; t < terms.size(); ++t) {
          for (std::size_t i = 0; i < n_shifts; ++i) {
            step.a[t][i] = terms[t].sign * terms[t].a[at + i];
          }
        }
        const std::size_t n = b_plane - row + static_cast<std::size_t>(b.size[0]) + n_shifts - 1;
        const AddPlane add = kAddPlane[terms.size() - 1][n_shifts - 1];
        for (std::size_t kb = 0; kb < static_cast<std::size_t>(b.size[2]); ++kb) {
          for (std::size_t t = 0; t < terms.size(); ++t) {
            step.b[t] = planes[t] + kb * b_plane;
          }
          add(step, n,
              out + first + row * (ja + static_cast<std::size_t>(shape.size[1]) * (ka + kb)));
        }
      }
    }
  }
}

}  // namespace espalier
