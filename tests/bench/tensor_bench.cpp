/// How fast hierarchies of B-splines are built, frozen, refined and evaluated; evaluation also as a
/// ratio to asking every function of the hierarchy. And how fast points are embedded in lattices
/// along the axes, beside the tree's search and beside a loop that only divides by even knots. Each
/// time is the best of a few repeats. At last, how many points of a model the control points of
/// every level move, beside [THB18] tables 2 and 3.
///
/// usage: tensor_bench [a model's file, refined twice; none: a torus]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/evaluate/weights.h"
#include "deform/model/model_file.h"
#include "deform/model/surface_model.h"
#include "lattice/core/parallel.h"
#include "lattice/tensor/thb_lattice.h"

namespace espalier {
namespace {

/// Seconds of the processor that `work` takes: the best of `repeats`.
template <class Work>
double time_of(int repeats, const Work& work) {
  const auto now = [] {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double begin = now();
    work();
    best = std::min(best, now() - begin);
  }
  return best;
}

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
             1e3 * time_of(7, [] { static_cast<void>(three_local_levels()); }));
  fmt::print("freeze it                 {:8.2f} ms\n",
             1e3 * time_of(7, [&] { static_cast<void>(freeze(lattice)); }));
  const std::vector<GridIndex> cells = region_to_refine(*lattice.hierarchy);
  fmt::print("refine 64 cells on top    {:8.2f} ms\n",
             1e3 * time_of(7, [&] { static_cast<void>(with_cells(lattice, 4, cells)); }));
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
  const double by_patches = time_of(5, [&] {
    BezierPatch patch;
    for (const glm::dvec3& uvw : places) {
      const PatchPlace place = place_of(*lattice.hierarchy, leaves, uvw);
      volume.bezier(place.patch, volume.rest_points(), patch);
      sum += patch.value(place.uvw);
    }
  });
  const double by_all = time_of(1, [&] {
    for (const glm::dvec3& uvw : places) {
      sum += sum_of_all(lattice, axes, uvw);
    }
  });
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
  const double tree = time_of(1, [&] { static_cast<void>(by_tree.locate(points)); });
  const double grid = time_of(5, [&] { static_cast<void>(by_grid.locate(points)); });
  const double whole = time_of(5, [&] { static_cast<void>(embed(by_grid, points)); });
  fmt::print(
      "{}: {} patches, million points a second: locate {:.1f} (tree {:.2f}), embed {:.1f}, "
      "{:.1f} times as long as dividing\n",
      name, volume.n_patches(), 1e-6 * static_cast<double>(points.size()) / grid,
      1e-6 * static_cast<double>(points.size()) / tree,
      1e-6 * static_cast<double>(points.size()) / whole, whole / by_division);
}

void report_embedding(const ThbLattice& levels) {
  const std::vector<glm::dvec3> points = random_places(1000000);
  const double by_division = time_of(5, [&] { static_cast<void>(places_by_division(points, 17)); });
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

/// Up to the given level on all of [0,1]³, or on three cells an axis round a place.
ThbLattice refined_round(ThbLattice lattice, int n_levels, const glm::dvec3* place) {
  for (int level = 1; level <= n_levels; ++level) {
    std::vector<glm::dvec3> places;
    const int n = 3 << (level - 1);  // cells an axis of the level before
    const auto n_cells = static_cast<double>(n);
    const int reach = place == nullptr ? n : 1;
    const glm::dvec3 middle = place == nullptr ? glm::dvec3(0.5 / n_cells)
                                               : (glm::floor(*place * n_cells) + 0.5) / n_cells;
    for (int k = -reach; k <= reach; ++k) {
      for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
          places.push_back(middle + glm::dvec3(i, j, k) / n_cells);
        }
      }
    }
    lattice = with_cells(lattice, level, cells_holding(*lattice.hierarchy, level, places));
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

/// The settings of [THB18] tables 2 and 3, there for a model of 46590 points.
void report_influence(const std::vector<glm::dvec3>& points) {
  fmt::print("influence on {} points\n", points.size());
  const OrientedBox box = fitted_box(points, 0.01);
  const auto cubic = [&](int n) { return make_thb_lattice({n, n, n}, {3, 3, 3}, box); };
  report_influence("B-spline 6^3", "216; 13803 (29.6 %), 12 none", cubic(6), points);
  report_influence("B-spline 15^3", "3375; 881 (1.8 %), 1396 none", cubic(15), points);
  report_influence("THB 6^3, all at level 1", "729; level 1: 4082 (8.7 %), 167 none",
                   refined_round(cubic(6), 1, nullptr), points);
  report_influence("THB 6^3, all at level 2", "3375; level 2: 881 (1.8 %), 1396 none",
                   refined_round(cubic(6), 2, nullptr), points);
  const glm::dvec3 far_end =
      *std::max_element(points.begin(), points.end(),
                        [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; });
  const glm::dvec3 place = 0.5 + 0.5 * (far_end - box.center) / box.half_sizes;
  report_influence("THB 6^3, to level 3 round the point of largest x",
                   "302; 13907 (29.8 %), 4263 (9.1 %), 5892 (12.6 %), 2134 (4.5 %); "
                   "none: 12, 9, 0, 0",
                   refined_round(cubic(6), 3, &place), points);
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  espalier::set_thread_count(1);
  const espalier::ThbLattice lattice = espalier::three_local_levels();
  espalier::report_building(lattice);
  espalier::report_evaluation(lattice);
  espalier::report_embedding(lattice);
  const auto points = [&] {
    if (argc < 2) {
      return espalier::torus_points();
    }
    const espalier::Model model = refined_model(espalier::read_model(argv[1]), 2, "refined");
    return std::vector(model.points().begin(), model.points().end());
  }();
  espalier::report_influence(points);
}
