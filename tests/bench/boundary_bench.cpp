// The boundary of a grid of 40 × 40 × 40 cells, bent, against the local certificate of its inside.

#include <cmath>
#include <memory>

#include "deform/injectivity/boundary.h"
#include "deform/injectivity/injectivity.h"
#include "tests/bench/timing.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

void run() {
  constexpr int kCells = 40;
  set_thread_count(1);
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
    const auto [boundary, local] = bench::best_seconds(
        1, [&] { report = check_boundary(*volume, pose); },
        [&] { static_cast<void>(check.local(pose)); });
    fmt::print(
        "bent by {} rad: {} faces in {:.3f} s, {:.2f} of the local certificate; {} crossings, "
        "{} undecided\n",
        angle, report.n_faces, boundary, boundary / local, report.crossings.size(),
        report.undecided.size());
  }
}

}  // namespace
}  // namespace espalier

int main() {
  espalier::run();
}
