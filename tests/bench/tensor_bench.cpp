// How fast hierarchies of B-splines are built, frozen, refined and evaluated; evaluation also as a
// ratio to asking every function of the hierarchy. How fast points are embedded in lattices along
// the axes, beside the tree's search, beside a loop that only divides by even knots, and beside
// copying memory. And how many points of a model the control points of every level move, as in
// [THB18] tables 2 and 3.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/evaluate/weights.h"
#include "lattice/tensor/thb_lattice.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"

namespace espalier::bench {
namespace {

/// 20 × 20 × 20 cubic control points, and in each of three levels a box of 10 × 10 × 10 cells.
ThbLattice three_local_levels() {
  ThbLattice lattice = make_thb_lattice({20, 20, 20}, {3, 3, 3}, {});
  std::vector<std::vector<GridIndex>> domains(3);
  for (std::size_t level = 0; level < 3; ++level) {
    const int first = level == 0 ? 3 : 2 * domains[level - 1].front().i + 5;
    for (int k = first; k < first + 10; ++k) {
      for (int j = first; j < first + 10; ++j) {
        for (int i = first; i < first + 10; ++i) {
          domains[level].push_back({i, j, k});
        }
      }
    }
  }
  const ThbHierarchy& root = *lattice.hierarchy;
  return refined_to(lattice, std::make_shared<const ThbHierarchy>(root.counts(), root.degree(),
                                                                  std::move(domains)));
}

/// 4 × 4 × 4 cells in the middle of the finest level.
std::vector<GridIndex> region_to_refine(const ThbHierarchy& hierarchy) {
  const GridIndex corner = hierarchy.domain(3).front();
  std::vector<GridIndex> cells;
  for (int i = 0; i < 64; ++i) {
    cells.push_back(
        {2 * corner.i + 8 + i % 4, 2 * corner.j + 8 + i / 4 % 4, 2 * corner.k + 8 + i / 16});
  }
  return cells;
}

std::vector<glm::dvec3> random_places(std::size_t n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> places;
  for (std::size_t i = 0; i < n; ++i) {
    places.emplace_back(unit(random), unit(random), unit(random));
  }
  return places;
}

/// The sum over all functions that are control points, not even truncated: what one pays without
/// patches. At least the axes are evaluated once.
glm::dvec3 sum_of_all(const ThbLattice& lattice, const std::vector<std::array<TensorAxis, 3>>& axes,
                      const glm::dvec3& uvw) {
  std::vector<std::array<std::vector<double>, 3>> values(axes.size());
  for (std::size_t level = 0; level < axes.size(); ++level) {
    for (std::size_t a = 0; a < 3; ++a) {
      const TensorAxis& axis = axes[level][a];
      values[level][a].assign(static_cast<std::size_t>(axis.n_controls()), 0.0);
      for (const auto& [i, weight] : axis.values(uvw[static_cast<int>(a)] * axis.end())) {
        values[level][a][static_cast<std::size_t>(i)] = weight;
      }
    }
  }
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < lattice.rest.size(); ++i) {
    const ThbFunction& f = lattice.hierarchy->controls()[i];
    const auto& of_level = values[static_cast<std::size_t>(f.level)];
    const double weight = of_level[0][static_cast<std::size_t>(f.index.i)] *
                          of_level[1][static_cast<std::size_t>(f.index.j)] *
                          of_level[2][static_cast<std::size_t>(f.index.k)];
    sum += weight * lattice.rest[i];
  }
  return sum;
}

void report_building(const ThbLattice& lattice) {
  fmt::print("{} control points, {} leaves\n", lattice.rest.size(),
             lattice.hierarchy->leaves().size());
  fmt::print("build the hierarchy       {:8.2f} ms\n",
             1e3 * seconds([] { static_cast<void>(three_local_levels()); }, 7));
  fmt::print("freeze it                 {:8.2f} ms\n",
             1e3 * seconds([&] { static_cast<void>(freeze(lattice)); }, 7));
  const std::vector<GridIndex> cells = region_to_refine(*lattice.hierarchy);
  fmt::print("refine 64 cells on top    {:8.2f} ms\n",
             1e3 * seconds([&] { static_cast<void>(with_cells(lattice, 4, cells)); }, 7));
}

void report_evaluation(const ThbLattice& lattice) {
  const std::vector<glm::dvec3> places = random_places(2000);
  const Volume volume = freeze(lattice);
  const std::vector<ThbCell> leaves = lattice.hierarchy->leaves();
  std::vector<std::array<TensorAxis, 3>> axes;
  for (int level = 0; level < lattice.hierarchy->n_levels(); ++level) {
    const auto along = [&](std::size_t a) {
      return TensorAxis::make(lattice.hierarchy->axes(level)[a].n_functions(), 3, Ends::Open);
    };
    axes.push_back({along(0), along(1), along(2)});
  }
  glm::dvec3 sum(0);
  const double by_patches = seconds([&] {
    BezierPatch patch;
    for (const glm::dvec3& uvw : places) {
      const PatchPlace place = place_of(*lattice.hierarchy, leaves, uvw);
      volume.bezier(place.patch, volume.rest_points(), patch);
      sum += patch.value(place.uvw);
    }
  });
  const double by_all = seconds(
      [&] {
        for (const glm::dvec3& uvw : places) {
          sum += sum_of_all(lattice, axes, uvw);
        }
      },
      1);
  const auto n = static_cast<double>(places.size());
  fmt::print("evaluate, a patch a point {:8.0f} ns\n", 1e9 * by_patches / n);
  fmt::print("evaluate, all functions   {:8.0f} ns, {:.0f} times as long{}\n", 1e9 * by_all / n,
             by_all / by_patches, std::isfinite(sum.x) ? "" : " (not finite)");
}

/// What anyone would write for one lattice with even knots on the unit cube.
Binding places_by_division(const std::vector<glm::dvec3>& points, int n) {
  Binding binding;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 at = static_cast<double>(n) * points[i];
    const glm::ivec3 cell = glm::min(glm::ivec3(at), n - 1);
    binding.status.push_back(PointStatus::Inside);
    binding.points.push_back(static_cast<std::int32_t>(i));
    binding.patches.push_back(cell.x + n * (cell.y + n * cell.z));
    binding.uvw.push_back(at - glm::dvec3(cell));
  }
  return binding;
}

void report_embedding(const char* name, const Volume& volume, double by_division) {
  const std::vector<glm::dvec3> points = random_places(1000000);
  const PointLocator by_grid(volume);
  const PointLocator by_tree(volume, PatchSearch::Tree);
  const double tree = seconds([&] { static_cast<void>(embed(by_tree, points)); }, 1);
  const double whole = seconds([&] { static_cast<void>(embed(by_grid, points)); }, 7);
  // A point is read, and its status, number, patch and place are written.
  const double copying = copy_seconds(points.size() * (sizeof(glm::dvec3) + 33) / 2);
  fmt::print(
      "{}: {} patches, embed {:.1f} million points a second (by the tree {:.2f}), {:.2f} times as "
      "long as dividing, {:.1f} times as long as copying\n",
      name, volume.n_patches(), 1e-6 * static_cast<double>(points.size()) / whole,
      1e-6 * static_cast<double>(points.size()) / tree, whole / by_division, whole / copying);
}

void report_embedding(const ThbLattice& levels) {
  const std::vector<glm::dvec3> points = random_places(1000000);
  const double by_division = seconds([&] { static_cast<void>(places_by_division(points, 17)); }, 5);
  const TensorAxis axis = TensorAxis::make(20, 3, Ends::Open);
  const TensorAxis bezier = TensorAxis::make(4, 3, Ends::Open);
  OrientedBox turned;
  turned.axes = glm::dmat3(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1);
  turned.half_sizes = glm::dvec3(1);
  const auto frozen = [](TensorKind kind, const TensorAxis& along, const OrientedBox& box) {
    return freeze(make_tensor_lattice(kind, {along, along, along}, box));
  };
  report_embedding("B-spline", frozen(TensorKind::BSpline, axis, {}), by_division);
  report_embedding("turned  ", frozen(TensorKind::BSpline, axis, turned), by_division);
  report_embedding("Bézier  ", frozen(TensorKind::Bezier, bezier, {}), by_division);
  report_embedding("THB     ", freeze(levels), by_division);
}

/// As many points as the paper's model has, nearly, on a torus.
std::vector<glm::dvec3> torus_points() {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 155; ++j) {
      const double u = 2 * std::acos(-1.0) * i / 300;
      const double v = 2 * std::acos(-1.0) * j / 155;
      const double radius = 1 + 0.4 * std::cos(v);
      points.emplace_back(radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v));
    }
  }
  return points;
}

/// Refined to levels 1, 2, …, each in one box of [0,1]³.
ThbLattice refined_in(ThbLattice lattice, const std::vector<std::array<glm::dvec3, 2>>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const int level = static_cast<int>(i) + 1;
    lattice = with_cells(lattice, level,
                         cells_of_box(*lattice.hierarchy, level, boxes[i][0], boxes[i][1]));
  }
  return lattice;
}

void report_influence(const char* name, const char* paper, const ThbLattice& lattice,
                      const std::vector<glm::dvec3>& points) {
  const Volume volume = freeze(lattice);
  const auto levels =
      level_influences(*lattice.hierarchy, control_weights(volume, embed(volume, points)));
  fmt::print("{}: {} control points\n", name, lattice.rest.size());
  for (std::size_t level = 0; level < levels.size(); ++level) {
    fmt::print("  level {}: {:4} move {:6.0f} points on average ({:4.1f} %), {:4} move none\n",
               level, levels[level].n_controls, levels[level].mean_points,
               100 * levels[level].mean_points / static_cast<double>(points.size()),
               levels[level].n_without);
  }
  fmt::print("  paper: {}\n", paper);
}

/// The settings of [THB18] tables 2 and 3, there for a model of 46590 points. Which cells the paper
/// refines round an eye it does not tell; the boxes below lie at a corner of the lattice, as an eye
/// does, and are among those that make its number of control points.
void report_influence(const std::vector<glm::dvec3>& points) {
  fmt::print("influence on {} points\n", points.size());
  const OrientedBox box = fitted_box(points, 0.01);
  const auto cubic = [&](int n) { return make_thb_lattice({n, n, n}, {3, 3, 3}, box); };
  const std::array<glm::dvec3, 2> all = {glm::dvec3(0), glm::dvec3(1)};
  report_influence("B-spline 6^3", "216; 13803 (29.6 %), 12 none", cubic(6), points);
  report_influence("B-spline 15^3", "3375; 881 (1.8 %), 1396 none", cubic(15), points);
  report_influence("THB 6^3, all at level 1", "729; level 1: 4082 (8.7 %), 167 none",
                   refined_in(cubic(6), {all}), points);
  report_influence("THB 6^3, all at level 2", "3375; level 2: 881 (1.8 %), 1396 none",
                   refined_in(cubic(6), {all, all}), points);
  const double sixth = 1.0 / 6;
  const ThbLattice corner = refined_in(
      cubic(6), {{glm::dvec3(0), glm::dvec3(4 * sixth)},
                 {glm::dvec3(sixth, sixth, 0), glm::dvec3(3 * sixth, 4 * sixth, 3 * sixth)},
                 {glm::dvec3(sixth, sixth, 0), glm::dvec3(2 * sixth, 2 * sixth, 3 * sixth)}});
  report_influence("THB 6^3, to level 3 at a corner",
                   "302; 13907 (29.8 %), 4263 (9.1 %), 5892 (12.6 %), 2134 (4.5 %); "
                   "none: 12, 9, 0, 0",
                   corner, points);
}

}  // namespace

void bench_tensor() {
  set_thread_count(1);
  const ThbLattice lattice = three_local_levels();
  report_building(lattice);
  report_evaluation(lattice);
  report_embedding(lattice);
  report_influence(torus_points());
  set_thread_count(0);
}

}  // namespace espalier::bench
