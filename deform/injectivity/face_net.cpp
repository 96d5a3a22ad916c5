#include "deform/injectivity/face_net.h"

#include <algorithm>
#include <cstddef>

#include "lattice/volume/bezier_evaluator.h"

namespace espalier {
namespace {

/// The patch's axes that a face's parameters run along.
std::array<int, 2> axes_of(int face) {
  const int across = face / 2;
  return {across == 0 ? 1 : 0, across == 2 ? 1 : 2};
}

/// Makes n points, `stride` apart, those of the curve on [0, t] or [t, 1].
void keep_below(glm::dvec4* points, int n, std::size_t stride, double t) {
  for (int level = 1; level < n; ++level) {
    for (int i = n - 1; i >= level; --i) {
      const auto k = static_cast<std::size_t>(i) * stride;
      points[k] = (1 - t) * points[k - stride] + t * points[k];
    }
  }
}
void keep_above(glm::dvec4* points, int n, std::size_t stride, double t) {
  for (int level = 1; level < n; ++level) {
    for (int i = 0; i < n - level; ++i) {
      const auto k = static_cast<std::size_t>(i) * stride;
      points[k] = (1 - t) * points[k] + t * points[k + stride];
    }
  }
}

/// Bernstein polynomials along s and t, and their derivatives.
class Bases {
 public:
  Bases(const FaceNet& net, const glm::dvec2& st)
      : n_(static_cast<std::size_t>(std::max(net.degree(0), net.degree(1))) + 1), numbers_(4 * n_) {
    for (int axis = 0; axis < 2; ++axis) {
      bernstein_basis(net.degree(axis), st[axis], &numbers_[first(axis)],
                      &numbers_[first(axis) + n_]);
    }
  }
  [[nodiscard]] double value(int axis, int i) const {
    return numbers_[first(axis) + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] double slope(int axis, int i) const {
    return numbers_[first(axis) + n_ + static_cast<std::size_t>(i)];
  }

 private:
  [[nodiscard]] std::size_t first(int axis) const { return axis == 0 ? 0 : 2 * n_; }

  std::size_t n_;
  mutable Scratch<32> numbers_;
};

}  // namespace

FaceNet::FaceNet(const BezierView& patch, int face) : is_rational_(patch.is_rational()) {
  const auto axes = axes_of(face);
  const auto size = [&](int axis) { return patch.degree[static_cast<std::size_t>(axis)] + 1; };
  const std::array<int, 3> stride = {1, size(0), size(0) * size(1)};
  const auto step = [&](int axis) { return stride[static_cast<std::size_t>(axis)]; };
  const int first = face % 2 == 0 ? 0 : (size(face / 2) - 1) * step(face / 2);
  degree_ = {size(axes[0]) - 1, size(axes[1]) - 1};
  points_.clear();
  for (int j = 0; j <= degree_[1]; ++j) {
    for (int i = 0; i <= degree_[0]; ++i) {
      const auto k = static_cast<std::size_t>(first + i * step(axes[0]) + j * step(axes[1]));
      points_.emplace_back(patch.points[k], is_rational_ ? patch.weights[k] : 1.0);
    }
  }
}

void FaceNet::cut(int axis, double low, double high) {
  const int n = degree(axis) + 1;
  const int n_lines = degree(1 - axis) + 1;
  const auto row = static_cast<std::size_t>(degree_[0] + 1);
  for (int line = 0; line < n_lines; ++line) {
    glm::dvec4* points = points_.data() + static_cast<std::size_t>(line) * (axis == 0 ? row : 1);
    const std::size_t stride = axis == 0 ? 1 : row;
    if (high < 1) {
      keep_below(points, n, stride, high);
    }
    if (low > 0) {
      keep_above(points, n, stride, low / high);
    }
  }
}

FaceNet FaceNet::part(const ParameterRectangle& rectangle) const {
  FaceNet net = *this;
  for (int axis = 0; axis < 2; ++axis) {
    net.cut(axis, rectangle.low[axis], rectangle.high[axis]);
  }
  return net;
}

glm::dvec3 FaceNet::value(const glm::dvec2& st) const {
  const Bases bases(*this, st);
  glm::dvec4 sum(0);
  for (int j = 0; j <= degree_[1]; ++j) {
    for (int i = 0; i <= degree_[0]; ++i) {
      if (const double weight = bases.value(0, i) * bases.value(1, j); weight != 0) {
        sum += weight * at(i, j);
      }
    }
  }
  return glm::dvec3(sum) / sum.w;
}

void FaceNet::evaluate(const glm::dvec2& st, glm::dvec3& value, glm::dmat2x3& derivative) const {
  const Bases bases(*this, st);
  glm::dvec4 sum(0);
  std::array<glm::dvec4, 2> along = {glm::dvec4(0), glm::dvec4(0)};
  for (int j = 0; j <= degree_[1]; ++j) {
    for (int i = 0; i <= degree_[0]; ++i) {
      sum += bases.value(0, i) * bases.value(1, j) * at(i, j);
      along[0] += bases.slope(0, i) * bases.value(1, j) * at(i, j);
      along[1] += bases.value(0, i) * bases.slope(1, j) * at(i, j);
    }
  }
  value = glm::dvec3(sum) / sum.w;
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec4& d = along[static_cast<std::size_t>(axis)];
    derivative[axis] = (glm::dvec3(d) - d.w * value) / sum.w;
  }
}

void FaceNet::positions(std::vector<glm::dvec3>& out) const {
  out.clear();
  for (const glm::dvec4& point : points_) {
    out.push_back(is_rational_ ? glm::dvec3(point) / point.w : glm::dvec3(point));
  }
}

double FaceNet::weight_spread() const {
  const auto [least, most] =
      std::minmax_element(points_.begin(), points_.end(),
                          [](const glm::dvec4& a, const glm::dvec4& b) { return a.w < b.w; });
  return most->w / least->w;
}

void FaceNet::append_slopes(int axis, std::vector<glm::dvec3>& out) const {
  if (is_rational_) {
    append_rational_slopes(axis, out);
    return;
  }
  const int di = axis == 0 ? 1 : 0;
  const int dj = 1 - di;
  for (int j = 0; j + dj <= degree_[1]; ++j) {
    for (int i = 0; i + di <= degree_[0]; ++i) {
      out.push_back(glm::dvec3(at(i + di, j + dj)) - glm::dvec3(at(i, j)));
    }
  }
}

void FaceNet::append_rational_slopes(int axis, std::vector<glm::dvec3>& out) const {
  const int n = degree(axis);
  const int n_lines = degree(1 - axis);
  const auto along = [&](int i, int line) -> const glm::dvec4& {
    return axis == 0 ? at(i, line) : at(line, i);
  };
  const auto position = [&](int i, int line) {
    return glm::dvec3(along(i, line)) / along(i, line).w;
  };
  for (int i = 0; i < n; ++i) {
    for (int k = i + 1; k <= n; ++k) {
      for (int j = 0; j <= n_lines; ++j) {
        for (int l = j; l <= n_lines; ++l) {
          const double forward = along(i, j).w * along(k, l).w;
          const double crossed = along(i, l).w * along(k, j).w;
          out.push_back((forward * (position(k, l) - position(i, j)) +
                         crossed * (position(k, j) - position(i, l))) /
                        (forward + crossed));
        }
      }
    }
  }
}

glm::dvec3 patch_place(int face, const glm::dvec2& st) {
  const auto axes = axes_of(face);
  glm::dvec3 uvw(face % 2);
  uvw[axes[0]] = st.x;
  uvw[axes[1]] = st.y;
  return uvw;
}

}  // namespace espalier
