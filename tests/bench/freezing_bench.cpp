// How large and how exact frozen volumes are: patches, bytes and errors of adaptive volumes by
// tolerance, and of uniform refinement by level.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "lattice/build/primitives.h"
#include "lattice/subdivision/freeze.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/support/accuracy.h"
#include "tests/support/families.h"
#include "tests/support/places.h"

namespace espalier::bench {
namespace {

constexpr int kMostLevels = 5;  // of uniform refinement

/// A lattice, its motion of about half a cell a coordinate, and where that takes points in truth.
struct Case {
  Case(std::string its_name, SubdivisionLattice its_lattice, double cell)
      : name(std::move(its_name)),
        lattice(std::move(its_lattice)),
        pose(test::jittered(lattice.rest, 0.5 * cell, 3)) {
    const Volume exact = freeze_adaptive(lattice, {.tolerance = 1e-11});
    points = test::points_inside(exact, 20000, 5);
    truth = test::motion(exact, points, pose);
  }
  [[nodiscard]] test::Difference error(const Volume& volume) const {
    return test::difference(test::motion(volume, points, pose), truth);
  }
  std::string name;
  SubdivisionLattice lattice;
  std::vector<glm::dvec3> pose;
  std::vector<glm::dvec3> points;
  test::Motion truth;
};

std::size_t n_leaves(const Volume& volume) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    n += volume.patch(i).is_leaf ? 1 : 0;
  }
  return n;
}

double print_row(const std::string& how, const Case& one, const Volume& volume, double time) {
  const test::Difference error = one.error(volume);
  const double relative = error.position / volume.diagonal();
  fmt::print("  {:<16} {:>9} {:>8} {:>9} {:>11} {:>9.1e} {:>9.1e} {:>8.3f}\n", how,
             volume.n_patches(), n_leaves(volume), volume.n_points(), volume.bytes(), relative,
             error.gradient, time);
  return relative;
}

void bench_case(const Case& one, int most_levels) {
  fmt::print("{}, {} cells\n  {:<16} {:>9} {:>8} {:>9} {:>11} {:>9} {:>9} {:>8}\n", one.name,
             one.lattice.complex->n_cells(), "", "patches", "leaves", "points", "bytes", "x'",
             "dx'/dx", "seconds");
  double wanted = 0;
  double wanted_bytes = 0;
  for (int digits = 3; digits <= 9; ++digits) {
    const double tolerance = std::pow(10.0, -digits);
    Volume volume;
    const double time =
        seconds([&] { volume = freeze_adaptive(one.lattice, {.tolerance = tolerance}); }, 1);
    const double error = print_row(fmt::format("1e-{}", digits), one, volume, time);
    if (digits == 5) {
      wanted = error;
      wanted_bytes = static_cast<double>(volume.bytes());
    }
  }
  for (int level = 2; level <= most_levels; ++level) {
    Volume volume;
    const double time = seconds([&] { volume = freeze_uniform(one.lattice, level); }, 1);
    const double error = print_row(fmt::format("uniform {}", level), one, volume, time);
    const double more_levels = std::log(error / wanted) / std::log(4.0);
    print("bytes of uniform refinement with the error at 1e-5, to its own",
          static_cast<double>(volume.bytes()) * std::pow(8.0, more_levels) / wanted_bytes, "times");
  }
}

}  // namespace

void bench_freezing() {
  set_thread_count(1);
  CylinderOptions cylinder;
  cylinder.sectors = 5;
  cylinder.layers = 3;
  bench_case(Case("cylinder of 5 sectors", test::lattice_from(make_cylinder(cylinder)), 0.3),
             kMostLevels);
  bench_case(Case("O-grid limb", test::prism(test::o_grid_section(), 10), 1), 0);
  set_thread_count(0);
}

}  // namespace espalier::bench
