// Inverting Bézier hexahedra: damped Newton steps, and a search by subdivision where they fail.

#include "lattice/volume/bezier_inverse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "lattice/volume/bernstein_lines.h"
#include "lattice/volume/bezier_evaluator.h"
#include "lattice/volume/patch_frame.h"

namespace espalier {
namespace {

constexpr int kMostSteps = 30;
constexpr int kMostHalvings = 6;
constexpr double kSmallStep = 1e-8;  // after such a step only round-off is left
constexpr double kRoam = 0.25;       // how far Newton's method may leave the cube on its way

/// Solves J s = r by Cramer's rule; nothing where J is singular.
std::optional<glm::dvec3> solve(const glm::dmat3& J, const glm::dvec3& r) {
  const glm::dvec3 across = glm::cross(J[1], J[2]);
  const double det = glm::dot(J[0], across);
  const double size = glm::dot(J[0], J[0]) * glm::dot(J[1], J[1]) * glm::dot(J[2], J[2]);
  if (!(det * det > 1e-28 * size)) {
    return std::nullopt;
  }
  const glm::dvec3 step(glm::dot(r, across), glm::dot(r, glm::cross(J[2], J[0])),
                        glm::dot(r, glm::cross(J[0], J[1])));
  return step / det;
}

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

/// The cube grown by a margin; a pyramid ends at its apex.
struct Range {
  Range(bool is_pyramid, double margin) : low(-margin), high(1 + margin) {
    if (is_pyramid) {
      high.z = 1;
    }
  }
  [[nodiscard]] glm::dvec3 clamped(const glm::dvec3& uvw) const {
    return glm::clamp(uvw, low, high);
  }
  /// How far outside a place is; not positive inside.
  [[nodiscard]] double overshoot(const glm::dvec3& uvw) const {
    return std::max(largest(low - uvw), largest(uvw - high));
  }
  glm::dvec3 low;
  glm::dvec3 high;
};

/// One run of Newton's method.
template <class Evaluator>
class Newton {
 public:
  Newton(const Evaluator& map, const glm::dvec3& x, double margin)
      : map_(map),
        x_(x),
        range_(map.is_pyramid(), margin),
        roam_(map.is_pyramid(), margin + kRoam) {}

  [[nodiscard]] Preimage run(const glm::dvec3& start) {
    State at = state(roam_.clamped(start));
    bool is_converged = false;
    int n_steps = 0;
    while (n_steps < kMostSteps) {
      const auto step = step_from(at);
      if (!step) {
        break;
      }
      const double length = largest(glm::abs(*step));
      if (range_.overshoot(at.uvw) > std::max(2 * length, kSmallStep)) {
        is_converged = true;  // to a place outside
        break;
      }
      ++n_steps;
      if (length < kSmallStep || at.error <= round_off(at)) {
        at.uvw = range_.clamped(at.uvw + *step);
        return {at.uvw, glm::distance(map_.value(at.uvw), x_), true, n_steps};
      }
      const State next = damped_step(at, *step);
      if (!(next.error < at.error)) {
        break;
      }
      at = next;
    }
    const glm::dvec3 uvw = range_.clamped(at.uvw);
    return {uvw, glm::distance(map_.value(uvw), x_), is_converged, n_steps};
  }

 private:
  struct State {
    glm::dvec3 uvw;
    glm::dvec3 residual;
    glm::dmat3 J;
    double error;
  };

  [[nodiscard]] State state(const glm::dvec3& uvw) const {
    State at;
    at.uvw = uvw;
    glm::dvec3 value;
    map_.evaluate(uvw, value, at.J);
    at.residual = x_ - value;
    at.error = glm::length(at.residual);
    return at;
  }

  /// Of an evaluation near x.
  [[nodiscard]] double round_off(const State& at) const {
    const glm::dvec3 size =
        glm::abs(x_) + glm::abs(at.J[0]) + glm::abs(at.J[1]) + glm::abs(at.J[2]);
    return std::numeric_limits<double>::epsilon() * largest(size);
  }

  [[nodiscard]] std::optional<glm::dvec3> step_from(const State& at) const {
    auto step = solve(at.J, at.residual);
    if (step && map_.is_pyramid()) {
      // Linear in (1 − w) u, (1 − w) v and w, as the map nearly is: so divided by the next 1 − w.
      const double factor = std::max(1 - at.uvw.z - step->z, 1e-12);
      step->x /= factor;
      step->y /= factor;
    }
    return step;
  }

  /// The step, halved until the residual falls; given up at the edge of where it may roam.
  [[nodiscard]] State damped_step(const State& at, const glm::dvec3& step) const {
    const glm::dvec3 target = roam_.clamped(at.uvw + step);
    State next = state(target);
    if (target == at.uvw) {
      return next;
    }
    double fraction = 1;
    for (int i = 0; i < kMostHalvings && !(next.error < at.error); ++i) {
      fraction /= 2;
      next = state(at.uvw + fraction * (target - at.uvw));
    }
    return next;
  }

  const Evaluator& map_;
  const glm::dvec3& x_;
  Range range_;
  Range roam_;
};

Preimage newton(const BezierView& patch, const glm::dvec3& x, const glm::dvec3& start,
                double margin) {
  return with_evaluator(patch, [&](const auto& map) { return Newton(map, x, margin).run(start); });
}

/// Part of a patch, and the parameters that it covers.
struct Part {
  std::vector<glm::dvec3> points;
  glm::dvec3 low;
  glm::dvec3 high;
};

/// Splits a part across an axis.
void halve(const std::array<int, 3>& degree, const Part& whole, int axis, Part& lower,
           Part& upper) {
  const std::array<std::size_t, 3> n = {static_cast<std::size_t>(degree[0] + 1),
                                        static_cast<std::size_t>(degree[1] + 1),
                                        static_cast<std::size_t>(degree[2] + 1)};
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? n[0] : n[0] * n[1];
  const std::size_t length = n[static_cast<std::size_t>(axis)];
  lower = whole;
  upper = whole;
  for (std::size_t first = 0; first < whole.points.size(); first += length * stride) {
    for (std::size_t offset = first; offset < first + stride; ++offset) {
      for (std::size_t left = length - 1; left > 0; --left) {
        for (std::size_t i = 0; i < left; ++i) {
          glm::dvec3& point = upper.points[offset + i * stride];
          point = 0.5 * (point + upper.points[offset + (i + 1) * stride]);
        }
        lower.points[offset + (length - left) * stride] = upper.points[offset];
      }
    }
  }
  lower.high[axis] = upper.low[axis] = 0.5 * (whole.low[axis] + whole.high[axis]);
}

/// A depth-first search over the parts that may hold x, up to the first preimage within the
/// tolerance.
class Search {
 public:
  Search(const BezierView& patch, const glm::dvec3& x, double tolerance)
      : patch_(patch), x_(x), tolerance_(tolerance), parts_(2 * kDeepest + 1) {}

  [[nodiscard]] std::optional<Preimage> run() {
    parts_[0] = {{patch_.points.begin(), patch_.points.end()}, glm::dvec3(0), glm::dvec3(1)};
    visit(parts_[0], 0);
    std::optional<Preimage> result = best_;
    if (result) {
      result->is_converged = is_certain_;
    }
    return result;
  }

 private:
  static constexpr std::size_t kDeepest = 27;  // halvings, nine an axis
  static constexpr int kMostParts = 20000;

  /// Whether x was found in the part.
  bool visit(const Part& part, std::size_t depth) {
    if (!may_hold(part)) {
      return false;
    }
    if (depth % 3 == 0 && try_newton(part, depth)) {
      return true;
    }
    if (depth == kDeepest) {
      return false;
    }
    if (++n_parts_ > kMostParts) {
      is_certain_ = false;
      return false;
    }
    Part& lower = parts_[2 * depth + 1];
    Part& upper = parts_[2 * depth + 2];
    halve(patch_.degree, part, static_cast<int>(depth % 3), lower, upper);
    return visit(lower, depth + 1) || visit(upper, depth + 1);
  }

  /// Whether the hull's box holds x, and the hull's box in the part's own axes.
  [[nodiscard]] bool may_hold(const Part& part) const {
    const Box box = box_of(part.points).grown(tolerance_ + round_off_of(x_));
    if (!box.contains(x_)) {
      return false;
    }
    const glm::dmat3 axes = affine_map(view(part)).axes;
    // The rows of the inverse, scaled by the determinant.
    const std::array<glm::dvec3, 3> normals = {
        glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]), glm::cross(axes[0], axes[1])};
    return std::all_of(normals.begin(), normals.end(), [&](const glm::dvec3& normal) {
      double least = std::numeric_limits<double>::infinity();
      double most = -least;
      for (const glm::dvec3& point : part.points) {
        const double along = glm::dot(normal, point - x_);
        least = std::min(least, along);
        most = std::max(most, along);
      }
      const double slack = (tolerance_ + round_off_of(x_)) * glm::length(normal);
      return least <= slack && most >= -slack;
    });
  }

  [[nodiscard]] static double round_off_of(const glm::dvec3& x) {
    return 16 * std::numeric_limits<double>::epsilon() * largest(glm::abs(x));
  }

  [[nodiscard]] BezierView view(const Part& part) const {
    return {patch_.degree, part.points, patch_.is_pyramid && part.high.z == 1};
  }

  bool try_newton(const Part& part, std::size_t depth) {
    const glm::dvec3 within =
        glm::clamp(PatchFrame(view(part)).guess(x_), glm::dvec3(0), glm::dvec3(1));
    const Preimage found = newton(patch_, x_, part.low + within * (part.high - part.low), 0);
    if (!std::isfinite(found.residual)) {
      return false;
    }
    if (!best_ || found.residual < best_->residual) {
      best_ = found;
    }
    is_certain_ = is_certain_ && (found.is_converged || depth < kDeepest);
    return best_->residual <= tolerance_;
  }

  const BezierView& patch_;
  const glm::dvec3& x_;
  double tolerance_;
  std::vector<Part> parts_;  // two a depth
  std::optional<Preimage> best_;
  bool is_certain_ = true;
  int n_parts_ = 0;
};

/// A rational patch N / W takes the value x where the polynomial N − x W takes the value 0.
BezierPatch relative_to(const BezierView& patch, const glm::dvec3& x) {
  BezierPatch result{patch.degree, {patch.points.begin(), patch.points.end()}};
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    result.points[i] -= patch.weights[i] * x;
  }
  return result;
}

}  // namespace

std::optional<Preimage> invert(const BezierView& patch, const glm::dvec3& x, double margin) {
  return invert_from(patch, x, PatchFrame(patch).guess(x), margin);
}

std::optional<Preimage> invert_from(const BezierView& patch, const glm::dvec3& x,
                                    const glm::dvec3& start, double margin) {
  if (patch.is_rational()) {
    auto found = invert_from(relative_to(patch, x), glm::dvec3(0), start, margin);
    if (found) {
      found->residual = glm::distance(patch.value(found->uvw), x);
    }
    return found;
  }
  const Preimage found = newton(patch, x, start, margin);
  return std::isfinite(found.residual) ? std::optional(found) : std::nullopt;
}

std::optional<Preimage> invert_by_subdivision(const BezierView& patch, const glm::dvec3& x,
                                              double tolerance) {
  if (patch.is_rational()) {
    const double least = *std::min_element(patch.weights.begin(), patch.weights.end());
    auto found = invert_by_subdivision(relative_to(patch, x), glm::dvec3(0), least * tolerance);
    if (found) {
      found->residual = glm::distance(patch.value(found->uvw), x);
    }
    return found;
  }
  return Search(patch, x, tolerance).run();
}

}  // namespace espalier
