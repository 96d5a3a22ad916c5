// How fast evaluation is, beside the processor's peak, memory, and OpenSubdiv's CPU evaluator.

#include <fmt/format.h>
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "deform/evaluate/evaluator.h"
#include "lattice/core/parallel.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/bench/weight_rows.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier::bench {
namespace {

constexpr int kCells = 10;  // an axis: 11 control points
constexpr double kTricubicFma = 189;

/// Fused multiplications and additions of ten independent vectors, `n` each.
[[gnu::target("avx2,fma"), gnu::noinline]] float spin(int n) {
  const __m256 factor = _mm256_set1_ps(0.999F);
  const __m256 term = _mm256_set1_ps(1e-3F);
  __m256 a[10] = {term, term, term, term, term, term, term, term, term, term};
  for (int i = 0; i < n; ++i) {
#pragma GCC unroll 10
    for (__m256& x : a) {
      x = _mm256_fmadd_ps(x, factor, term);
      asm volatile("" : "+x"(x));  // keeps them apart, and there
    }
  }
  __m256 sum = a[0];
#pragma GCC unroll 10
  for (int i = 1; i < 10; ++i) {
    sum = _mm256_add_ps(sum, a[i]);
  }
  return _mm256_cvtss_f32(sum);
}

/// Points of a wavy torus in the grid of kCells³ cells, sorted by cell: as a model's surface they
/// fill few of the cells.
struct Surface {
  std::vector<std::int32_t> patches;
  std::vector<glm::dvec3> points, uvw, normals;
};

Surface surface_of(std::size_t n) {
  const auto round = static_cast<std::size_t>(std::sqrt(2.0 * static_cast<double>(n)));
  std::vector<std::pair<std::int32_t, glm::dvec3>> placed;
  for (std::size_t i = 0; i < n; ++i) {
    const double a =
        2 * std::numbers::pi * static_cast<double>(i % round) / static_cast<double>(round);
    const double b = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double r = 1.4 + 0.15 * std::sin(7 * a) * std::cos(5 * b);
    const glm::dvec3 x(5 + (3 + r * std::cos(b)) * std::cos(a),
                       5 + (3 + r * std::cos(b)) * std::sin(a), 5 + 1.8 * r * std::sin(b));
    const auto cell = glm::ivec3(glm::floor(x));
    placed.emplace_back(cell.x + kCells * (cell.y + kCells * cell.z), x);
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Surface surface;
  for (const auto& [patch, x] : placed) {
    surface.patches.push_back(patch);
    surface.points.push_back(x);
    surface.uvw.push_back(glm::fract(x));
    surface.normals.emplace_back(0, 0, 1);
  }
  return surface;
}

/// Rows of 64 weights, a patch's control points each: not the right ones, but as many.
WeightRows rows_of(const Volume& volume, const Surface& surface) {
  const std::vector<float> weights(64, 1.0F / 64);
  std::vector<std::int32_t> indices(64);
  WeightRows rows;
  for (const std::int32_t patch : surface.patches) {
    const auto block = volume.block(static_cast<std::size_t>(patch));
    for (std::size_t k = 0; k < 64; ++k) {
      indices[k] = block[k % block.size()];
    }
    rows.add<float>(indices, weights);
  }
  return rows;
}

/// Nanoseconds a point of the tricubic's positions.
double bench_tricubic(std::size_t n, double peak, double ns_before) {
  const std::vector<glm::dvec3> grid = test::grid_points({kCells, kCells, kCells});
  const Volume volume = test::spline_volume({kCells, kCells, kCells}, grid);
  const Surface surface = surface_of(n);
  const Evaluator<float> evaluator(volume,
                                   {surface.patches, surface.uvw, surface.points, surface.normals});
  const VolumeMotion<float> motion(volume.displacements(test::jittered(grid, 0.3, 1)));
  std::vector<glm::vec3> points(n);
  std::vector<glm::vec3> normals(n);
  std::vector<float> determinants(n);
  const auto positions = [&] { evaluator.evaluate(motion, {.points = points}); };
  const auto frames = [&] {
    evaluator.evaluate(motion,
                       {.points = points, .determinants = determinants, .normals = normals});
  };
  const auto n_points = static_cast<double>(n);
  const int rounds = n > 1000000 ? 5 : n > 100000 ? 10 : 30;
  WeightRows rows;  // for the largest number of points they would need too much memory
  std::vector<float> to;
  if (n < 1000000) {
    rows = rows_of(volume, surface);
    to.resize(4 * n);
  }
  set_thread_count(1);
  float sink = 0;
  const auto [one, with_normals, spinning, opensubdiv, plain] = best_seconds(
      rounds, positions, frames, [&] { sink += spin(100000); },
      [&] { rows.apply_as_opensubdiv(motion.values(), to.data()); },
      [&] { rows.apply_plainly(motion.values(), to.data()); });
  peak = sink > 0 ? std::max(peak, 100000 * 80 / spinning) : peak;
  const double ns = one / n_points * 1e9;
  fmt::print("tricubic, {} points: {:.2f} ns a point\n", n, ns);
  if (n < 1000000) {
    print_mark("positions, to the FMA peak", kTricubicFma * n_points / one / peak, '>',
               n < 100000 ? 0.75 : 0.85);
    print_mark("positions, times as fast as OpenSubdiv's EvalStencils", opensubdiv / one, '>', 25);
    print_mark("positions, times as fast as a plain loop over rows", plain / one, '>', 7);
  } else {
    print_mark("positions, to those of 527,252 points", ns / ns_before, '<', 1.1);
  }
  print_mark("positions, normals, determinants, to positions", with_normals / one, '<', 2.5);
  if (n > 100000) {
    print_mark("two threads, times as fast as one", two_thread_gain(rounds, positions), '>', 1.8);
  }
  return ns;
}

void bench_trilinear(std::size_t n) {
  constexpr std::size_t kPointsInLeaf = 200;
  VolumeTables tables;
  tables.extractions = {bezier_extraction(1)};
  const auto side = static_cast<int>(std::cbrt(static_cast<double>(n / kPointsInLeaf)));
  const std::vector<glm::dvec3> grid = test::grid_points({side, side, side});
  for (const glm::dvec3& cell : test::grid_points({side - 1, side - 1, side - 1})) {
    std::vector<std::int32_t> block;
    for (const glm::dvec3& corner : test::grid_points({1, 1, 1})) {
      const auto at = glm::ivec3(cell + corner);
      block.push_back(at.x + (side + 1) * (at.y + (side + 1) * at.z));
    }
    tables.patches.emplace_back();
    tables.blocks.push_back(block);
  }
  tables.stencils = StencilTable::build(grid.size(), grid.size(), [](std::size_t i, StencilRow& r) {
    r.add(static_cast<std::int32_t>(i), 1.0);
  });
  const std::size_t n_patches = tables.patches.size();
  const Volume volume(std::move(tables), grid);
  Surface surface = surface_of(n);
  for (std::size_t i = 0; i < n; ++i) {
    surface.patches[i] = static_cast<std::int32_t>(i * n_patches / n);
  }
  const Evaluator<float> evaluator(volume, {surface.patches, surface.uvw, surface.points});
  const VolumeMotion<float> motion(volume.displacements(test::jittered(grid, 0.3, 1)));
  std::vector<glm::vec3> points(n);
  std::vector<char> from(24 * n, 1);
  std::vector<char> to(24 * n, 2);
  const auto [evaluating, copying, copying_half] = best_seconds(
      n > 1000000 ? 5 : 30, [&] { evaluator.evaluate(motion, {.points = points}); },
      [&] { std::memcpy(to.data(), from.data(), 24 * n); },
      [&] { std::memcpy(to.data(), from.data(), 12 * n); });
  fmt::print("trilinear, {} points: {:.2f} ns a point; {:.2f} memcpys of 12 bytes\n", n,
             evaluating / static_cast<double>(n) * 1e9, evaluating / copying_half);
  print_mark("positions, to a memcpy of 24 bytes a point", evaluating / copying, '<', 2.2);
}

}  // namespace

void bench_evaluation() {
  fmt::print("evaluation in float, {}, one thread\n", name_of(instruction_set()));
  if (available_instruction_sets().back() != InstructionSet::Avx2) {
    fmt::print("  the marks are for AVX2, which this processor has not\n");
    return;
  }
  float sink = 0;
  set_thread_count(1);
  const auto [spinning] = best_seconds(100, [&] { sink += spin(100000); });
  const double peak = sink > 0 ? 100000 * 80 / spinning : 0;
  double ns = 0;
  for (const std::size_t n : {std::size_t{46590}, std::size_t{527252}, std::size_t{10000000}}) {
    ns = bench_tricubic(n, peak, ns);
    bench_trilinear(n);
  }
  set_thread_count(0);
}

}  // namespace espalier::bench
