// How fast the vertices of a refined lattice follow its control points, beside OpenSubdiv's CPU
// evaluator and plain loops over the same weights.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lattice/build/primitives.h"
#include "lattice/core/instruction_set.h"
#include "lattice/subdivision/refine.h"
#include "lattice/volume/stencil_blocks.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/bench/weight_rows.h"
#include "tests/support/families.h"

namespace espalier::bench {
namespace {

/// The vertices after so many refinements, over the lattice's own.
StencilTable refined_vertices(const SubdivisionLattice& lattice, int levels) {
  SubdivisionLattice current = lattice;
  StencilTable table;
  for (int level = 0; level < levels; ++level) {
    const Sharpness sharpness = with_touching_elements(*current.complex, current.sharpness);
    const Refinement finer = refine(*current.complex, sharpness, current.scheme);
    table = level == 0 ? finer.stencils : compose(table, finer.stencils);
    current = refined(current, 1);
  }
  return table;
}

/// The rows with at least so many weights.
StencilTable long_rows(const StencilTable& table, std::size_t n_weights) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    if (table[i].indices.size() >= n_weights) {
      kept.push_back(i);
    }
  }
  return StencilTable::build(kept.size(), table.n_controls(), [&](std::size_t i, StencilRow& row) {
    const StencilTable::Row from = table[kept[i]];
    for (std::size_t k = 0; k < from.indices.size(); ++k) {
      row.add(from.indices[k], from.weights[k]);
    }
  });
}

void bench_table(const std::string& name, const StencilTable& table) {
  set_thread_count(1);
  WeightRows rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    rows.add(table[i].indices, table[i].weights);
  }
  std::vector<float> of_four(4 * table.n_controls());
  std::vector<float> to_four(4 * table.n_rows());
  std::vector<glm::vec3> controls(table.n_controls());
  std::vector<glm::dvec3> exact_controls(table.n_controls());
  for (std::size_t i = 0; i < table.n_controls(); ++i) {
    controls[i] = {0.1F * static_cast<float>(i % 7), 0.2F * static_cast<float>(i % 5), 1};
    exact_controls[i] = controls[i];
    std::copy_n(&controls[i].x, 3, of_four.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  std::vector<glm::vec3> points(table.n_rows());
  std::vector<glm::dvec3> exact_points(table.n_rows());
  const double preparing = seconds([&] { const StencilBlocks<float> made(table); });
  const StencilBlocks<float> blocks(table);
  const StencilBlocks<double> exact_blocks(table);
  const auto [ours, exact, opensubdiv, plain, exact_plain] = best_seconds(
      100, [&] { blocks.apply(controls, points); },
      [&] { exact_blocks.apply(exact_controls, exact_points); },
      [&] { rows.apply_as_opensubdiv(of_four.data(), to_four.data()); },
      [&] { rows.apply_plainly(of_four.data(), to_four.data()); },
      [&] { exact_points = table.apply(exact_controls); });
  const auto n_weights = static_cast<double>(table.n_weights());
  fmt::print("re-posing {}: {} vertices of {:.1f} weights, {:.0f} µs\n", name, table.n_rows(),
             n_weights / static_cast<double>(table.n_rows()), ours * 1e6);
  print_mark("times as fast as OpenSubdiv's EvalStencils", opensubdiv / ours, '>', 10);
  print_mark("times as fast as a plain loop over rows", plain / ours, '>', 2.5);
  print("in double, times as fast as StencilTable::apply", exact_plain / exact, "times");
  print("products, to the table's", static_cast<double>(blocks.n_products()) / n_weights, "times");
  print("bytes, to a weight and an index for each of the table's",
        static_cast<double>(blocks.bytes()) / (8 * n_weights), "times");
  print("preparing, to one product", preparing / ours, "products");
}

}  // namespace

void bench_reposing() {
  fmt::print("re-posing in float, {}, one thread\n", name_of(instruction_set()));
  const SubdivisionLattice box = test::lattice_from(make_box({4, 4, 3}, {0, 0, 0}, {1, 1, 1}));
  const StencilTable limb = refined_vertices(test::prism(test::o_grid_section(), 8), 3);
  bench_table("the inside of an O-grid limb", long_rows(limb, 27));
  bench_table("a whole O-grid limb", limb);
  bench_table("a box", refined_vertices(box, 3));
  set_thread_count(0);
}

}  // namespace espalier::bench
