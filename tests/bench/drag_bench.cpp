// How fast a drag is, beside copying bytes and beside a full evaluation, and table 1 of [THB18]
// redone. One thread unless said. The bytes are those of plain arrays (28 a point for positions, 76
// with normals and the largest step); the drag packs normals and skips slopes that stop nothing,
// and moves 56.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "deform/evaluate/drag.h"
#include "deform/evaluate/evaluator.h"
#include "lattice/core/cache_aligned.h"
#include "lattice/core/parallel.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier::bench {
namespace {

constexpr int kCells = 10;  // an axis: 11 control points

/// A wavy torus in a grid of kCells³ cells, bent a little, its points in the order of a model.
struct Scenery {
  std::vector<glm::dvec3> points, normals;
  std::vector<LatticeMotion> motions;
  double bind_seconds = 0;

  explicit Scenery(std::size_t n) {
    const auto round = static_cast<std::size_t>(std::sqrt(2.0 * static_cast<double>(n)));
    for (std::size_t i = 0; i < n; ++i) {
      const double a =
          2 * std::numbers::pi * static_cast<double>(i % round) / static_cast<double>(round);
      const double b = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      const double r = 1.4 + 0.15 * std::sin(7 * a) * std::cos(5 * b);
      points.emplace_back(5 + (3 + r * std::cos(b)) * std::cos(a),
                          5 + (3 + r * std::cos(b)) * std::sin(a), 5 + 1.8 * r * std::sin(b));
      normals.push_back(glm::normalize(
          glm::dvec3(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b))));
    }
    const std::vector<glm::dvec3> grid = test::grid_points({kCells, kCells, kCells});
    const auto volume =
        std::make_shared<const Volume>(test::spline_volume({kCells, kCells, kCells}, grid));
    const double start = now();
    const auto binding = std::make_shared<const Binding>(embed(*volume, points));
    bind_seconds = now() - start;
    motions = {{volume, binding, volume->displacements(test::jittered(grid, 0.1, 1))}};
  }

  [[nodiscard]] DragModel model(bool has_frames) const {
    return {.rest_points = points,
            .motions = motions,
            .normals =
                has_frames ? std::span<const glm::dvec3>(normals) : std::span<const glm::dvec3>(),
            .has_fold_check = has_frames};
  }
};

/// Everything but the lattice's faces, so that all points are reached.
std::vector<double> whole_selection() {
  std::vector<double> selection;
  for (const glm::dvec3& x : test::grid_points({kCells, kCells, kCells})) {
    selection.push_back(1 - 0.9 * glm::length(x - 5.0) / 9);
  }
  return selection;
}

/// Full evaluation of the same model in the same grid, as an Evaluator writes it: by patch.
struct FullEvaluation {
  std::vector<glm::dvec3> rest, normals;
  std::optional<Evaluator<float>> evaluator;
  VolumeMotion<float> motion;

  explicit FullEvaluation(const Scenery& scenery) : motion(scenery.motions[0].displacements) {
    const Binding& binding = *scenery.motions[0].binding;
    for (const std::int32_t point : binding.points) {
      rest.push_back(scenery.points[static_cast<std::size_t>(point)]);
      normals.push_back(scenery.normals[static_cast<std::size_t>(point)]);
    }
    evaluator.emplace(*scenery.motions[0].volume,
                      BoundPoints{binding.patches, binding.uvw, rest, normals});
  }
};

void bench_drag(std::size_t n, double frame_mark, double faster_mark) {
  const Scenery scenery(n);
  const Drag<float> drag(scenery.model(true), whole_selection());
  const FullEvaluation full(scenery);
  AlignedVector<glm::vec3> points(n);  // as a vertex buffer is
  AlignedVector<glm::vec3> normals(n);
  std::vector<float> determinants(n);
  AlignedVector<char> from(38 * n, 1);
  AlignedVector<char> to(38 * n, 2);
  const glm::dvec3 by(0.1, 0.07, -0.05);
  double safe = 1;
  const auto [copying, positions, copying_all, frames, checking, stopping, evaluating] =
      best_seconds(
          n < 100000 ? 400 : 60, [&] { std::memcpy(to.data(), from.data(), 14 * n); },
          [&] { drag.update(by, {}, {.points = points}); },
          [&] { std::memcpy(to.data(), from.data(), 38 * n); },
          [&] { drag.update(by, 0.0, {.points = points, .normals = normals}); },
          [&] { safe = std::min(safe, drag.safe_fraction(by, 0)); },
          [&] { safe = std::min(safe, drag.safe_fraction(1000.0 * by, 0)); },
          [&] {
            full.evaluator->evaluate(
                full.motion, {.points = points, .determinants = determinants, .normals = normals});
          });
  const auto ns = [n](double seconds) { return seconds / static_cast<double>(n) * 1e9; };
  fmt::print(
      "{} points, {} reached; ns a point: positions {:.3f}, frames {:.3f}, fold check "
      "{:.3f}, stopped {:.3f}; full evaluation {:.2f}; memcpys {:.3f}, {:.3f}\n",
      n, drag.reached().size(), ns(positions), ns(frames), ns(checking), ns(stopping),
      ns(evaluating), ns(copying), ns(copying_all));
  print_mark("positions, a memcpy of the 28 bytes to it", copying / positions, '>', 0.95);
  print_mark("positions, normals, step, a memcpy of the 76 bytes to it", copying_all / frames, '>',
             frame_mark);
  print_mark("positions, normals, step, times as fast as a full evaluation", evaluating / frames,
             '>', faster_mark);
  print_mark("fold check and largest step, to positions", checking / positions, '<', 0.4);
  print_mark("the same where the drag is stopped", stopping / positions, '<', 0.4);
}

struct PaperRow {
  std::string name;
  std::size_t n_points, n_active;
  double preprocessing, positions, frames;  // ms
};

/// A selection that grows round the middle until the points it reaches are about as many.
std::vector<double> selection_reaching(const Scenery& scenery, std::size_t n_active) {
  const std::vector<glm::dvec3> grid = test::grid_points({kCells, kCells, kCells});
  double low = 0;
  double high = 20;
  std::vector<double> selection(grid.size());
  for (int i = 0; i < 12; ++i) {
    const double radius = (low + high) / 2;
    for (std::size_t k = 0; k < grid.size(); ++k) {
      selection[k] = glm::distance(grid[k], glm::dvec3(1.7, 4.9, 5.2)) < radius ? 1 : 0;
    }
    const Drag<float> drag(scenery.model(false), selection);
    (drag.reached().size() < n_active ? low : high) = radius;
  }
  return selection;
}

void redo_table(const PaperRow& paper) {
  const Scenery scenery(paper.n_points);
  const std::vector<double> selection = selection_reaching(scenery, paper.n_active);
  const double start = now();
  const Drag<float> drag(scenery.model(true), selection);
  const double begin_seconds = now() - start;
  std::vector<glm::vec3> points(paper.n_points);
  std::vector<glm::vec3> normals(paper.n_points);
  const glm::dvec3 by(0.1, 0.07, -0.05);
  const auto [positions, frames] = best_seconds(
      60, [&] { drag.update(by, {}, {.points = points}); },
      [&] { drag.update(by, 0.0, {.points = points, .normals = normals}); });
  fmt::print(
      "  {:<12} {:>7} {:>7} ({:>6}) | {:>7.1f} + {:>5.1f} {:>5} | {:>8.4f} {:>7} | {:>8.4f} "
      "{:>7}\n",
      paper.name, paper.n_points, drag.reached().size(), paper.n_active, scenery.bind_seconds * 1e3,
      begin_seconds * 1e3, paper.preprocessing, positions * 1e3, paper.positions, frames * 1e3,
      paper.frames);
}

}  // namespace

void bench_drags() {
  set_thread_count(1);
  fmt::print("drag in float, {}, one thread\n", name_of(instruction_set()));
  bench_drag(46590, 0.80, 8);
  bench_drag(527252, 0.95, 5);
  set_thread_count(0);
  fmt::print("table 1 of [THB18], milliseconds, {} threads; theirs behind ours\n", thread_count());
  fmt::print(
      "  model         points  active (theirs) | binding + begin theirs | FFD      theirs  | "
      "FFD+I    theirs\n");
  redo_table({"Suzanne", 46590, 29294, 97, 4.0424, 9.4882});
  redo_table({"violin case", 527252, 485683, 532, 18.327, 90.228});
}

}  // namespace espalier::bench
