// How long it takes to make a lattice round a model.

#include <fmt/format.h>

#include "deform/fit/wrap.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/deform/surfaces.h"

namespace espalier::bench {

void bench_fitting() {
  constexpr int kPointsRound = 224;  // squared: 50,176
  const Model torus = test::torus_surface(2, 0.6, kPointsRound).model();
  set_thread_count(2);
  for (const int n : {8, 16, 24}) {
    std::size_t n_cells = 0;
    const double time = seconds([&] { n_cells = wrap(torus, n).lattice.complex->n_cells(); }, 2);
    print_mark(fmt::format("wrap {} points, {} along: {} cells, s on two threads",
                           torus.points().size(), n, n_cells),
               time, '<', 5);
  }
  set_thread_count(0);
}

}  // namespace espalier::bench
