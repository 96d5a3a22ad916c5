#include "deform/fit/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "deform/fit/chain_place.h"
#include "lattice/build/checks.h"
#include "lattice/build/extrude.h"
#include "lattice/build/frames.h"
#include "lattice/build/offsets.h"
#include "lattice/build/reshape.h"
#include "lattice/build/section.h"
#include "lattice/build/weld.h"
#include "lattice/core/error.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr double kFoldedBack = 0.02;  // of 1 + cosine at a corner
constexpr int kMostLayers = 1000;

using Neighbours = std::map<std::int32_t, std::set<std::int32_t>>;

Neighbours neighbours_of(const Model& path) {
  Neighbours neighbours;
  for (std::size_t line = 0; line < path.lines().n_rows(); ++line) {
    const auto points = path.lines()[line];
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto a = static_cast<std::size_t>(points[i]);
      const auto b = static_cast<std::size_t>(points[i + 1]);
      if (path.points()[a] == path.points()[b]) {
        throw ParameterError(
            fmt::format("{}: sweep: points {} and {} of a line coincide", path.path(), a, b));
      }
      neighbours[points[i]].insert(points[i + 1]);
      neighbours[points[i + 1]].insert(points[i]);
    }
  }
  return neighbours;
}

/// Follows a path from a point, taking its points away.
std::vector<std::int32_t> take_path(std::int32_t from, Neighbours& left) {
  std::vector<std::int32_t> points = {from};
  for (;;) {
    const auto at = left.find(points.back());
    const std::set<std::int32_t> next = at->second;
    left.erase(at);
    const auto ahead = std::find_if(next.begin(), next.end(),
                                    [&](std::int32_t point) { return left.contains(point); });
    if (ahead == next.end()) {
      return points;
    }
    points.push_back(*ahead);
  }
}

/// A polyline with the places of sections on it.
class Axis {
 public:
  Axis(std::span<const glm::dvec3> path, const Polyline& line) : is_closed_(line.is_closed) {
    for (const std::int32_t point : line.points) {
      corners_.push_back(path[static_cast<std::size_t>(point)]);
    }
    for (std::size_t i = 0; i < n_pieces(); ++i) {
      bones_.push_back(unit_vector(end(i) - corners_[i]));
      if (i > 0) {
        check_corner(line.points[i], bones_[i - 1], bones_[i]);
      }
    }
    if (is_closed_) {
      check_corner(line.points[0], bones_.back(), bones_.front());
    }
  }

  [[nodiscard]] bool is_closed() const { return is_closed_; }
  [[nodiscard]] std::size_t n_pieces() const { return corners_.size() - (is_closed_ ? 0 : 1); }
  [[nodiscard]] const glm::dvec3& begin(std::size_t piece) const { return corners_[piece]; }
  [[nodiscard]] const glm::dvec3& end(std::size_t piece) const {
    return corners_[(piece + 1) % corners_.size()];
  }
  [[nodiscard]] double length(std::size_t piece) const {
    return glm::distance(begin(piece), end(piece));
  }
  [[nodiscard]] const glm::dvec3& bone(std::size_t piece) const { return bones_[piece]; }
  /// Normal of the section at the begin or end of a piece.
  [[nodiscard]] glm::dvec3 normal(std::size_t piece, bool is_end) const {
    const std::size_t n = n_pieces();
    const bool is_free = !is_closed_ && (is_end ? piece + 1 == n : piece == 0);
    const std::size_t other = is_end ? (piece + 1) % n : (piece + n - 1) % n;
    return is_free ? bones_[piece] : unit_vector(bones_[piece] + bones_[other]);
  }

  /// Where a point is nearest to the axis: piece + fraction, and how far it is; -1 beyond an end.
  [[nodiscard]] std::pair<double, double> nearest(const glm::dvec3& point) const {
    const ChainPlace found = nearest_place(point, corners_, is_closed_);
    const bool is_beyond = found.beyond > 0;
    return {is_beyond ? -1 : static_cast<double>(found.bone) + found.t, found.distance};
  }

 private:
  static void check_corner(std::int32_t point, const glm::dvec3& from, const glm::dvec3& to) {
    if (glm::dot(from, to) < kFoldedBack - 1) {
      throw ParameterError(fmt::format("sweep: the path runs back on itself at point {}", point));
    }
  }

  bool is_closed_;
  std::vector<glm::dvec3> corners_;
  std::vector<glm::dvec3> bones_;  // #pieces, unit
};

/// Sections along an axis: evenly on each piece, the next piece's first being the last's end.
struct Steps {
  std::vector<int> layers;    // #pieces
  std::vector<double> radii;  // #sections; of a closed axis the last is before the first
};

std::size_t n_sections(const Axis& axis, const std::vector<int>& layers) {
  std::size_t n = axis.is_closed() ? 0 : 1;
  for (const int count : layers) {
    n += static_cast<std::size_t>(count);
  }
  return n;
}

std::vector<int> layers_of(const Axis& axis, double radius, int layers) {
  std::vector<int> result;
  for (std::size_t i = 0; i < axis.n_pieces(); ++i) {
    const double as_wide = std::round(axis.length(i) / radius);
    result.push_back(layers > 0 ? layers
                                : static_cast<int>(std::clamp(as_wide, 1.0, double{kMostLayers})));
  }
  if (axis.is_closed() && n_sections(axis, result) < 3) {
    throw ParameterError("sweep: a closed path needs three sections or more: raise the layers");
  }
  return result;
}

/// What the points of a model say about an axis.
struct Girth {
  std::vector<std::pair<double, double>> places;  // on the axis, and distance from it
  double mean = 0;
};

Girth girth_of(const Axis& axis, std::span<const glm::dvec3> points, double reach) {
  std::vector<std::pair<double, double>> all(points.size());
  parallel_for(points.size(), [&](std::size_t i) { all[i] = axis.nearest(points[i]); });
  Girth girth;
  for (const auto& [place, distance] : all) {
    if (place >= 0 && distance <= reach && distance > 0) {
      girth.places.emplace_back(place, distance);
      girth.mean += distance;
    }
  }
  if (girth.places.empty()) {
    throw ParameterError("sweep: no point of the model lies beside the path; give --radius");
  }
  girth.mean /= static_cast<double>(girth.places.size());
  return girth;
}

/// The largest distance between the sections before and after each, 0 where there is no point.
std::vector<double> largest_distances(const Axis& axis, const Girth& girth,
                                      const std::vector<int>& layers) {
  const std::size_t n = n_sections(axis, layers);
  std::vector<std::size_t> first;
  std::size_t sum = 0;
  for (const int count : layers) {
    first.push_back(sum);
    sum += static_cast<std::size_t>(count);
  }
  std::vector<double> largest(n, 0.0);
  for (const auto& [place, distance] : girth.places) {
    const auto piece = std::min(static_cast<std::size_t>(place), layers.size() - 1);
    const double along = (place - static_cast<double>(piece)) * layers[piece];
    const auto section = static_cast<long>(first[piece]) + static_cast<long>(along);
    // Where the cubic spline along the axis has a point, four sections have a weight.
    for (long k = section - 1; k <= section + 2; ++k) {
      const long at = axis.is_closed() ? (k + static_cast<long>(n)) % static_cast<long>(n) : k;
      if (at >= 0 && at < static_cast<long>(n)) {
        double& radius = largest[static_cast<std::size_t>(at)];
        radius = std::max(radius, distance);
      }
    }
  }
  return largest;
}

/// Values of 0 become those of the nearest that are not, the larger of two.
std::vector<double> without_gaps(const std::vector<double>& values) {
  std::vector<double> result = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t away = 1; result[i] == 0 && away < values.size(); ++away) {
      const double before = i >= away ? values[i - away] : 0;
      const double after = i + away < values.size() ? values[i + away] : 0;
      result[i] = std::max(before, after);
    }
  }
  return result;
}

Steps steps_of(const Axis& axis, std::span<const glm::dvec3> points, const SweepOptions& options) {
  Steps steps;
  if (options.radius > 0) {
    steps.layers = layers_of(axis, options.radius, options.layers);
    steps.radii.assign(n_sections(axis, steps.layers), options.radius);
    return steps;
  }
  const Girth girth = girth_of(axis, points, options.reach);
  steps.layers = layers_of(axis, girth.mean, options.layers);
  steps.radii = without_gaps(largest_distances(axis, girth, steps.layers));
  for (double& radius : steps.radii) {
    radius *= 1 + options.padding;
  }
  return steps;
}

/// Throws where sections in neighbouring halving planes would cross.
void check_bends(const Axis& axis, const Steps& steps) {
  const auto lean = [&](std::size_t piece, bool is_end) {
    const double cosine = glm::dot(axis.bone(piece), axis.normal(piece, is_end));
    return std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  };
  std::size_t section = 0;
  for (std::size_t i = 0; i < axis.n_pieces(); ++i) {
    const double first = steps.radii[section];
    section += static_cast<std::size_t>(steps.layers[i]);
    const double last = steps.radii[section % steps.radii.size()];
    const double needed = first * lean(i, false) + last * lean(i, true);
    if (needed >= axis.length(i)) {
      throw ParameterError(fmt::format(
          "sweep: piece {} of the path, of length {:.4g}, bends too sharply for its radius: it "
          "needs more than {:.4g}; use a smaller radius or longer pieces",
          i, axis.length(i), needed));
    }
  }
}

/// The two directions across the path at the begin of every piece, and after the last; a turn
/// about the path that is left at the end of a closed one goes to `turn`, in degrees.
std::vector<std::array<glm::dvec3, 2>> frames_of(const Axis& axis, double& turn) {
  std::vector<std::array<glm::dvec3, 2>> frames = {plane_across(axis.bone(0))};
  const std::size_t n = axis.n_pieces();
  for (std::size_t i = 1; i < n + (axis.is_closed() ? 1 : 0); ++i) {
    const auto [right, up] = frames.back();
    frames.push_back({carried(right, axis.bone(i - 1), axis.bone(i % n)),
                      carried(up, axis.bone(i - 1), axis.bone(i % n))});
  }
  turn = 0;
  if (axis.is_closed()) {
    const glm::dvec3 arrived = frames.back()[0];
    turn =
        -glm::degrees(std::atan2(glm::dot(arrived, frames[0][1]), glm::dot(arrived, frames[0][0])));
  }
  return frames;
}

CellMesh sweep_axis(const Axis& axis, const Section& section, const Steps& steps) {
  check_bends(axis, steps);
  double turn = 0;
  const auto frames = frames_of(axis, turn);
  const std::size_t n_all = steps.radii.size();
  std::vector<glm::dvec3> points;
  std::size_t at = 0;
  for (std::size_t piece = 0; piece < axis.n_pieces(); ++piece) {
    const int layers = steps.layers[piece];
    const bool is_last = !axis.is_closed() && piece + 1 == axis.n_pieces();
    for (int layer = 0; layer < layers + (is_last ? 1 : 0); ++layer, ++at) {
      const double t = static_cast<double>(layer) / layers;
      const glm::dmat3 turned =
          rotation(axis.bone(piece), turn * static_cast<double>(at) / static_cast<double>(n_all));
      const glm::dvec3 centre = axis.begin(piece) * (1 - t) + axis.end(piece) * t;
      for (const glm::dvec3& point : section.points) {
        const glm::dvec3 offset =
            steps.radii[at] * (turned * (frames[piece][0] * point.x + frames[piece][1] * point.y));
        points.push_back(centre +
                         slid_onto_plane(offset, axis.bone(piece), axis.normal(piece, false)) *
                             (1 - t) +
                         slid_onto_plane(offset, axis.bone(piece), axis.normal(piece, true)) * t);
      }
    }
  }
  return stack(std::move(points), section.faces, n_all, axis.is_closed());
}

void check_options(const SweepOptions& options, bool has_points) {
  if (options.radius != 0 || !has_points) {
    check_size("sweep", "the radius", options.radius);
  }
  if (!(options.padding >= 0 && options.padding <= 100)) {
    throw ParameterError("sweep: the padding must be 0 to 100 times the radius");
  }
  if (!(options.reach > 0)) {
    throw ParameterError("sweep: the reach must be positive");
  }
  check_count("sweep", "core", options.core, 1, 250);
  check_count("sweep", "rings", options.rings, 1, 250);
  check_count("sweep", "layers", options.layers, 0, kMostLayers);
}

}  // namespace

std::vector<Polyline> polylines_of(const Model& path) {
  Neighbours left = neighbours_of(path);
  if (left.empty()) {
    throw ParameterError(path.path() +
                         ": sweep: has no lines: a path is an OBJ file with lines "
                         "like 'l 1 2 3'");
  }
  std::vector<std::int32_t> ends;
  for (const auto& [point, next] : left) {
    if (next.size() > 2) {
      throw ParameterError(fmt::format(
          "{}: sweep: {} lines meet at point {}, at most two can: sweep the branches one by one "
          "and attach them",
          path.path(), next.size(), point));
    }
    if (next.size() == 1) {
      ends.push_back(point);
    }
  }
  std::vector<Polyline> polylines;
  for (const std::int32_t end : ends) {
    if (left.contains(end)) {
      polylines.push_back({take_path(end, left), false});
    }
  }
  while (!left.empty()) {
    polylines.push_back({take_path(left.begin()->first, left), true});
  }
  return polylines;
}

CellMesh sweep(std::span<const glm::dvec3> path, std::span<const Polyline> polylines,
               std::span<const glm::dvec3> points, const SweepOptions& options) {
  check_options(options, !points.empty());
  const Section section = o_grid_section(1, options.core, options.rings);
  CellMesh all;
  for (const Polyline& line : polylines) {
    const Axis axis(path, line);
    CellMesh part = sweep_axis(axis, section, steps_of(axis, points, options));
    all = all.points.empty() ? std::move(part) : side_by_side(all, part);
  }
  return all;
}

}  // namespace espalier
