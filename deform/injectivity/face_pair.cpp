// Two boundary faces, told apart or not.
//
// [APS98] L.-E. Andersson, T. J. Peters, N. F. Stewart, "Selfintersection of composite curves and
// surfaces", 1998. [VM94] P. Volino, N. Magnenat-Thalmann, "Efficient self-collision detection on
// smoothly discretized surface animations using geometrical shape regularity", 1994.

#include "deform/injectivity/face_pair.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "lattice/core/box.h"

namespace espalier {
namespace {

constexpr double kFinestPart = 0x1p-22;  // of a face's side
constexpr int kMostTurns = 12;           // of a direction that slopes are seen from
constexpr int kMostCornerTurns = 30;     // of a plane between the parts at a corner
constexpr int kNewtonSteps = 20;
constexpr double kInside = 1e-6;    // how far from a face's edge a crossing must be
constexpr double kDistinct = 1e-6;  // how far apart at rest, of the volume's size
constexpr std::size_t kCrossingEvery = 16;

glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

std::pair<double, double> extent(std::span<const glm::dvec3> points, const glm::dvec3& axis) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const glm::dvec3& p : points) {
    const double along = glm::dot(axis, p);
    least = std::min(least, along);
    most = std::max(most, along);
  }
  return {least, most};
}

double sum_of_sizes(const glm::dvec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

glm::dvec3 middle(std::span<const glm::dvec3> points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : points) {
    sum += p;
  }
  return sum / static_cast<double>(points.size());
}

/// A normal of a plane that all vectors lie above, if they lie within a narrow wedge of space: the
/// planes through two of them that have none below are the sides of the cone of all such normals.
/// 0 if there are none. O(#vectors³) at most.
glm::dvec3 normal_below(std::span<const glm::dvec3> vectors) {
  constexpr double kRounding = 1e-12;
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    for (std::size_t j = 0; j < vectors.size(); ++j) {
      const glm::dvec3 normal = unit(glm::cross(vectors[i], vectors[j]));
      const auto is_above = [&](const glm::dvec3& v) {
        return glm::dot(v, normal) >= -kRounding * glm::length(v);
      };
      if (std::ranges::all_of(vectors, is_above)) {
        sum += normal;
      }
    }
  }
  return sum;
}

bool contains(const ParameterRectangle& rectangle, const glm::dvec2& corner) {
  const auto is_end = [&](int axis) {
    return corner[axis] == rectangle.low[axis] || corner[axis] == rectangle.high[axis];
  };
  return is_end(0) && is_end(1);
}

bool is_finest(const ParameterRectangle& rectangle) {
  const glm::dvec2 size = rectangle.high - rectangle.low;
  return std::max(size.x, size.y) <= kFinestPart;
}

}  // namespace

FacePairTester::FacePairTester(const BoundaryMesh& mesh, double tolerance)
    : mesh_(mesh), tolerance_(tolerance) {}

FacePairTester::Part FacePairTester::part_of(std::size_t face, const ParameterRectangle& where) {
  Part part{face, where, {}, {}};
  const FaceNet net = mesh_.pose[face].part(where);
  net.positions(part.points);
  for (int axis = 0; axis < 2; ++axis) {
    room_.clear();
    net.append_slopes(axis, room_);
    for (const glm::dvec3& slope : room_) {
      part.lengths[axis] = std::max(part.lengths[axis], glm::length(slope));
    }
    part.lengths[axis] *= net.degree(axis);
  }
  return part;
}

std::array<FacePairTester::Part, 2> FacePairTester::halves(const Part& part) {
  const glm::dvec2 size = part.where.high - part.where.low;
  int axis = part.lengths.x >= part.lengths.y ? 0 : 1;
  if (size[axis] <= kFinestPart) {
    axis = 1 - axis;
  }
  ParameterRectangle low = part.where;
  ParameterRectangle high = part.where;
  low.high[axis] = high.low[axis] = 0.5 * (part.where.low[axis] + part.where.high[axis]);
  return {part_of(part.face, low), part_of(part.face, high)};
}

bool FacePairTester::have_separate_hulls(const Part& a, const Part& b) const {
  const auto is_between = [&](const glm::dvec3& axis) {
    const auto [least_a, most_a] = extent(a.points, axis);
    const auto [least_b, most_b] = extent(b.points, axis);
    const double slack = 2 * tolerance_ * sum_of_sizes(axis);
    return least_a - most_b > slack || least_b - most_a > slack;
  };
  if (is_between({1, 0, 0}) || is_between({0, 1, 0}) || is_between({0, 0, 1})) {
    return true;
  }
  const auto diagonals = [&](const Part& part) {
    const auto n = static_cast<std::size_t>(mesh_.pose[part.face].degree(0));
    const auto& p = part.points;
    return std::array{p.back() - p.front(), p[p.size() - 1 - n] - p[n]};
  };
  const auto of_a = diagonals(a);
  const auto of_b = diagonals(b);
  const glm::dvec3 apart = middle(a.points) - middle(b.points);
  for (const glm::dvec3& axis : {apart, glm::cross(of_a[0], of_a[1]), glm::cross(of_b[0], of_b[1]),
                                 of_a[0], of_a[1], of_b[0], of_b[1], of_a[0] + of_a[1],
                                 of_a[0] - of_a[1], of_b[0] + of_b[1], of_b[0] - of_b[1]}) {
    if (is_between(unit(axis))) {
      return true;
    }
  }
  return false;
}

/// Whether one d has (a × b) · d > 0 for all slopes a across and b along; looked for by adding to d
/// the normal that it is worst for.
bool FacePairTester::have_separate_slopes() {
  glm::dvec3 direction(0);
  const auto& [across, along] = slopes_;
  const std::size_t step_across = std::max<std::size_t>(across.size() / 4, 1);
  const std::size_t step_along = std::max<std::size_t>(along.size() / 4, 1);
  for (std::size_t i = 0; i < across.size(); i += step_across) {
    for (std::size_t j = 0; j < along.size(); j += step_along) {
      direction += unit(glm::cross(across[i], along[j]));
    }
  }
  for (int turn = 0; turn < kMostTurns; ++turn) {
    direction = unit(direction);
    double worst = 0;
    glm::dvec3 missed(0);
    for (const glm::dvec3& a : across) {
      const double size = glm::length(a);
      for (const glm::dvec3& b : along) {
        const glm::dvec3 normal = glm::cross(a, b);
        const double other = glm::length(b);
        const double slack = 4 * tolerance_ * (size + other) + 1e-15 * size * other;
        const double height = glm::dot(normal, direction) - slack;
        if (!(height > 0)) {
          const double length = glm::length(normal);
          if (!(length > slack)) {
            return false;  // slopes of one direction, or none
          }
          if (height / length <= worst) {
            worst = height / length;
            missed = normal / length;
          }
        }
      }
    }
    if (missed == glm::dvec3(0)) {
      return true;
    }
    direction += (0.1 - worst) * missed;
  }
  return false;
}

void FacePairTester::append_slopes(std::size_t face, const ParameterRectangle& where,
                                   const glm::dvec2& signs, int across) {
  const FaceNet net = mesh_.pose[face].part(where);
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<glm::dvec3>& out = slopes_[axis == across ? 0 : 1];
    const std::size_t first = out.size();
    net.append_slopes(axis, out);
    if (signs[axis] < 0) {
      for (std::size_t i = first; i < out.size(); ++i) {
        out[i] = -out[i];
      }
    }
  }
}

bool FacePairTester::is_embedded(std::size_t face, const ParameterRectangle& where) {
  slopes_[0].clear();
  slopes_[1].clear();
  append_slopes(face, where, {1, 1}, 0);
  return have_separate_slopes();
}

/// The square: from part a's far side to the seam, and on to part b's.
bool FacePairTester::are_joined(const Part& a, const SeamUse& of_a, const Part& b,
                                const SeamUse& of_b) {
  double low = 1;
  double high = 0;
  for (const auto& [part, use] : {std::pair(&a, &of_a), std::pair(&b, &of_b)}) {
    for (const double t : {part->where.low[1 - use->across], part->where.high[1 - use->across]}) {
      const double y = (t - use->begin) / (use->end - use->begin);
      low = std::min(low, y);
      high = std::max(high, y);
    }
  }
  constexpr double kRounding = 1e-12;
  if (low < -kRounding || high > 1 + kRounding) {
    return false;  // reaches beyond the seam
  }
  slopes_[0].clear();
  slopes_[1].clear();
  for (const auto& [part, use, is_second] :
       {std::tuple(&a, &of_a, false), std::tuple(&b, &of_b, true)}) {
    ParameterRectangle where = part->where;
    const double from = use->begin + low * (use->end - use->begin);
    const double to = use->begin + high * (use->end - use->begin);
    where.low[1 - use->across] = std::clamp(std::min(from, to), 0.0, 1.0);
    where.high[1 - use->across] = std::clamp(std::max(from, to), 0.0, 1.0);
    (use->side == 0 ? where.low : where.high)[use->across] = use->side;
    glm::dvec2 signs;
    signs[use->across] = (use->side == 1) != is_second ? 1 : -1;
    signs[1 - use->across] = use->begin < use->end ? 1 : -1;
    append_slopes(part->face, where, signs, use->across);
  }
  return have_separate_slopes();
}

/// Looks for a plane as a perceptron does: it turns towards the point that is worst.
bool FacePairTester::are_divided_at(const Part& a, const CornerUse& of_a, const Part& b,
                                    const CornerUse& of_b) {
  if (!contains(a.where, of_a.place) || !contains(b.where, of_b.place)) {
    return false;
  }
  room_.clear();
  for (const auto& [part, use, sign] : {std::tuple(&a, &of_a, 1.0), std::tuple(&b, &of_b, -1.0)}) {
    const auto n = static_cast<std::size_t>(mesh_.pose[part->face].degree(0));
    const std::size_t i = use->place.x == part->where.low.x ? 0 : n;
    const std::size_t row = use->place.y == part->where.low.y ? 0 : part->points.size() - n - 1;
    for (std::size_t k = 0; k < part->points.size(); ++k) {
      if (k != row + i) {
        room_.push_back(sign * (part->points[k] - part->points[row + i]));
      }
    }
  }
  glm::dvec3 normal(0);
  for (const glm::dvec3& v : room_) {
    normal += unit(v);
  }
  for (int turn = 0; turn < kMostCornerTurns; ++turn) {
    const glm::dvec3 missed = turn_above(normal);
    if (missed == glm::dvec3(0)) {
      return true;
    }
    normal += missed;
  }
  normal = normal_below(room_);
  return turn_above(normal) == glm::dvec3(0);
}

/// How a normal turns towards the vector of room_ that lies farthest below its plane; 0 if all lie
/// above it. The normal gets length 1.
glm::dvec3 FacePairTester::turn_above(glm::dvec3& normal) const {
  normal = unit(normal);
  const double slack = 2 * tolerance_ * sum_of_sizes(normal);
  double worst = std::numeric_limits<double>::infinity();
  glm::dvec3 missed(0);
  for (const glm::dvec3& v : room_) {
    const double height = glm::dot(v, normal) - slack;
    if (const double length = glm::length(v); !(height > 0) && height < worst * length) {
      worst = height / length;
      missed = v / length;
    }
  }
  return missed == glm::dvec3(0) ? missed : (0.1 - worst) * missed;
}

/// The seams: of an edge across each parameter, along all of it.
bool FacePairTester::are_divided_along(const Part& a, const std::array<SeamUse, 2>& of_a,
                                       const Part& b, const std::array<SeamUse, 2>& of_b) const {
  const FaceNet& net = mesh_.pose[a.face];
  const auto place = [&](int s, int t) { return net.value({s, t}); };
  const int s = of_a[0].side;
  const int t = of_a[1].side;
  const glm::dvec3 corner = place(s, t);
  const glm::dvec3 normal = unit(glm::cross(place(1 - s, t) - corner, place(s, 1 - t) - corner));
  const double slack = 2 * tolerance_ * sum_of_sizes(normal);
  std::array<double, 2> least;
  std::array<double, 2> most;
  for (const auto& [which, part, seams] : {std::tuple(0U, &a, &of_a), std::tuple(1U, &b, &of_b)}) {
    const auto n = static_cast<std::size_t>(mesh_.pose[part->face].degree(0)) + 1;
    const std::size_t m = part->points.size() / n;
    const std::size_t edge_i = (*seams)[0].side == 0 ? 0 : n - 1;
    const std::size_t edge_j = (*seams)[1].side == 0 ? 0 : m - 1;
    least[which] = std::numeric_limits<double>::infinity();
    most[which] = -least[which];
    for (std::size_t k = 0; k < part->points.size(); ++k) {
      const double height = glm::dot(part->points[k] - corner, normal);
      if (k % n != edge_i && k / n != edge_j) {
        least[which] = std::min(least[which], height);
        most[which] = std::max(most[which], height);
      } else if (!(std::abs(height) <= slack)) {
        return false;
      }
    }
  }
  return (least[0] > slack && most[1] < -slack) || (most[0] < -slack && least[1] > slack);
}

bool FacePairTester::share_two_straight_edges(const Part& a, const Part& b) const {
  const auto is_whole = [](const Part& part) {
    return part.where.low == glm::dvec2(0) && part.where.high == glm::dvec2(1);
  };
  if (a.face == b.face || !is_whole(a) || !is_whole(b)) {
    return false;
  }
  std::vector<std::pair<SeamUse, SeamUse>> shared;
  for (const SeamUse& of_a : mesh_.seams[a.face]) {
    for (const SeamUse& of_b : mesh_.seams[b.face]) {
      if (of_a.seam == of_b.seam && std::abs(of_a.end - of_a.begin) == 1 &&
          std::abs(of_b.end - of_b.begin) == 1) {
        shared.emplace_back(of_a, of_b);
      }
    }
  }
  for (const auto& [a0, b0] : shared) {
    for (const auto& [a1, b1] : shared) {
      if (a0.across == 0 && a1.across == 1 && b0.across != b1.across &&
          are_divided_along(a, {a0, a1}, b,
                            b0.across == 0 ? std::array{b0, b1} : std::array{b1, b0})) {
        return true;
      }
    }
  }
  return false;
}

bool FacePairTester::is_apart(const Part& a, const Part& b, bool is_one) {
  if (!is_one && have_separate_hulls(a, b)) {
    return true;
  }
  if (a.face == b.face && is_embedded(a.face, {glm::min(a.where.low, b.where.low),
                                               glm::max(a.where.high, b.where.high)})) {
    return true;
  }
  if (is_one) {
    return false;
  }
  for (const SeamUse& of_a : mesh_.seams[a.face]) {
    for (const SeamUse& of_b : mesh_.seams[b.face]) {
      const bool is_edge_itself =
          a.face == b.face && of_a.across == of_b.across && of_a.side == of_b.side;
      if (of_a.seam == of_b.seam && !is_edge_itself && are_joined(a, of_a, b, of_b)) {
        return true;
      }
    }
  }
  for (const CornerUse& of_a : mesh_.corners[a.face]) {
    for (const CornerUse& of_b : mesh_.corners[b.face]) {
      if (of_a.corner == of_b.corner && are_divided_at(a, of_a, b, of_b)) {
        return true;
      }
    }
  }
  return share_two_straight_edges(a, b);
}

bool FacePairTester::meet_at_leaf(std::size_t a, std::size_t b) const {
  if (!mesh_.faces[a].is_leaf && !mesh_.faces[b].is_leaf) {
    return false;
  }
  for (const CornerUse& of_a : mesh_.corners[a]) {
    for (const CornerUse& of_b : mesh_.corners[b]) {
      if (of_a.corner == of_b.corner) {
        return true;
      }
    }
  }
  return false;
}

/// Newton's smallest steps on A(s, t) = B(u, v), three equations for four parameters.
std::optional<std::array<glm::dvec2, 2>> FacePairTester::find_crossing(const Part& a,
                                                                       const Part& b) const {
  if (meet_at_leaf(a.face, b.face)) {
    return std::nullopt;  // they may overlap by the leaf's error
  }
  std::array<glm::dvec2, 2> at = {0.5 * (a.where.low + a.where.high),
                                  0.5 * (b.where.low + b.where.high)};
  for (int step = 0; step < kNewtonSteps; ++step) {
    std::array<glm::dvec3, 2> values;
    std::array<glm::dmat2x3, 2> slopes;
    mesh_.pose[a.face].evaluate(at[0], values[0], slopes[0]);
    mesh_.pose[b.face].evaluate(at[1], values[1], slopes[1]);
    const glm::dvec3 miss = values[0] - values[1];
    if (glm::length(miss) <= 8 * tolerance_) {
      if (is_real_crossing(a.face, at[0], b.face, at[1])) {
        return at;
      }
      return std::nullopt;
    }
    glm::dmat3 square(0);
    for (const glm::dmat2x3& slope : slopes) {
      square += slope * glm::transpose(slope);
    }
    const double determinant = glm::determinant(square);
    const double scale = square[0][0] + square[1][1] + square[2][2];
    if (!(std::abs(determinant) > 1e-12 * scale * scale * scale)) {
      return std::nullopt;  // one tangent plane: no crossing that can be told
    }
    const glm::dvec3 pull = glm::inverse(square) * miss;
    at[0] -= glm::transpose(slopes[0]) * pull;
    at[1] += glm::transpose(slopes[1]) * pull;
    for (glm::dvec2& place : at) {
      place = glm::clamp(place, 0.0, 1.0);
    }
  }
  return std::nullopt;
}

/// Whether the faces cross near these places whatever rounding did to them, by Kantorovich's
/// condition: the residual r, the inverse β and the curvature K of the equations have
/// β² K r < 1/2, and the crossing is within 2 β r of here, inside both faces.
bool FacePairTester::is_real_crossing(std::size_t a, const glm::dvec2& at_a, std::size_t b,
                                      const glm::dvec2& at_b) const {
  for (const glm::dvec2& place : {at_a, at_b}) {
    if (glm::any(glm::lessThan(place, glm::dvec2(kInside))) ||
        glm::any(glm::greaterThan(place, glm::dvec2(1 - kInside)))) {
      return false;
    }
  }
  if (glm::distance(mesh_.rest[a].value(at_a), mesh_.rest[b].value(at_b)) <=
      kDistinct * mesh_.rest_size) {
    return false;
  }
  glm::dmat3 square(0);
  double curvature = 0;
  for (const auto& [face, place] : {std::pair(a, at_a), std::pair(b, at_b)}) {
    glm::dvec3 value;
    glm::dmat2x3 slope;
    mesh_.pose[face].evaluate(place, value, slope);
    square += slope * glm::transpose(slope);
    std::vector<glm::dvec3> points;
    mesh_.pose[face].positions(points);
    const double degree = std::max(mesh_.pose[face].degree(0), mesh_.pose[face].degree(1));
    const double spread = mesh_.pose[face].weight_spread();
    curvature += 16 * degree * degree * box_of(points).radius() * std::pow(spread, 4);
  }
  const glm::dmat3 inverse = glm::inverse(square);
  const double beta = std::sqrt(std::max(inverse[0][0] + inverse[1][1] + inverse[2][2], 0.0));
  const double residual = 16 * tolerance_;
  return beta * beta * curvature * residual < 0.5 && 2 * beta * residual < kInside;
}

FacePairResult FacePairTester::test(std::size_t a, std::size_t b, std::size_t most_boxes) {
  struct Pair {
    Part a;
    Part b;
    bool is_one;
  };
  std::vector<Pair> open;
  open.push_back({part_of(a, {}), part_of(b, {}), a == b});
  FacePairResult result;
  std::size_t n_failed = 0;
  bool is_open = false;
  for (; !open.empty(); ++result.n_boxes) {
    const Pair pair = std::move(open.back());
    open.pop_back();
    if (is_apart(pair.a, pair.b, pair.is_one)) {
      continue;
    }
    if (!pair.is_one && ++n_failed % kCrossingEvery == 0) {
      result.crossing = find_crossing(pair.a, pair.b);
    }
    if (result.crossing || result.n_boxes >= most_boxes) {
      return result;
    }
    if (is_finest(pair.a.where) || is_finest(pair.b.where)) {
      is_open = true;  // but the faces may cross elsewhere
      continue;
    }
    if (pair.is_one) {
      auto [low, high] = halves(pair.a);
      open.push_back({low, low, true});
      open.push_back({high, high, true});
      open.push_back({std::move(low), std::move(high), false});
    } else if (glm::length(pair.a.lengths) >= glm::length(pair.b.lengths)) {
      for (Part& half : halves(pair.a)) {
        open.push_back({std::move(half), pair.b, false});
      }
    } else {
      for (Part& half : halves(pair.b)) {
        open.push_back({pair.a, std::move(half), false});
      }
    }
  }
  result.is_apart = !is_open;
  return result;
}

}  // namespace espalier
