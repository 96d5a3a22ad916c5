// Certificates, of rational patches too, against evaluation on a grid, and the largest step of one
// control point.

#include <benchmark/benchmark.h>

#include "deform/injectivity/injectivity.h"
#include "lattice/volume/bezier_evaluator.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

constexpr std::size_t kSamples = 9;
constexpr std::size_t kOrder = 4;

/// One axis at a time: out[·, s] = Σ_i in[·, i] basis_i(s), n_inner values to a step, axis last in
/// memory becomes first: three rounds bring u, v, w back in order.
void contract_grid(const double* in, std::size_t n_inner, std::size_t n_outer, const double* basis,
                   double* out) {
  for (std::size_t o = 0; o < n_outer; ++o) {
    for (std::size_t s = 0; s < kSamples; ++s) {
      contract(in + o * kOrder * n_inner, basis + s * kOrder, kOrder, n_inner,
               out + (o * kSamples + s) * n_inner);
    }
  }
}

/// The determinant on a 9 × 9 × 9 grid by sum factorisation, w first.
struct GridDeterminant {
  std::array<double, kSamples * kOrder> values{};
  std::array<double, kSamples * kOrder> slopes{};
  std::vector<double> w_v, w_s, vv, vs, sv, u, v, w, determinants;

  GridDeterminant()
      : w_v(48 * 9),
        w_s(48 * 9),
        vv(12 * 81),
        vs(12 * 81),
        sv(12 * 81),
        u(3 * 729),
        v(3 * 729),
        w(3 * 729),
        determinants(729) {
    for (std::size_t s = 0; s < kSamples; ++s) {
      bernstein_basis(3, static_cast<double>(s) / 8, &values[s * kOrder], &slopes[s * kOrder]);
    }
  }

  void run(const BezierPatch& patch) {
    const double* points = glm::value_ptr(patch.points[0]);
    contract_grid(points, 48, 1, values.data(), w_v.data());
    contract_grid(points, 48, 1, slopes.data(), w_s.data());
    contract_grid(w_v.data(), 12, 9, values.data(), vv.data());
    contract_grid(w_v.data(), 12, 9, slopes.data(), vs.data());
    contract_grid(w_s.data(), 12, 9, values.data(), sv.data());
    contract_grid(vv.data(), 3, 81, slopes.data(), u.data());
    contract_grid(vs.data(), 3, 81, values.data(), v.data());
    contract_grid(sv.data(), 3, 81, values.data(), w.data());
    for (std::size_t i = 0; i < 729; ++i) {
      const double* a = &u[3 * i];
      const double* b = &v[3 * i];
      const double* c = &w[3 * i];
      determinants[i] = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
};

void determinant_on_a_grid(benchmark::State& state) {
  const BezierPatch patch = test::warped_cube({3, 3, 3}, 0.05, 1);
  GridDeterminant grid;
  for (auto _ : state) {
    grid.run(patch);
    benchmark::DoNotOptimize(grid.determinants.data());
  }
}
BENCHMARK(determinant_on_a_grid);

void certificate_of_a_tricubic_patch(benchmark::State& state) {
  const BezierPatch patch = test::warped_cube({3, 3, 3}, 0.02, 1);
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  for (auto _ : state) {
    nets.determinant(patch, {}, 1e-16, polynomial);
    const Positivity found = positivity(polynomial, 1);
    if (found.verdict != Verdict::Certified) {
      state.SkipWithError("needs subdivision");
    }
  }
}
BENCHMARK(certificate_of_a_tricubic_patch);

void certificate_of_a_rational_tricubic_patch(benchmark::State& state) {
  const BezierPatch patch = test::warped_cube({3, 3, 3}, 0.02, 1);
  std::vector<glm::dvec4> points;
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const double weight = i % 3 == 0 ? 1.05 : 1;
    points.emplace_back(weight * patch.points[i], weight);
  }
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  for (auto _ : state) {
    nets.rational_determinant({patch.degree, points, glm::dvec4(1e-16)}, {}, polynomial);
    const Positivity found = positivity(polynomial, 1);
    if (found.verdict != Verdict::Certified) {
      state.SkipWithError("needs subdivision");
    }
  }
}
BENCHMARK(certificate_of_a_rational_tricubic_patch);

void largest_step_of_a_drag(benchmark::State& state) {
  const auto controls = test::grid_points({8, 8, 8});
  const InjectivityCheck check(
      std::make_shared<const Volume>(test::spline_volume({8, 8, 8}, controls)));
  std::vector<glm::dvec3> motion(controls.size(), glm::dvec3(0));
  motion[4 + 9 * (4 + 9 * 4)] = state.range(0) == 0   ? glm::dvec3(1, 0, 0)
                                : state.range(0) == 1 ? glm::dvec3(1, 1, 0)
                                                      : glm::dvec3(1, 1, 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(check.largest_step(controls, motion).step);
  }
}
BENCHMARK(largest_step_of_a_drag)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace espalier

BENCHMARK_MAIN();
