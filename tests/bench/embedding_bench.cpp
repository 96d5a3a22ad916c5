// How fast points are found in volumes, beside evaluating them, and how exactly: round trips of
// random points of every lattice family.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/evaluate/displace.h"
#include "lattice/build/primitives.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/volume/point_locator.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/support/families.h"
#include "tests/support/places.h"
#include "tests/support/spline_volume.h"

namespace espalier::bench {
namespace {

/// Points of a volume patch by patch, as evaluation wants them, in random order.
std::vector<glm::dvec3> random_points(const Volume& volume, std::size_t n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const BezierPatch patch = volume.bezier(random() % volume.n_patches(), volume.rest_points());
    points.push_back(patch.value({unit(random), unit(random), unit(random)}));
  }
  return points;
}

void bench_speed(const std::string& name, const Volume& volume) {
  constexpr std::size_t kPoints = 100000;
  const std::vector<glm::dvec3> points = random_points(volume, kPoints);
  const double preparing = seconds([&] { const PointLocator locator(volume); });
  const PointLocator locator(volume);
  std::vector<Location> found;
  const double locating = seconds([&] { found = locator.locate(points); });
  std::vector<BezierPatch> patches;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    patches.push_back(volume.bezier(i, volume.rest_points()));
  }
  glm::dvec3 sum(0);
  const double evaluating = seconds([&] {
    for (const Location& location : found) {
      glm::dvec3 value;
      glm::dmat3 derivative;
      patches[static_cast<std::size_t>(location.patch)].evaluate(location.uvw, value, derivative);
      sum += value + derivative[0];
    }
  });
  fmt::print("{}: {} patches (sum {:.3g})\n", name, volume.n_patches(), sum.x);
  print("prepare, microseconds a patch", preparing / static_cast<double>(volume.n_patches()) * 1e6,
        "µs");
  print("find, nanoseconds a point", locating / kPoints * 1e9, "ns");
  print("find, to evaluating value and derivative there", locating / evaluating, "times");
}

void bench_round_trips(const std::string& name, const Volume& volume, std::size_t n) {
  const std::vector<glm::dvec3> points = test::points_inside(volume, n, 11);
  const PointLocator locator(volume);
  const std::vector<Location> found = locator.locate(points);
  std::size_t n_missed = 0;
  std::size_t n_unconverged = 0;
  double largest = 0;
  std::vector<int> n_steps;
  for (std::size_t i = 0; i < n; ++i) {
    n_unconverged += found[i].status == PointStatus::Unconverged ? 1 : 0;
    if (found[i].patch < 0) {
      ++n_missed;
      continue;
    }
    n_steps.push_back(found[i].n_steps);
    const BezierPatch patch =
        volume.bezier(static_cast<std::size_t>(found[i].patch), volume.rest_points());
    largest = std::max(largest, glm::distance(patch.value(found[i].uvw), points[i]));
  }
  std::nth_element(n_steps.begin(), n_steps.begin() + static_cast<std::ptrdiff_t>(n / 2),
                   n_steps.end());
  fmt::print("  {:<34} {:>8} {:>8} {:>12} {:>10.1e} {:>6} {:>6}\n", name, volume.n_patches(),
             n_missed, n_unconverged, largest / volume.diagonal(), n_steps[n / 2],
             *std::max_element(n_steps.begin(), n_steps.end()));
}

void bench_deform() {
  const SubdivisionLattice lattice = test::lattice_from(make_box({6, 6, 6}, {0, 0, 0}, {1, 1, 1}));
  const Volume volume = freeze_uniform(lattice, 3);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.01, 0.99);
  std::vector<glm::dvec3> points(100000);
  for (glm::dvec3& point : points) {
    point = {place(random), place(random), place(random)};
  }
  fmt::print("{} points in {} patches\n", points.size(), volume.n_patches());
  std::vector<glm::dvec3> pose = lattice.rest;
  for (glm::dvec3& point : pose) {
    point += 0.1 * point * point;
  }
  const std::vector<glm::dvec3> displacements = volume.displacements(pose);
  const auto n = static_cast<double>(points.size());
  for (const int threads : {1, 0}) {
    set_thread_count(threads);
    const std::string with =
        threads == 1 ? ", one thread" : fmt::format(", {} threads", thread_count());
    Binding binding;
    const double embedding = seconds([&] { binding = embed(volume, points); });
    std::vector<glm::dvec3> moved;
    const double displacing =
        seconds([&] { moved = displaced_points(volume, binding, points, displacements); }, 10);
    print("embed, microseconds a point" + with, embedding / n * 1e6, "µs");
    print("embed, to displacing the points" + with, embedding / displacing, "times");
    const std::size_t bytes = points.size() * (3 * sizeof(glm::dvec3) + 2 * sizeof(std::int32_t));
    print("displace, to copying points, places and result" + with, displacing / copy_seconds(bytes),
          "copies");
  }
}

}  // namespace

void bench_embedding() {
  set_thread_count(1);
  constexpr std::array<int, 3> kIntervals = {6, 6, 6};
  const auto warped = [&](const std::array<int, 3>& intervals, double noise) {
    return test::spline_volume(intervals, test::jittered(test::grid_points(intervals), noise, 3));
  };
  bench_speed("tricubic, warped", warped(kIntervals, 0.2));
  bench_speed("tricubic, warped, many patches", warped({20, 20, 20}, 0.2));
  bench_speed("tricubic, affine", warped(kIntervals, 0));
  bench_speed("trilinear, affine",
              freeze_uniform(test::lattice_from(make_box({6, 6, 6}, {0, 0, 0}, {1, 1, 1})), 2));
  bench_speed("O-grid limb", freeze_adaptive(test::prism(test::o_grid_section(), 10)));
  bench_speed("cylinder of wedges", freeze_adaptive(test::lattice_from(make_cylinder({}))));
  bench_deform();
  set_thread_count(1);
  constexpr std::size_t kPoints = 20000;
  fmt::print("round trips of {} points a family\n  {:<34} {:>8} {:>8} {:>12} {:>10} {:>6} {:>6}\n",
             kPoints, "", "patches", "missed", "unconverged", "residual", "median", "most");
  for (const test::NamedLattice& family : test::lattice_families()) {
    bench_round_trips(family.name, freeze_adaptive(family.lattice, {.tolerance = 1e-4}), kPoints);
  }
  set_thread_count(0);
}

}  // namespace espalier::bench
