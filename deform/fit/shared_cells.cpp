#include "deform/fit/shared_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr int kFiner = 3;
constexpr std::size_t kMostFineElements = 300'000'000;
constexpr double kFineMargin = 0.01;
constexpr int kBlock = 3 * kFiner;  // fine cells across a cell's block

/// A cell that parts share, and how many fine cells lie between the parts.
struct SharedCell {
  ElementPlace place;
  int n_between;
};

/// The fine cells of the block round one cell, and which of them are joined.
class Block {
 public:
  Block(const CellSet& coarse, const CellSet& fine, const ElementPlace& place)
      : coarse_(coarse), fine_(fine), place_(place) {
    for (int i = 0; i < kBlock * kBlock * kBlock; ++i) {
      const auto [x, y, z] = at(i);
      const ElementPlace cell = {place[0] + (x / kFiner - 1) * 2, place[1] + (y / kFiner - 1) * 2,
                                 place[2] + (z / kFiner - 1) * 2};
      part_[static_cast<std::size_t>(i)] = coarse.has(cell) && fine.has(fine_place(i)) ? -2 : -1;
    }
  }

  /// The least number of fine cells between two parts in or beside the middle cell; -1: there is
  /// one part.
  int n_between() {
    int n_parts = 0;
    std::vector<int> middle;
    for (int i = 0; i < kBlock * kBlock * kBlock; ++i) {
      if (part_[static_cast<std::size_t>(i)] != -1 && is_of_middle(at(i))) {
        middle.push_back(i);
        n_parts += part_[static_cast<std::size_t>(i)] == -2 ? 1 : 0;
        flood(i, n_parts);
      }
    }
    return n_parts < 2 ? -1 : least_between(middle);
  }

 private:
  static std::array<int, 3> at(int i) {
    return {i % kBlock, i / kBlock % kBlock, i / (kBlock * kBlock)};
  }
  /// Whether a fine cell is in the middle cell, or beside it in a cell that is joined to it: the
  /// margin of a surface there reaches into the cell.
  [[nodiscard]] bool is_of_middle(const std::array<int, 3>& where) const {
    ElementPlace face = place_;
    int n_away = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int away = where[axis] / kFiner - 1;
      const bool is_beside = where[axis] == kFiner - 1 || where[axis] == 2 * kFiner;
      n_away += away == 0 ? 0 : is_beside ? 1 : 2;
      face[axis] += away;
    }
    return n_away == 0 || (n_away == 1 && coarse_.has(face));
  }
  /// Of fine cell i of the block.
  [[nodiscard]] ElementPlace fine_place(int i) const {
    const auto where = at(i);
    ElementPlace place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = 2 * ((place_[axis] / 2 - 1) * kFiner + where[axis]) + 1;
    }
    return place;
  }

  void flood(int seed, int part) {
    if (part_[static_cast<std::size_t>(seed)] != -2) {
      return;
    }
    std::vector<int> waiting = {seed};
    part_[static_cast<std::size_t>(seed)] = part;
    while (!waiting.empty()) {
      const int i = waiting.back();
      waiting.pop_back();
      const auto where = at(i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int stride = axis == 0 ? 1 : axis == 1 ? kBlock : kBlock * kBlock;
        for (const int way : {-1, 1}) {
          const int next = i + way * stride;
          ElementPlace face = fine_place(i);
          face[axis] += way;
          if (where[axis] + way >= 0 && where[axis] + way < kBlock &&
              part_[static_cast<std::size_t>(next)] == -2 && fine_.has(face)) {
            part_[static_cast<std::size_t>(next)] = part;
            waiting.push_back(next);
          }
        }
      }
    }
  }

  [[nodiscard]] int least_between(const std::vector<int>& middle) const {
    int least = kBlock;
    for (const int i : middle) {
      for (const int j : middle) {
        if (part_[static_cast<std::size_t>(i)] != part_[static_cast<std::size_t>(j)]) {
          const auto a = at(i);
          const auto b = at(j);
          least = std::min(
              least,
              std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}) - 1);
        }
      }
    }
    return least;
  }

  const CellSet& coarse_;
  const CellSet& fine_;
  ElementPlace place_;
  std::array<int, kBlock * kBlock * kBlock> part_{};  // -1: no cell, -2: not known yet
};

std::vector<SharedCell> shared_cells(const CellSet& coarse, const CellSet& fine) {
  std::vector<ElementPlace> places;
  for (std::size_t i = 0; i < coarse.frame().n_elements(); ++i) {
    const ElementPlace place = coarse.frame().place(i);
    if (place[0] % 2 + place[1] % 2 + place[2] % 2 == 3 && coarse.has(place)) {
      places.push_back(place);
    }
  }
  std::vector<int> between(places.size());
  parallel_for(
      places.size(),
      [&](std::size_t i) { between[i] = Block(coarse, fine, places[i]).n_between(); }, 16);
  std::vector<SharedCell> shared;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (between[i] >= 0) {
      shared.push_back({places[i], between[i]});
    }
  }
  return shared;
}

/// Cells that touch each other, taken from `left`, beginning with its first.
std::vector<SharedCell> take_neighbours(std::map<ElementPlace, SharedCell>& left) {
  std::vector<SharedCell> group = {left.begin()->second};
  left.erase(left.begin());
  for (std::size_t i = 0; i < group.size(); ++i) {
    const ElementPlace at = group[i].place;
    ElementPlace next{};
    for (next[0] = at[0] - 2; next[0] <= at[0] + 2; next[0] += 2) {
      for (next[1] = at[1] - 2; next[1] <= at[1] + 2; next[1] += 2) {
        for (next[2] = at[2] - 2; next[2] <= at[2] + 2; next[2] += 2) {
          if (const auto found = left.find(next); found != left.end()) {
            group.push_back(found->second);
            left.erase(found);
          }
        }
      }
    }
  }
  return group;
}

}  // namespace

std::vector<SharedPlace> find_shared_places(const CellSet& cells,
                                            std::span<const Triangle> triangles, bool is_closed) {
  GridFrame fine = cells.frame();
  fine.step /= kFiner;
  for (int& n : fine.cells) {
    n *= kFiner;
  }
  if (fine.n_elements() > kMostFineElements) {
    return {};
  }
  const CellSet fine_cells(classify_elements(fine, triangles, is_closed, kFineMargin));
  std::map<ElementPlace, SharedCell> left;
  for (const SharedCell& cell : shared_cells(cells, fine_cells)) {
    left.emplace(cell.place, cell);
  }
  std::vector<SharedPlace> places;
  while (!left.empty()) {
    const std::vector<SharedCell> group = take_neighbours(left);
    SharedPlace& place = places.emplace_back();
    place.n_cells = group.size();
    int n_between = kBlock;
    for (const SharedCell& cell : group) {
      place.center += cells.frame().center(cell.place) / static_cast<double>(group.size());
      n_between = std::min(n_between, cell.n_between);
    }
    place.gap = n_between * fine.step;
  }
  std::stable_sort(places.begin(), places.end(), [](const SharedPlace& a, const SharedPlace& b) {
    return a.n_cells > b.n_cells;
  });
  return places;
}

}  // namespace espalier
