// How fast evaluation is, beside the processor's peak, memory, and OpenSubdiv's CPU evaluator.

#include "tests/bench/evaluation_bench.h"

#include <fmt/format.h>
#include <immintrin.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <glm/common.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "deform/evaluate/evaluator.h"
#include "lattice/core/parallel.h"
#include "tests/support/families.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

constexpr int kCells = 10;  // an axis: 11 control points
constexpr double kTricubicFma = 189;

double now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The least times of several works, taken in turn.
template <class... Works>
std::array<double, sizeof...(Works)> best_seconds(int rounds, const Works&... works) {
  std::array<double, sizeof...(Works)> best;
  best.fill(1e300);
  for (int round = 0; round < rounds; ++round) {
    std::size_t at = 0;
    const auto time = [&](const auto& work) {
      const double start = now();
      work();
      best[at] = std::min(best[at], now() - start);
      ++at;
    };
    (time(works), ...);
  }
  return best;
}

void print(const std::string& what, double value, char relation, double mark) {
  const bool is_reached = relation == '<' ? value <= mark : value >= mark;
  fmt::print("  {:<58} {:>8.3g}  {} {:<5} {}\n", what, value, relation == '<' ? "≤" : "≥", mark,
             is_reached ? "reached" : "missed");
}

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

/// Rows of 64 weights, a patch's control points each, as OpenSubdiv and a plain loop read them.
struct Rows {
  std::vector<int> sizes, offsets, indices;
  std::vector<float> weights;

  Rows(const Volume& volume, const Surface& surface) {
    for (std::size_t i = 0; i < surface.patches.size(); ++i) {
      const auto block = volume.block(static_cast<std::size_t>(surface.patches[i]));
      sizes.push_back(64);
      offsets.push_back(static_cast<int>(64 * i));
      for (std::size_t k = 0; k < 64; ++k) {
        indices.push_back(block[k % block.size()]);
        weights.push_back(1.0F / 64);
      }
    }
  }

  void evaluate_as_opensubdiv(const float* from, float* to) const {
    using OpenSubdiv::Osd::BufferDescriptor;
    OpenSubdiv::Osd::CpuEvaluator::EvalStencils(
        from, BufferDescriptor(0, 3, 4), to, BufferDescriptor(0, 3, 4), sizes.data(),
        offsets.data(), indices.data(), weights.data(), 0, static_cast<int>(sizes.size()));
  }

  void evaluate_plainly(const float* from, float* to) const {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      float sum[3] = {0, 0, 0};
      for (int k = offsets[i]; k < offsets[i] + sizes[i]; ++k) {
        const float* const point = from + 4 * indices[static_cast<std::size_t>(k)];
        const float weight = weights[static_cast<std::size_t>(k)];
        sum[0] += weight * point[0];
        sum[1] += weight * point[1];
        sum[2] += weight * point[2];
      }
      std::copy_n(sum, 3, to + 4 * i);
    }
  }
};

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
  const int rounds = n > 1000000 ? 12 : 60;
  set_thread_count(1);
  float sink = 0;
  const auto [one, with_normals, spinning] =
      best_seconds(rounds, positions, frames, [&] { sink += spin(100000); });
  peak = sink > 0 ? std::max(peak, 100000 * 80 / spinning) : peak;
  set_thread_count(2);
  const auto [two] = best_seconds(rounds, positions);
  set_thread_count(1);
  const double ns = one / n_points * 1e9;
  fmt::print("tricubic, {} points: {:.2f} ns a point\n", n, ns);
  if (n < 1000000) {
    print("positions, to the FMA peak", kTricubicFma * n_points / one / peak, '>',
          n < 100000 ? 0.75 : 0.85);
    const Rows rows(volume, surface);
    std::vector<float> to(4 * n);
    const auto [opensubdiv, plain] = best_seconds(
        n < 100000 ? 60 : 12, [&] { rows.evaluate_as_opensubdiv(motion.values(), to.data()); },
        [&] { rows.evaluate_plainly(motion.values(), to.data()); });
    print("positions, times as fast as OpenSubdiv's EvalStencils", opensubdiv / one, '>', 25);
    print("positions, times as fast as a plain loop over rows", plain / one, '>', 7);
  } else {
    print("positions, to those of 527,252 points", ns / ns_before, '<', 1.1);
  }
  print("positions, normals, determinants, to positions", with_normals / one, '<', 2.5);
  if (n > 100000) {
    print("two threads, times as fast as one", one / two, '>', 1.8);
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
      n > 1000000 ? 12 : 60, [&] { evaluator.evaluate(motion, {.points = points}); },
      [&] { std::memcpy(to.data(), from.data(), 24 * n); },
      [&] { std::memcpy(to.data(), from.data(), 12 * n); });
  fmt::print("trilinear, {} points: {:.2f} ns a point; {:.2f} memcpys of 12 bytes\n", n,
             evaluating / static_cast<double>(n) * 1e9, evaluating / copying_half);
  print("positions, to a memcpy of 24 bytes a point", evaluating / copying, '<', 2.2);
}

}  // namespace

void bench_evaluation(std::size_t max_points) {
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
    if (n <= max_points) {
      ns = bench_tricubic(n, peak, ns);
      bench_trilinear(n);
    }
  }
  set_thread_count(0);
}

}  // namespace espalier
