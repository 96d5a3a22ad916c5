// Pulling points: factorising once, then as often as the mouse moves.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "deform/direct/pull.h"
#include "deform/direct/smooth_motion.h"
#include "deform/embed/embed.h"
#include "deform/evaluate/weights.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"

namespace espalier::bench {
namespace {

constexpr int kControlsOnAxis = 20;
constexpr std::size_t kPicks = 1000;
constexpr double kMostMilliseconds = 50;

std::vector<glm::dvec3> random_places(std::size_t n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> places(n);
  for (glm::dvec3& p : places) {
    p = {unit(random), unit(random), unit(random)};
  }
  return places;
}

void bench_energy(const std::string& name, const StencilTable& rows,
                  const std::shared_ptr<const MotionEnergy>& energy) {
  std::vector<glm::dvec3> wanted(rows.n_rows());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = 0.01 * glm::dvec3(std::sin(static_cast<double>(i)), 1, 0);
  }
  const double start = now();
  const Pull pull(rows, energy);
  const double factorising = now() - start;
  double worst = 0;
  const double moving = seconds(
      [&] {
        worst = 0;
        for (const glm::dvec3& residual : pull.motion(wanted).residuals) {
          worst = std::max(worst, glm::length(residual));
        }
      },
      5);
  print(name + ": factorising", factorising, "s");
  print_mark(name + ": the motion", 1e3 * moving, '<', kMostMilliseconds);
  print(name + ": the motion, to copying as many numbers as the factor has",
        moving / copy_seconds(8 * rows.n_controls() * rows.n_rows()), "");
  print(name + ": farthest from a target", worst, "of the lattice's size");
}

}  // namespace

void bench_pulling() {
  set_thread_count(1);
  const TensorAxis axis = TensorAxis::make(kControlsOnAxis, 3, Ends::Open);
  const Lattice lattice =
      make_tensor_lattice(TensorKind::BSpline, {axis, axis, axis}, {}, BoxFilling::Volume);
  const Volume volume = lattice.freeze();
  const StencilTable rows = control_weights(volume, embed(volume, random_places(kPicks)));
  fmt::print("  {} picks, {} control points, milliseconds of one thread\n", rows.n_rows(),
             rows.n_controls());
  bench_energy("smallest motion", rows, smallest_motion(rows));
  bench_energy("smooth motion", rows, smooth_motion(rows, neighbour_differences(lattice, volume)));
  set_thread_count(0);
}

}  // namespace espalier::bench
