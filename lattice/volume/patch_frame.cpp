#include "lattice/volume/patch_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

namespace espalier {
namespace {

constexpr double kRoundOff = 16 * std::numeric_limits<double>::epsilon();

/// The inverse, or nothing where the columns are dependent.
std::optional<glm::dmat3> inverse(const glm::dmat3& A) {
  const double det = glm::determinant(A);
  const double size = glm::length(A[0]) * glm::length(A[1]) * glm::length(A[2]);
  if (!(std::abs(det) > 1e-14 * size)) {
    return std::nullopt;
  }
  return glm::inverse(A);
}

/// Of a sum of the patch's points.
double round_off(const BezierView& patch) {
  double largest = 0;
  for (const glm::dvec3& point : patch.points) {
    const glm::dvec3 size = glm::abs(point);
    largest = std::max({largest, size.x, size.y, size.z});
  }
  return kRoundOff * largest;
}

double length_of_row(const glm::dmat3& A, int row) {
  return glm::length(glm::dvec3(A[0][row], A[1][row], A[2][row]));
}

/// Calls visit(i, j, k, point) for all points of a patch.
template <class Visit>
void visit_points(const BezierView& patch, const Visit& visit) {
  std::size_t at = 0;
  for (int k = 0; k <= patch.degree[2]; ++k) {
    for (int j = 0; j <= patch.degree[1]; ++j) {
      for (int i = 0; i <= patch.degree[0]; ++i) {
        visit(i, j, k, patch.points[at++]);
      }
    }
  }
}

bool equals(const BezierView& patch, const AffineMap& map, double tolerance) {
  const auto [p, q, r] = patch.degree;
  bool result = p > 0 && q > 0 && r > 0;
  visit_points(patch, [&, p = p, q = q, r = r](int i, int j, int k, const glm::dvec3& point) {
    const glm::dvec3 uvw =
        glm::dvec3(i, j, k) / glm::dvec3(std::max(p, 1), std::max(q, 1), std::max(r, 1));
    result = result && glm::distance(map.value(uvw), point) <= tolerance;
  });
  return result;
}

/// The least slope of a coordinate of the points along its axis, in the frame.
glm::dvec3 least_slopes(const BezierView& patch, const glm::dmat3& inverse) {
  const std::array<int, 3> stride = {1, patch.degree[0] + 1,
                                     (patch.degree[0] + 1) * (patch.degree[1] + 1)};
  glm::dvec3 least(std::numeric_limits<double>::infinity());
  std::size_t at = 0;
  visit_points(patch, [&](int i, int j, int k, const glm::dvec3& point) {
    const std::array<int, 3> index = {i, j, k};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (index[a] < patch.degree[a]) {
        const glm::dvec3 step = patch.points[at + static_cast<std::size_t>(stride[a])] - point;
        least[axis] = std::min(least[axis], patch.degree[a] * (inverse * step)[axis]);
      }
    }
    ++at;
  });
  return least;
}

/// The points of a rational patch where they stand, as those of a polynomial: its hull holds both.
BezierPatch control_net(const BezierView& patch) {
  BezierPatch net{patch.degree, {}};
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    net.points.push_back(patch.position(i));
  }
  return net;
}

}  // namespace

AffineMap affine_map(const BezierView& patch) {
  const auto [p, q, r] = patch.degree;
  const auto corner = [&, p = p, q = q, r = r](int i, int j, int k) -> const glm::dvec3& {
    return patch.points[static_cast<std::size_t>(i * p + (p + 1) * (j * q + (q + 1) * k * r))];
  };
  const std::array<glm::dvec3, 2> low = {corner(0, 0, 0) + corner(0, 1, 0),
                                         corner(0, 0, 1) + corner(0, 1, 1)};
  const std::array<glm::dvec3, 2> high = {corner(1, 0, 0) + corner(1, 1, 0),
                                          corner(1, 0, 1) + corner(1, 1, 1)};
  const glm::dvec3 front = corner(0, 0, 0) + corner(1, 0, 0) + corner(0, 0, 1) + corner(1, 0, 1);
  const glm::dvec3 sum = low[0] + low[1] + high[0] + high[1];
  return {sum / 8.0,
          {(high[0] + high[1] - low[0] - low[1]) / 4.0, (sum - 2.0 * front) / 4.0,
           (high[1] + low[1] - high[0] - low[0]) / 4.0}};
}

PatchFrame::PatchFrame(const BezierView& patch) : is_pyramid_(patch.is_pyramid) {
  if (patch.is_rational()) {
    *this = PatchFrame(control_net(patch));
    forget_slopes();
    return;
  }
  map_ = affine_map(patch);
  const auto found = inverse(map_.axes);
  if (!found) {
    return;
  }
  inverse_ = *found;
  is_affine_ = !is_pyramid_ && equals(patch, map_, round_off(patch));
  if (is_affine_) {
    for (int axis = 0; axis < 3; ++axis) {
      least_slope_[axis] = 1 / length_of_row(inverse_, axis);
    }
  }
}

PatchFrame::PatchFrame(const BezierPatch& patch, double slack, const Box& reach)
    : PatchFrame(patch) {
  if (patch.view().is_rational()) {
    *this = PatchFrame(control_net(patch), slack, reach);
    forget_slopes();
    return;
  }
  if (inverse_ == glm::dmat3(0)) {
    return;
  }
  bounds_ = Box();
  for (const glm::dvec3& point : patch.points) {
    bounds_.add(local(point));
  }
  if (reach.min != glm::dvec3(0) || reach.max != glm::dvec3(1)) {
    for (const glm::dvec3& point : patch.part(reach.min, reach.max).points) {
      bounds_.add(local(point));
    }
  }
  const glm::dvec3 slopes = least_slopes(patch, inverse_);
  for (int axis = 0; axis < 3; ++axis) {
    const double scale = length_of_row(inverse_, axis);
    const double margin = (slack + 4 * round_off(patch)) * scale + kRoundOff;
    bounds_.min[axis] -= margin;
    bounds_.max[axis] += margin;
    least_slope_[axis] = std::max(0.0, slopes[axis]) / scale;
  }
}

glm::dvec3 PatchFrame::guess_from(const glm::dvec3& local) const {
  if (!is_pyramid_) {
    return local;
  }
  const double factor = 2 * std::max(1 - local.z, 1e-6);
  return {0.5 + (local.x - 0.5) / factor, 0.5 + (local.y - 0.5) / factor, local.z};
}

}  // namespace espalier
