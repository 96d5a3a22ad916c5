#include "deform/evaluate/general_patch.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "deform/evaluate/displace.h"

namespace espalier {
namespace {

template <class Real>
double entry(const Real* blocks, std::size_t n_rows, std::size_t row, std::size_t point) {
  return blocks[(point / kBlock * n_rows + row) * kBlock + point % kBlock];
}

template <class Real>
glm::dvec3 vector_of(const Real* blocks, std::size_t n_rows, std::size_t row, std::size_t point) {
  return {entry(blocks, n_rows, row, point), entry(blocks, n_rows, row + 1, point),
          entry(blocks, n_rows, row + 2, point)};
}

template <class Real>
void put(const glm::dvec3& value, Real* to) {
  for (int axis = 0; axis < 3; ++axis) {
    to[axis] = static_cast<Real>(value[axis]);
  }
}

/// What follows from the change of the slopes. The blocks hold normals and tangents as the
/// parameters see them, and the cofactors of a product are the product of the cofactors.
template <class Real>
void put_frame(const glm::dmat3& change, std::size_t i, const PatchPoints<Real>& points) {
  glm::dmat3 R;
  for (std::size_t a = 0; a < 3; ++a) {
    R[static_cast<int>(a)] = vector_of(points.slopes, kSlopeRows, 3 * a, i);
  }
  const glm::dmat3 J = glm::dmat3(1) + change * glm::inverse(R);
  if (points.gradients != nullptr) {
    for (int b = 0; b < 3; ++b) {
      put(J[b], points.gradients + 9 * i + 3 * static_cast<std::size_t>(b));
    }
  }
  if (points.determinants != nullptr) {
    points.determinants[i] = static_cast<Real>(glm::determinant(J));
  }
  if (points.moved_normals != nullptr) {
    put(turned_normal(R + change, vector_of(points.normals, kVectorRows, 0, i)),
        points.moved_normals + 3 * i);
  }
  if (points.moved_tangents != nullptr) {
    put((R + change) * vector_of(points.tangents, kVectorRows, 0, i),
        points.moved_tangents + 3 * i);
  }
}

}  // namespace

template <class Real>
void evaluate_general(const BezierView& moves, std::span<const glm::dvec3> uvw,
                      const PatchPoints<Real>& points) {
  for (std::size_t i = 0; i < uvw.size(); ++i) {
    glm::dvec3 move;
    glm::dmat3 change;
    if (points.slopes == nullptr) {
      move = moves.value(uvw[i]);
    } else {
      moves.evaluate(uvw[i], move, change);
      put_frame(change, i, points);
    }
    if (points.moved_points != nullptr) {  // 0 − move: a point that stays keeps a coordinate −0
      put(vector_of(points.places, kPlaceRows, 3, i) - (0.0 - move), points.moved_points + 3 * i);
    }
  }
}

template void evaluate_general(const BezierView&, std::span<const glm::dvec3>,
                               const PatchPoints<float>&);
template void evaluate_general(const BezierView&, std::span<const glm::dvec3>,
                               const PatchPoints<double>&);

}  // namespace espalier
