#pragma once

/// Jacobian determinants of Bézier hexahedra as Bernstein coefficients, with what rounding may have
/// done to them.

#include <array>
#include <cstdint>
#include <deque>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "deform/injectivity/net_product.h"
#include "lattice/volume/bezier_patch.h"

namespace espalier {

/// A polynomial on the unit cube: the exact coefficients lie within `error` of the stored ones.
struct BoundedPolynomial {
  NetShape shape;
  std::vector<double> coefficients;  ///< Bernstein, u fastest
  double error = 0;
};

/// Which ends of the cube collapse a patch: bit 2b + e of factors[a] says that the derivative along
/// axis a vanishes at end e (0: 0, 1: 1) of axis b, as its points coincide there. Determinants are
/// divided by these factors, which leaves their sign inside the cube.
struct Collapse {
  std::array<std::uint8_t, 3> factors{};

  [[nodiscard]] bool has(int derivative, int axis, int end) const {
    return (factors[static_cast<std::size_t>(derivative)] >> (2 * axis + end) & 1) != 0;
  }
  bool operator==(const Collapse&) const = default;
};

/// The factors that both maps have, as far as their points are equal to the bit. Of one degree.
[[nodiscard]] Collapse common_collapse(const BezierView& a, const BezierView& b);

/// A patch on the move: X + t V.
struct MovingPatch {
  BezierView start;          ///< X
  BezierView motion;         ///< V
  bool is_parallel = false;  ///< V's points are all multiples of one vector
  double start_error = 0;    ///< what each coordinate of X's points may be off by
  double motion_error = 0;   ///< the same of V's
};

/// Determinants of the derivatives of Bézier hexahedra by products of nets. Keeps its memory: no
/// call allocates once a degree has been seen. One thread at a time.
///
/// Rounding: a Bernstein coefficient of a product is a mean of products of coefficients, so the
/// largest derivatives bound the sum of absolute values of all that is added up for it, and γ_n
/// times that bounds the error. Underflow is allowed for. A coordinate so large that the result
/// is not finite makes the error not finite.
class DeterminantNets {
 public:
  /// det ∂X/∂(u,v,w), divided by the factors of the collapse; of degree 3p − 1 an axis, less the
  /// factors. input_error: what each coordinate of the points may be off by.
  void determinant(const BezierView& patch, const Collapse& collapse, double input_error,
                   BoundedPolynomial& out);

  /// Σ_k t^k out[k] = det ∂(X + t V)/∂(u,v,w), divided the same way. out[2] and out[3] are zero for
  /// parallel motions.
  void moving_determinant(const MovingPatch& patch, const Collapse& collapse,
                          std::array<BoundedPolynomial, 4>& out);

  /// Of a rational hexahedron: w⁴ det ∂X/∂(u,v,w), as the determinant of its homogeneous points
  /// (wx, wy, wz, w) and their derivatives; of degree 4p − 1 an axis. points: #(p+1)(q+1)(r+1).
  void rational_determinant(const std::array<int, 3>& degree, std::span<const glm::dvec4> points,
                            double input_error, BoundedPolynomial& out);

 private:
  using Components = std::array<std::vector<double>, 4>;

  /// A derivative, or the map itself: Bernstein coefficients times binomials.
  struct Net {
    NetShape shape;
    Components values;
    std::array<double, 4> largest{};  // of the sizes of the Bernstein coefficients
    double error = 0;                 // of each of them, from the input
  };
  using Nets = std::array<Net, 3>;
  struct Table {
    NetShape shape;
    std::vector<double> binomials;  // products of three
  };
  struct Sizes;

  [[nodiscard]] const std::vector<double>& binomials(const NetShape& shape);
  void derive(const double* points, int n_components, const std::array<int, 3>& degree, int axis,
              const Collapse& collapse, double input_error, Net& net);
  void derive(const BezierView& patch, const Collapse& collapse, double input_error, Nets& nets);
  void add_cross(const Net& a, const Net& b, Components& out);
  void add_dot(const Net& a, const Components& cross, const NetShape& cross_shape,
               BoundedPolynomial& out);
  void add_minors(const Net& a, const Net& b, std::array<std::vector<double>, 6>& out);
  void finish(const Sizes& sizes, BoundedPolynomial& out);

  Nets still_;
  Nets moving_;
  Net position_;
  std::array<Components, 3> crosses_;
  std::array<std::array<std::vector<double>, 6>, 2> minors_;
  std::vector<double> room_;
  std::deque<Table> tables_;  // never moved
};

}  // namespace espalier
