#pragma once

/// Evaluation of Bézier hexahedra, with the degree known to the compiler where it is a usual one.

#include <array>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// A degree per axis that the compiler knows.
template <int P, int Q, int R>
struct FixedDegree {
  static constexpr int p = P;
  static constexpr int q = Q;
  static constexpr int r = R;
  static constexpr std::size_t kPlane = 3 * (P + 1) * (Q + 1);
};

/// Any other degree; up to 7 its planes fit into the space that is at hand.
struct AnyDegree {
  int p, q, r;
  static constexpr std::size_t kPlane = 3 * 8 * 8;
};

/// Memory for n numbers: on the stack up to N.
template <std::size_t N>
class Scratch {
 public:
  explicit Scratch(std::size_t n) {
    if (n > N) {
      heap_.resize(n);
    }
  }
  [[nodiscard]] double* data() { return heap_.empty() ? stack_.data() : heap_.data(); }
  [[nodiscard]] double& operator[](std::size_t i) { return data()[i]; }

 private:
  std::array<double, N> stack_;  // NOLINT: written before it is read
  std::vector<double> heap_;
};

/// The Bernstein polynomials of degree n at t, and their derivatives.
inline void bernstein_basis(int n, double t, double* values, double* slopes) {
  const double s = 1 - t;
  const auto raise = [&](int degree) {  // to `degree`
    values[degree] = t * values[degree - 1];
    for (int i = degree - 1; i > 0; --i) {
      values[i] = s * values[i] + t * values[i - 1];
    }
    values[0] *= s;
  };
  values[0] = 1;
  slopes[0] = 0;
  for (int degree = 1; degree < n; ++degree) {
    raise(degree);
  }
  if (n > 0) {
    slopes[0] = -n * values[0];
    for (int i = 1; i < n; ++i) {
      slopes[i] = n * (values[i - 1] - values[i]);
    }
    slopes[n] = n * values[n - 1];
    raise(n);
  }
}

/// The Bernstein polynomials of degree n at t divided by 1 − t; for the last, which has no such
/// factor, 0. B_i^n = (1 − t) n/(n − i) B_i^(n−1).
inline void divided_basis(int n, double t, double* values) {
  double power = 1;  // C(n, i) t^i
  for (int i = 0; i < n; ++i) {
    values[i] = power;
    power *= t * (n - i) / (i + 1);
    for (int j = i + 1; j < n; ++j) {
      values[i] *= 1 - t;
    }
  }
  values[n] = 0;
}

/// out[a] = Σ_k weights[k] in[k·n + a], for a < n; in and out do not overlap. The usual numbers of
/// weights are written out: compilers turn those loops into vector code.
inline void contract(const double* __restrict in, const double* __restrict weights, int n_weights,
                     std::size_t n, double* __restrict out) {
  const auto& w = weights;
  switch (n_weights) {
    case 2:
      for (std::size_t a = 0; a < n; ++a) {
        out[a] = w[0] * in[a] + w[1] * in[n + a];
      }
      return;
    case 3:
      for (std::size_t a = 0; a < n; ++a) {
        out[a] = w[0] * in[a] + w[1] * in[n + a] + w[2] * in[2 * n + a];
      }
      return;
    case 4:
      for (std::size_t a = 0; a < n; ++a) {
        out[a] = w[0] * in[a] + w[1] * in[n + a] + w[2] * in[2 * n + a] + w[3] * in[3 * n + a];
      }
      return;
    default:
      for (std::size_t a = 0; a < n; ++a) {
        out[a] = w[0] * in[a];
      }
      for (std::size_t k = 1; k < static_cast<std::size_t>(n_weights); ++k) {
        for (std::size_t a = 0; a < n; ++a) {
          out[a] += w[k] * in[k * n + a];
        }
      }
  }
}

/// Contracts the points along w, then v, then u: whole planes, rows and points at a time.
template <class Degree>
class BezierEvaluator {
 public:
  BezierEvaluator(Degree degree, const BezierView& patch)
      : degree_(degree), points_(glm::value_ptr(patch.points[0])), is_pyramid_(patch.is_pyramid) {}

  [[nodiscard]] bool is_pyramid() const { return is_pyramid_; }

  [[nodiscard]] glm::dvec3 value(const glm::dvec3& uvw) const {
    const Bases bases(degree_, uvw);
    Scratch<Degree::kPlane> plane(n_plane());
    Scratch<Degree::kPlane> row(n_row());
    glm::dvec3 value;
    contract(points_, bases.w_values(), degree_.r + 1, n_plane(), plane.data());
    contract(plane.data(), bases.v_values(), degree_.q + 1, n_row(), row.data());
    contract(row.data(), bases.u_values(), degree_.p + 1, 3, glm::value_ptr(value));
    return value;
  }

  void evaluate(const glm::dvec3& uvw, glm::dvec3& value, glm::dmat3& derivative) const {
    const Bases bases(degree_, uvw);
    const int nu = degree_.p + 1;
    const int nv = degree_.q + 1;
    const int nw = degree_.r + 1;
    Scratch<Degree::kPlane> plane(n_plane());
    Scratch<Degree::kPlane> plane_w(n_plane());
    contract(points_, bases.w_values(), nw, n_plane(), plane.data());
    contract(points_, bases.w_slopes(), nw, n_plane(), plane_w.data());
    Scratch<Degree::kPlane> row(n_row());
    contract(plane.data(), bases.v_values(), nv, n_row(), row.data());
    contract(row.data(), bases.u_values(), nu, 3, glm::value_ptr(value));
    if (is_pyramid_) {
      Scratch<Degree::kPlane> divided(static_cast<std::size_t>(nw));
      divided_basis(degree_.r, uvw.z, divided.data());
      contract(points_, divided.data(), nw, n_plane(), plane.data());
      contract(plane.data(), bases.v_values(), nv, n_row(), row.data());
    }
    contract(row.data(), bases.u_slopes(), nu, 3, glm::value_ptr(derivative[0]));
    contract(plane.data(), bases.v_slopes(), nv, n_row(), row.data());
    contract(row.data(), bases.u_values(), nu, 3, glm::value_ptr(derivative[1]));
    contract(plane_w.data(), bases.v_values(), nv, n_row(), row.data());
    contract(row.data(), bases.u_values(), nu, 3, glm::value_ptr(derivative[2]));
  }

 private:
  /// Values and slopes of the Bernstein polynomials along the three axes.
  class Bases {
   public:
    Bases(const Degree& degree, const glm::dvec3& uvw)
        : nu_(static_cast<std::size_t>(degree.p + 1)),
          nv_(static_cast<std::size_t>(degree.q + 1)),
          nw_(static_cast<std::size_t>(degree.r + 1)),
          numbers_(2 * (nu_ + nv_ + nw_)) {
      bernstein_basis(degree.p, uvw.x, u_values(), u_slopes());
      bernstein_basis(degree.q, uvw.y, v_values(), v_slopes());
      bernstein_basis(degree.r, uvw.z, w_values(), w_slopes());
    }
    [[nodiscard]] double* u_values() const { return numbers_.data(); }
    [[nodiscard]] double* u_slopes() const { return u_values() + nu_; }
    [[nodiscard]] double* v_values() const { return u_slopes() + nu_; }
    [[nodiscard]] double* v_slopes() const { return v_values() + nv_; }
    [[nodiscard]] double* w_values() const { return v_slopes() + nv_; }
    [[nodiscard]] double* w_slopes() const { return w_values() + nw_; }

   private:
    std::size_t nu_;
    std::size_t nv_;
    std::size_t nw_;
    mutable Scratch<48> numbers_;
  };

  [[nodiscard]] std::size_t n_row() const { return static_cast<std::size_t>(3 * (degree_.p + 1)); }
  [[nodiscard]] std::size_t n_plane() const {
    return n_row() * static_cast<std::size_t>(degree_.q + 1);
  }

  Degree degree_;
  const double* points_;
  bool is_pyramid_;
};

/// Calls use(evaluator) with the fastest evaluator for the patch's degree.
template <class Use>
auto with_evaluator(const BezierView& patch, const Use& use) {
  const auto [p, q, r] = patch.degree;
  if (p == q && q == r) {
    switch (p) {
      case 1:
        return use(BezierEvaluator(FixedDegree<1, 1, 1>{}, patch));
      case 2:
        return use(BezierEvaluator(FixedDegree<2, 2, 2>{}, patch));
      case 3:
        return use(BezierEvaluator(FixedDegree<3, 3, 3>{}, patch));
      default:
        break;
    }
  }
  if (p == 1 && q == 1 && r == 3) {  // the leaves of lines
    return use(BezierEvaluator(FixedDegree<1, 1, 3>{}, patch));
  }
  return use(BezierEvaluator(AnyDegree{p, q, r}, patch));
}

}  // namespace espalier
