// Collapsed faces by the points and weights that they depend on.

#include "deform/injectivity/rational_patch.h"

#include <array>
#include <cmath>

namespace espalier {
namespace {

/// Whether a b = c d exactly.
bool are_products_equal(double a, double b, double c, double d) {
  const double left = a * b;
  const double right = c * d;
  return left == right && std::fma(a, b, -left) == std::fma(c, d, -right);
}

/// The points of a block that a face of the patch depends on.
class FacePoints {
 public:
  FacePoints(const Volume& volume, std::size_t patch, int axis, int end)
      : block_(volume.block(patch)), axis_(static_cast<std::size_t>(axis)) {
    for (std::size_t a = 0; a < 3; ++a) {
      const Extraction& extraction = volume.extractions()[volume.patch(patch).extractions[a]];
      size_[a] = extraction.n_coefficients;
      for (int k = 0; k < size_[a]; ++k) {
        if (a != axis_ || extraction.row(end == 0 ? 0 : extraction.degree, k) != 0) {
          used_[a].push_back(k);
        }
      }
    }
  }

  /// Whether `is_right(point, reference)` for all points, the reference the first with the same
  /// index along `kept`, or the first of all if kept is the axis across the face.
  template <class IsRight>
  [[nodiscard]] bool all_of(int kept, const IsRight& is_right) const {
    std::array<int, 3> first = {used_[0].front(), used_[1].front(), used_[2].front()};
    for (const int k : used_[2]) {
      for (const int j : used_[1]) {
        for (const int i : used_[0]) {
          const std::array<int, 3> index = {i, j, k};
          std::array<int, 3> reference = first;
          const auto at = static_cast<std::size_t>(kept);
          reference[at] = at == axis_ ? first[at] : index[at];
          if (!is_right(point(index), point(reference))) {
            return false;
          }
        }
      }
    }
    return true;
  }

  /// Whether the weights are products of one that depends on the index along `axis` and one that
  /// does not.
  [[nodiscard]] bool is_separable(int axis, std::span<const double> weights) const {
    const auto at = static_cast<std::size_t>(axis);
    const std::array<int, 3> first = {used_[0].front(), used_[1].front(), used_[2].front()};
    const auto weight = [&](const std::array<int, 3>& index) {
      return weights[static_cast<std::size_t>(point(index))];
    };
    for (const int k : used_[2]) {
      for (const int j : used_[1]) {
        for (const int i : used_[0]) {
          const std::array<int, 3> index = {i, j, k};
          std::array<int, 3> without = index;
          std::array<int, 3> alone = first;
          without[at] = first[at];
          alone[at] = index[at];
          if (!are_products_equal(weight(index), weight(first), weight(without), weight(alone))) {
            return false;
          }
        }
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::int32_t point(const std::array<int, 3>& index) const {
    return block_[static_cast<std::size_t>(index[0] + size_[0] * (index[1] + size_[1] * index[2]))];
  }

  std::span<const std::int32_t> block_;
  std::size_t axis_;
  std::array<int, 3> size_{};
  std::array<std::vector<int>, 3> used_;
};

}  // namespace

Collapse rational_collapse(const Volume& volume, std::size_t patch,
                           std::span<const glm::dvec3> points, std::span<const double> weights) {
  const auto is_same = [&](std::int32_t a, std::int32_t b) {
    return points[static_cast<std::size_t>(a)] == points[static_cast<std::size_t>(b)];
  };
  Collapse collapse;
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const FacePoints face(volume, patch, axis, end);
      const bool is_point = face.all_of(axis, is_same);
      for (const int derivative : {(axis + 1) % 3, (axis + 2) % 3}) {
        const int kept = 3 - axis - derivative;
        if (is_point ||
            (face.all_of(kept, is_same) && (weights.empty() || face.is_separable(kept, weights)))) {
          collapse.add(derivative, axis, end);
        }
      }
    }
  }
  collapse.keep_factors(volume.degree(patch));
  return collapse;
}

void homogeneous_points(const BezierView& patch, const glm::dvec3& centre,
                        std::vector<glm::dvec4>& out) {
  out.resize(patch.points.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double weight = patch.is_rational() ? patch.weights[i] : 1;
    out[i] = glm::dvec4(patch.points[i] - weight * centre, weight);
  }
}

double weight_at(const BezierView& patch, const glm::dvec3& uvw) {
  if (!patch.is_rational()) {
    return 1;
  }
  std::vector<glm::dvec3> weights(patch.weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i].x = patch.weights[i];
  }
  return BezierView{patch.degree, weights}.value(uvw).x;
}

}  // namespace espalier
