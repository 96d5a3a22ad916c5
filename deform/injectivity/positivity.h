#pragma once

/// Where polynomials on the unit cube are positive: by their Bernstein coefficients, and by halving
/// the cube where these do not tell.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "deform/injectivity/determinant_nets.h"

namespace espalier {

/// What is known of a sign.
enum class Verdict { Certified, Folded, Undecided };

/// Part of the unit cube.
struct ParameterBox {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};

/// Whether a polynomial is positive on the closed cube.
struct Positivity {
  Verdict verdict = Verdict::Certified;
  glm::dvec3 witness{0};                ///< Folded: where it is surely negative
  double value = 0;                     ///< Folded: its value there
  std::vector<ParameterBox> undecided;  ///< Undecided: where its sign was not found
  std::size_t n_boxes = 0;              ///< looked at
};

/// Never wrong about Certified and Folded, whatever rounding does. most_boxes: how many parts of
/// the cube may be looked at. The polynomial is used up.
[[nodiscard]] Positivity positivity(BoundedPolynomial& polynomial, std::size_t most_boxes);

/// How far t may grow from 0 with Σ_k t^k c_k positive on the cube.
struct PositiveRange {
  double lower = 0;          ///< positive for all 0 <= t < lower; infinite: for all t
  double upper = 0;          ///< the first zero at some point; infinite if none was found
  glm::dvec3 limit{0};       ///< where it is
  bool is_negative = false;  ///< surely negative somewhere at t = 0: at `limit`
};

/// A part of the cube with the polynomials on it.
struct MovingBox {
  ParameterBox box;
  std::array<std::vector<double>, 4> coefficients;
  std::array<double, 4> errors{};
  NetShape shape;
  std::size_t n_powers = 2;
};

/// What the coefficients on a box tell. `axis`: along which to halve it.
[[nodiscard]] PositiveRange range_of(const MovingBox& box, int& axis);

/// Makes `box` its lower half along the axis, and `upper` the other.
void halve(MovingBox& box, int axis, MovingBox& upper);

}  // namespace espalier
