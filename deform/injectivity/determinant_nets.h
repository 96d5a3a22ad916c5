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
  void add(int derivative, int axis, int end) {
    auto& bits = factors[static_cast<std::size_t>(derivative)];
    bits = static_cast<std::uint8_t>(bits | 1U << (2 * axis + end));
  }
  /// Without derivatives that vanish at both ends of an axis of degree 1, and so throughout.
  void keep_factors(const std::array<int, 3>& degree);

  [[nodiscard]] Collapse operator&(const Collapse& other) const {
    Collapse result;
    for (std::size_t a = 0; a < 3; ++a) {
      result.factors[a] = static_cast<std::uint8_t>(factors[a] & other.factors[a]);
    }
    return result;
  }
  bool operator==(const Collapse&) const = default;
};

/// The factors that both maps have, as far as their points are equal to the bit. Of one degree.
[[nodiscard]] Collapse common_collapse(const BezierView& a, const BezierView& b);

/// A rational hexahedron by its homogeneous points P = (wx, wy, wz, w), or how they move.
struct HomogeneousPatch {
  std::array<int, 3> degree = {1, 1, 1};
  std::span<const glm::dvec4> points;  ///< #(p+1)(q+1)(r+1), u fastest
  glm::dvec4 error{0};                 ///< what each component may be off by
};

/// A patch on the move: X + t V.
struct MovingPatch {
  BezierView start;          ///< X
  BezierView motion;         ///< V
  bool is_parallel = false;  ///< V's points are all multiples of one vector
  double start_error = 0;    ///< what each coordinate of X's points may be off by
  double motion_error = 0;   ///< the same of V's
};

/// Determinants of the derivatives of Bézier hexahedra by products of nets. Keeps its memory: no
/// call for polynomials allocates once a degree has been seen. One thread at a time.
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

  /// Of a rational hexahedron: w⁴ det ∂X/∂(u,v,w), which is det(∂P/∂u, ∂P/∂v, ∂P/∂w, P), divided
  /// by the factors of the collapse; of degree 4p − 2 an axis, less the factors.
  void rational_determinant(const HomogeneousPatch& patch, const Collapse& collapse,
                            BoundedPolynomial& out);

  /// Σ_k t^k out[k], the same of P + t M. motion: M, whose weights are 0; is_parallel: its points
  /// are all multiples of one vector, then out[2] and out[3] are zero.
  void moving_rational_determinant(const HomogeneousPatch& start, const HomogeneousPatch& motion,
                                   bool is_parallel, const Collapse& collapse,
                                   std::array<BoundedPolynomial, 4>& out);

 private:
  using Components = std::array<std::vector<double>, 4>;

  /// What of a map's points a net is made of: differences of neighbours along an axis, times the
  /// degree; or all points but the last, or the first, along it.
  enum class NetPart { Slope, Low, High };

  /// A derivative, or another part of a map: Bernstein coefficients times binomials.
  struct Net {
    NetShape shape;
    Components values;
    std::array<double, 4> largest{};  // of the sizes of the Bernstein coefficients
    std::array<double, 4> errors{};   // of each of them, from the input
  };
  using Nets = std::array<Net, 4>;
  /// Of two columns by power of t, and by pair of rows.
  using Minors = std::array<std::array<std::vector<double>, 6>, 3>;
  struct Table {
    NetShape shape;
    std::vector<double> binomials;  // products of three
  };
  struct Sizes;

  [[nodiscard]] const std::vector<double>& binomials(const NetShape& shape);
  void derive(const double* points, std::size_t n_components, const std::array<int, 3>& degree,
              int axis, NetPart part, const Collapse& collapse, const std::array<double, 4>& errors,
              Net& net);
  void derive(const BezierView& patch, const Collapse& collapse, double input_error, Nets& nets);
  void derive(const HomogeneousPatch& patch, Nets& nets);
  void add_cross(const Net& a, const Net& b, Components& out);
  void add_dot(const Net& a, const Components& cross, const NetShape& cross_shape,
               BoundedPolynomial& out);
  void add_minors(const Net& a, const Net& b, std::array<std::vector<double>, 6>& out);
  void find_minors(std::size_t first, std::size_t n_powers, Minors& out);
  void add_expansion(const Minors& first, const Minors& second, std::size_t power,
                     BoundedPolynomial& out);
  void expand_rational(std::span<BoundedPolynomial> powers, const Collapse& collapse);
  void finish(const Sizes& sizes, BoundedPolynomial& out);

  Nets still_;
  Nets moving_;
  std::array<Components, 3> crosses_;
  std::array<Minors, 2> minors_;
  std::vector<double> room_;
  std::deque<Table> tables_;  // never moved
};

}  // namespace espalier
