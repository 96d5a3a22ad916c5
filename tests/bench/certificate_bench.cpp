// Certificates, of rational patches too, against evaluation on a grid; the largest step of one
// control point; and the boundary of a bent grid of 40 × 40 × 40 cells.

#include <cmath>
#include <memory>
#include <stdexcept>

#include "deform/injectivity/boundary.h"
#include "deform/injectivity/injectivity.h"
#include "lattice/volume/bezier_evaluator.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/support/spline_volume.h"

namespace espalier::bench {
namespace {

constexpr std::size_t kSamples = 9;
constexpr std::size_t kOrder = 4;
constexpr int kRepeats = 1000;  // of what takes microseconds

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

/// A tricubic patch with weights.
std::vector<glm::dvec4> weighted_points(const BezierPatch& patch) {
  std::vector<glm::dvec4> points;
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const double weight = i % 3 == 0 ? 1.05 : 1;
    points.emplace_back(weight * patch.points[i], weight);
  }
  return points;
}

void certify(BoundedPolynomial& determinant) {
  if (positivity(determinant, 1).verdict != Verdict::Certified) {
    throw std::runtime_error("the patch needs subdivision");
  }
}

void bench_patches() {
  const BezierPatch patch = test::warped_cube({3, 3, 3}, 0.02, 1);
  const std::vector<glm::dvec4> points = weighted_points(patch);
  GridDeterminant grid;
  DeterminantNets nets;
  BoundedPolynomial polynomial;
  const auto repeated = [](const auto& work) {
    return [&work] {
      for (int i = 0; i < kRepeats; ++i) {
        work();
      }
    };
  };
  const auto sample = [&] { grid.run(patch); };
  const auto certify_patch = [&] {
    nets.determinant(patch, {}, 1e-16, polynomial);
    certify(polynomial);
  };
  const auto certify_rational = [&] {
    nets.rational_determinant({patch.degree, points, glm::dvec4(1e-16)}, {}, polynomial);
    certify(polynomial);
  };
  const auto [sampling, certifying, rational] =
      best_seconds(3, repeated(sample), repeated(certify_patch), repeated(certify_rational));
  print("the determinant on a grid of 9 × 9 × 9", sampling / kRepeats * 1e6, "µs");
  print_mark("certificate of a tricubic patch, to that", certifying / sampling, '<', 3);
  print("of a rational one, to that", rational / sampling, "");
}

void bench_largest_steps() {
  const auto controls = test::grid_points({8, 8, 8});
  const InjectivityCheck check(
      std::make_shared<const Volume>(test::spline_volume({8, 8, 8}, controls)));
  std::vector<glm::dvec3> motion(controls.size(), glm::dvec3(0));
  for (const glm::dvec3 by : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 1)}) {
    motion[4 + 9 * (4 + 9 * 4)] = by;
    const auto [step] =
        best_seconds(3, [&] { static_cast<void>(check.largest_step(controls, motion)); });
    print_mark(fmt::format("largest step of one control point by ({}, {}, {}), in milliseconds",
                           by.x, by.y, by.z),
               1000 * step, '<', 2);
  }
}

void bench_boundary() {
  constexpr int kCells = 40;
  const auto volume = std::make_shared<const Volume>(
      test::spline_volume({kCells, kCells, kCells}, test::grid_points({kCells, kCells, kCells})));
  const InjectivityCheck check(volume);
  for (const double angle : {0.5, 3.0, 7.0}) {
    std::vector<glm::dvec3> pose(volume->rest_controls().begin(), volume->rest_controls().end());
    for (glm::dvec3& p : pose) {
      const double turn = p.x * angle / kCells;
      const double radius = p.y + kCells / angle;
      p = {radius * std::sin(turn), radius * std::cos(turn), p.z};
    }
    BoundaryReport report;
    const auto [boundary, local] = best_seconds(
        1, [&] { report = check_boundary(*volume, pose); },
        [&] { static_cast<void>(check.local(pose)); });
    print(fmt::format("{} boundary faces bent by {}: {} cross, {} undecided, to the inside",
                      report.n_faces, angle, report.crossings.size(), report.undecided.size()),
          boundary / local, "");
  }
}

}  // namespace

void bench_certificates() {
  set_thread_count(1);
  bench_patches();
  bench_largest_steps();
  bench_boundary();
  set_thread_count(0);
}

}  // namespace espalier::bench
