#include "deform/embed/thb_region.h"

#include <fmt/format.h>

#include <algorithm>

#include "deform/embed/embed.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

constexpr int kMostRings = 16;
constexpr std::size_t kMostRefined = std::size_t{1} << 17;  // cells, each made eight

/// Refuses before the lattice grows.
void require_few(std::size_t n_cells, int level) {
  if (n_cells > kMostRefined) {
    throw ParameterError(
        fmt::format("level {} would refine {} cells, at most {} are refined at once: take fewer "
                    "rings or levels",
                    level, n_cells, kMostRefined));
  }
}

}  // namespace

std::vector<glm::dvec3> places_of_points(const ThbLattice& lattice,
                                         std::span<const glm::dvec3> points,
                                         const Progress& progress) {
  const Binding binding = embed(freeze(lattice), points, progress);
  return places_in_whole(*lattice.hierarchy, lattice.hierarchy->leaves(), binding.patches,
                         binding.uvw);
}

std::vector<GridIndex> with_rings(std::span<const GridIndex> cells,
                                  const std::array<int, 3>& n_cells, int n_rings) {
  std::vector<GridIndex> result(cells.begin(), cells.end());
  for (std::size_t axis = 0; axis < 3; ++axis) {  // one at a time: a box is made of lines
    std::vector<GridIndex> grown;
    for (const GridIndex& cell : result) {
      const int last = std::min(cell[axis] + n_rings, n_cells[axis] - 1);
      for (std::int32_t at = std::max(cell[axis] - n_rings, 0); at <= last; ++at) {
        grown.push_back(
            {axis == 0 ? at : cell.i, axis == 1 ? at : cell.j, axis == 2 ? at : cell.k});
      }
    }
    std::sort(grown.begin(), grown.end());
    grown.erase(std::unique(grown.begin(), grown.end()), grown.end());
    result = std::move(grown);
  }
  return result;
}

ThbLattice refined_under(const ThbLattice& lattice, std::span<const glm::dvec3> points, int level,
                         int n_rings, const Progress& progress) {
  if (level < 1 || level >= kMostThbLevels) {
    throw ParameterError(
        fmt::format("the level is {}, must be 1 to {}", level, kMostThbLevels - 1));
  }
  if (n_rings < 0 || n_rings > kMostRings) {
    throw ParameterError(fmt::format("{} rings of cells, must be 0 to {}", n_rings, kMostRings));
  }
  const std::vector<glm::dvec3> places = places_of_points(lattice, points, progress);
  if (places.empty()) {
    throw ParameterError("none of the points lies in the lattice");
  }
  ThbLattice result = lattice;
  for (int next = 1; next <= level; ++next) {
    const std::vector<GridIndex> cells = cells_holding(*result.hierarchy, next, places);
    const auto all = with_rings(cells, result.hierarchy->n_cells(next - 1), n_rings);
    require_few(all.size(), next);
    result = with_cells(result, next, all);
  }
  return result;
}

}  // namespace espalier
