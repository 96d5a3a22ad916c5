#include "deform/fit/element_grid.h"

#include <algorithm>
#include <cmath>

#include "deform/fit/surface_triangles.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

/// Beyond so many solid angles the pockets left over count as inside unseen.
constexpr std::size_t kMostAngles = 4'000'000'000;

/// Calls visit(element) for all that a triangle touches.
template <class Visit>
void visit_touched(const GridFrame& frame, const Triangle& triangle, double margin,
                   const Visit& visit) {
  const double reach = margin * frame.step;
  std::array<int, 3> from{};
  std::array<int, 3> to{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto [low, high] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
    const double first = std::floor((low - reach - frame.origin[axis]) / frame.step);
    const double last = std::floor((high + reach - frame.origin[axis]) / frame.step);
    from[a] = static_cast<int>(std::clamp(2 * first, 0.0, frame.n_places(axis) - 1.0));
    to[a] = static_cast<int>(std::clamp(2 * last + 2, 0.0, frame.n_places(axis) - 1.0));
  }
  ElementPlace place{};
  for (place[2] = from[2]; place[2] <= to[2]; ++place[2]) {
    for (place[1] = from[1]; place[1] <= to[1]; ++place[1]) {
      for (place[0] = from[0]; place[0] <= to[0]; ++place[0]) {
        const glm::dvec3 centre = frame.center(place);
        const glm::dvec3 half =
            glm::dvec3(place[0] % 2, place[1] % 2, place[2] % 2) * (0.5 * frame.step) + reach;
        if (overlaps(triangle, centre - half, centre + half)) {
          visit(frame.index(place));
        }
      }
    }
  }
}

std::vector<char> touched_elements(const GridFrame& frame, std::span<const Triangle> triangles,
                                   double margin) {
  constexpr std::size_t kGrain = 4096;
  std::vector<std::vector<std::size_t>> found((triangles.size() + kGrain - 1) / kGrain);
  parallel_ranges(triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    auto& mine = found[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      visit_touched(frame, triangles[i], margin,
                    [&](std::size_t element) { mine.push_back(element); });
    }
    std::sort(mine.begin(), mine.end());
    mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
  });
  std::vector<char> is_touched(frame.n_elements(), 0);
  for (const auto& elements : found) {
    for (const std::size_t element : elements) {
      is_touched[element] = 1;
    }
  }
  return is_touched;
}

/// Parts of what is not touched.
struct Pockets {
  std::vector<std::int32_t> of;    // #elements, -1: touched
  std::vector<std::size_t> seeds;  // #pockets: an element of each
};

void flood(const GridFrame& frame, std::size_t seed, std::int32_t pocket,
           std::vector<std::int32_t>& of) {
  std::vector<std::size_t> waiting = {seed};
  of[seed] = pocket;
  while (!waiting.empty()) {
    const ElementPlace at = frame.place(waiting.back());
    waiting.pop_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int way : {-1, 1}) {
        ElementPlace next = at;
        next[axis] += way;
        if (!frame.contains(next)) {
          continue;
        }
        const std::size_t element = frame.index(next);
        if (of[element] == -2) {
          of[element] = pocket;
          waiting.push_back(element);
        }
      }
    }
  }
}

/// The first pocket is what lies outside, at the grid's corner.
Pockets find_pockets(const GridFrame& frame, const std::vector<char>& is_touched) {
  Pockets pockets;
  pockets.of.resize(is_touched.size());
  for (std::size_t i = 0; i < is_touched.size(); ++i) {
    pockets.of[i] = is_touched[i] != 0 ? -1 : -2;
  }
  for (std::size_t i = 0; i < pockets.of.size(); ++i) {
    if (pockets.of[i] == -2) {
      flood(frame, i, static_cast<std::int32_t>(pockets.seeds.size()), pockets.of);
      pockets.seeds.push_back(i);
    }
  }
  return pockets;
}

}  // namespace

ElementPlace GridFrame::place(std::size_t index) const {
  const auto nx = static_cast<std::size_t>(n_places(0));
  const auto ny = static_cast<std::size_t>(n_places(1));
  return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
          static_cast<int>(index / (nx * ny))};
}

ElementPlace GridFrame::cell_at(const glm::dvec3& point) const {
  ElementPlace place{};
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor((point[axis] - origin[axis]) / step);
    place[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::clamp(2 * cell + 1, 1.0, n_places(axis) - 2.0));
  }
  return place;
}

ElementGrid classify_elements(const GridFrame& frame, std::span<const Triangle> triangles,
                              bool is_closed, double margin, const Progress& progress) {
  progress.update("wrap", 0.0);
  ElementGrid grid{frame, touched_elements(frame, triangles, margin), {}};
  const Pockets pockets = find_pockets(frame, grid.is_touched);
  std::vector<char> is_inside(pockets.seeds.size(), 1);
  is_inside[0] = 0;
  const std::size_t n_seen =
      is_closed
          ? std::min(is_inside.size(), kMostAngles / std::max<std::size_t>(triangles.size(), 1))
          : 0;
  parallel_for(
      n_seen,
      [&](std::size_t i) {
        const glm::dvec3 place = frame.center(frame.place(pockets.seeds[i]));
        if (i > 0 && std::abs(winding_number(place, triangles)) < 0.5) {
          is_inside[i] = 0;
        }
      },
      1);
  grid.is_inside.resize(frame.n_elements());
  for (std::size_t i = 0; i < grid.is_inside.size(); ++i) {
    grid.is_inside[i] = pockets.of[i] >= 0 ? is_inside[static_cast<std::size_t>(pockets.of[i])] : 0;
  }
  progress.update("wrap", 0.2);
  return grid;
}

}  // namespace espalier
