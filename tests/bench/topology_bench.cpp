// How fast complexes are built and refined, as ratios to sorting and to copying memory.

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "lattice/build/primitives.h"
#include "lattice/core/index_order.h"
#include "lattice/core/parallel.h"
#include "lattice/subdivision/refine.h"
#include "lattice/topology/cell_complex.h"
#include "tests/bench/sections.h"
#include "tests/bench/timing.h"
#include "tests/support/families.h"

namespace espalier::bench {
namespace {

std::size_t heap_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

using HexahedronCorners = std::array<std::int32_t, 8>;

/// A grid of n³ cells, cells and vertices numbered at random.
std::vector<HexahedronCorners> shuffled_grid(int n, std::int32_t& n_vertices) {
  const auto side = static_cast<std::int32_t>(n + 1);
  n_vertices = side * side * side;
  std::vector<std::int32_t> number(static_cast<std::size_t>(n_vertices));
  std::iota(number.begin(), number.end(), 0);
  std::mt19937 random(1);
  std::shuffle(number.begin(), number.end(), random);
  std::vector<HexahedronCorners> cells;
  for (std::int32_t k = 0; k < n; ++k) {
    for (std::int32_t j = 0; j < n; ++j) {
      for (std::int32_t i = 0; i < n; ++i) {
        HexahedronCorners& corners = cells.emplace_back();
        for (std::int32_t c = 0; c < 8; ++c) {
          const std::int32_t at = i + c % 2 + side * (j + c / 2 % 2 + side * (k + c / 4));
          corners[static_cast<std::size_t>(c)] = number[static_cast<std::size_t>(at)];
        }
      }
    }
  }
  std::shuffle(cells.begin(), cells.end(), random);
  return cells;
}

/// Seconds to sort the cells' faces by their sorted vertices: what matching faces cannot do without
/// in one way or another.
double sort_seconds(const std::vector<HexahedronCorners>& cells) {
  using Key = std::array<std::int32_t, 4>;
  std::vector<Key> keys;
  keys.reserve(cells.size() * 6);
  for (const HexahedronCorners& cell : cells) {
    for (const auto& face : kHexahedronFaces) {
      Key key{};
      std::transform(face.begin(), face.end(), key.begin(),
                     [&](int corner) { return cell[static_cast<std::size_t>(corner)]; });
      std::sort(key.begin(), key.end());
      keys.push_back(key);
    }
  }
  return seconds([&] { std::sort(keys.begin(), keys.end()); }, 1);
}

void bench_complex(int n) {
  std::int32_t n_vertices = 0;
  const std::vector<HexahedronCorners> cells = shuffled_grid(n, n_vertices);
  const auto n_cells = static_cast<double>(cells.size());
  fmt::print("cell complex of {} hexahedra in random order\n", cells.size());
  const std::size_t heap_before = heap_in_use();
  {
    const CellComplex complex(match_faces(hexahedron_loops(n_vertices, cells)));
    print("bytes a cell, by its own count", static_cast<double>(complex.bytes()) / n_cells, "B");
    print("bytes a cell, on the heap", static_cast<double>(heap_in_use() - heap_before) / n_cells,
          "B");
  }
  for (const int threads : {1, 0}) {
    set_thread_count(threads);
    const std::string with =
        threads == 1 ? ", one thread" : fmt::format(", {} threads", thread_count());
    const double sort = sort_seconds(cells);
    const CellLoops loops = hexahedron_loops(n_vertices, cells);
    Polyhedra tables;
    const double match = seconds([&] { tables = match_faces(loops); });
    const double check = seconds([&] { const CellComplex complex(tables); });
    const double build = seconds([&] { const auto complex = CellComplex::from_valid(tables); });
    print("match faces, to one std::sort of their keys" + with, match / sort, "sorts");
    print("build, unchecked" + with, build / sort, "sorts");
    print("build, checked" + with, check / sort, "sorts");
    print("match and build, checked" + with, (match + check) / sort, "sorts");
  }
}

void bench_refine(const std::string& name, const SubdivisionLattice& lattice, int levels) {
  const SubdivisionLattice coarse = refined(lattice, levels - 1);
  const Sharpness sharpness = with_touching_elements(*coarse.complex, coarse.sharpness);
  Refinement level;
  const auto refine_once = [&] { level = refine(*coarse.complex, sharpness, coarse.scheme); };
  refine_once();
  fmt::print("refine {}, level {} of {} cells\n", name, levels, level.complex->n_cells());
  const auto n_cells = static_cast<double>(level.complex->n_cells());
  for (const int threads : {1, 0}) {
    set_thread_count(threads);
    const std::string with =
        threads == 1 ? ", one thread" : fmt::format(", {} threads", thread_count());
    const double refining = seconds(refine_once);
    const Polyhedra tables = level.complex->polyhedra();
    const double build = seconds([&] { const auto complex = CellComplex::from_valid(tables); });
    const std::size_t bytes = level.complex->bytes() + level.stencils.bytes();
    print("microseconds a child" + with, refining / n_cells * 1e6, "µs");
    print("to building its complex alone" + with, refining / build, "builds");
    print("to copying what it makes" + with, refining / copy_seconds(bytes), "copies");
    std::vector<glm::dvec3> points;
    const double apply = seconds([&] { points = level.stencils.apply(coarse.rest); });
    const std::size_t traffic = level.stencils.bytes() + points.size() * sizeof(glm::dvec3);
    print("stencils, to copying them and their points" + with, apply / copy_seconds(traffic),
          "copies");
  }
}

}  // namespace

void bench_topology() {
  bench_complex(100);
  CylinderOptions cylinder;
  cylinder.sectors = 5;
  cylinder.layers = 3;
  bench_refine("a cylinder of 15 wedges", test::lattice_from(make_cylinder(cylinder)), 5);
  bench_refine("a grid of 216 cubes", test::lattice_from(make_box({6, 6, 6}, {0, 0, 0}, {1, 1, 1})),
               3);
}

}  // namespace espalier::bench
