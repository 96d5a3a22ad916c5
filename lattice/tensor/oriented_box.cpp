// Boxes round points; principal directions by Jacobi's rotations.

#include "lattice/tensor/oriented_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr double kThinnest = 1e-3;  // of the diagonal

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The box of the points in the frame of `axes`, padded.
OrientedBox box_along(const glm::dmat3& axes, std::span<const glm::dvec3> points, double padding) {
  if (!(padding >= 0 && padding <= 100)) {
    throw ParameterError("the padding is a fraction of the diagonal, from 0 to 100");
  }
  Box box;
  for (const glm::dvec3& point : points) {
    if (is_finite(point)) {
      box.add(glm::transpose(axes) * point);
    }
  }
  const double diagonal = 2 * box.radius();
  if (!(diagonal > 0)) {
    throw ParameterError("there are no points with an extent to fit a box to");
  }
  const glm::dvec3 half = 0.5 * (box.max - box.min);
  return {axes * box.center(), axes, glm::max(half + padding * diagonal, kThinnest * diagonal / 2)};
}

/// Covariance of the finite points, in units of their extent.
glm::dmat3 covariance(std::span<const glm::dvec3> points) {
  const Box box = box_of(points);
  const double scale = box.radius() > 0 ? box.radius() : 1;
  glm::dvec3 mean(0);
  double n = 0;
  for (const glm::dvec3& point : points) {
    if (is_finite(point)) {
      mean += (point - box.center()) / scale;
      ++n;
    }
  }
  mean /= std::max(n, 1.0);
  glm::dmat3 sum(0);
  for (const glm::dvec3& point : points) {
    if (is_finite(point)) {
      const glm::dvec3 from = (point - box.center()) / scale - mean;
      sum += glm::outerProduct(from, from);
    }
  }
  return sum / std::max(n, 1.0);
}

/// Unit eigenvectors of a symmetric matrix as columns, by cyclic Jacobi rotations.
glm::dmat3 eigenvectors(glm::dmat3 A) {
  glm::dmat3 V(1.0);
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (const auto& [p, q] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
      if (A[p][q] == 0) {
        continue;
      }
      const double theta = (A[q][q] - A[p][p]) / (2 * A[p][q]);
      const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
      const double c = 1 / std::hypot(t, 1.0);
      glm::dmat3 R(1.0);
      R[p][p] = R[q][q] = c;
      R[q][p] = t * c;
      R[p][q] = -t * c;
      A = glm::transpose(R) * A * R;
      V = V * R;
    }
  }
  return V;
}

}  // namespace

OrientedBox oriented(const Box& box) {
  return {box.center(), glm::dmat3(1.0), 0.5 * (box.max - box.min)};
}

OrientedBox fitted_box(std::span<const glm::dvec3> points, double padding) {
  return box_along(glm::dmat3(1.0), points, padding);
}

OrientedBox fitted_principal_box(std::span<const glm::dvec3> points, double padding) {
  const glm::dmat3 V = eigenvectors(covariance(points));
  // The order and the signs with the largest trace: closest to the coordinate axes.
  glm::dmat3 best(1.0);
  double most = -1;
  std::array<int, 3> order = {0, 1, 2};
  do {
    glm::dmat3 axes;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& v = V[order[static_cast<std::size_t>(i)]];
      axes[i] = v[i] < 0 ? -v : v;
    }
    const double trace = axes[0].x + axes[1].y + axes[2].z;
    if (trace > most) {
      most = trace;
      best = axes;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  if (glm::determinant(best) < 0) {
    best[2] = -best[2];
  }
  return box_along(best, points, padding);
}

}  // namespace espalier
