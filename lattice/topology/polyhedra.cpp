#include "lattice/topology/polyhedra.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>
#include <utility>

#include "lattice/core/ids.h"
#include "lattice/core/index_order.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

using Loop = std::span<const std::int32_t>;

std::size_t position_of_smallest(Loop loop) {
  return static_cast<std::size_t>(std::min_element(loop.begin(), loop.end()) - loop.begin());
}

/// The two neighbours of a loop's smallest vertex, the smaller first: with that vertex a key that
/// only equal faces share, but for odd cases that same_face() separates.
std::uint64_t neighbour_key(Loop loop) {
  const std::size_t at = position_of_smallest(loop);
  const auto next = static_cast<std::uint32_t>(loop[(at + 1) % loop.size()]);
  const auto previous = static_cast<std::uint32_t>(loop[(at + loop.size() - 1) % loop.size()]);
  return std::uint64_t{std::min(next, previous)} << 32 | std::max(next, previous);
}

/// Whether two loops visit the same vertices in the same or in the opposite cyclic order.
bool same_face(Loop a, Loop b, bool& is_reversed) {
  const std::size_t n = a.size();
  if (n != b.size()) {
    return false;
  }
  bool is_equal = true;
  bool is_opposite = true;
  std::size_t forward = position_of_smallest(b);
  std::size_t backward = forward;
  for (std::size_t i = 0, at = position_of_smallest(a); i < n; ++i) {
    is_equal = is_equal && a[at] == b[forward];
    is_opposite = is_opposite && a[at] == b[backward];
    at = at + 1 < n ? at + 1 : 0;
    forward = forward + 1 < n ? forward + 1 : 0;
    backward = backward > 0 ? backward - 1 : n - 1;
  }
  is_reversed = is_opposite && !is_equal;
  return is_equal || is_opposite;
}

/// A loop in the bucket of its smallest vertex.
struct BucketEntry {
  std::uint64_t key;
  std::uint32_t loop;
  auto operator<=>(const BucketEntry&) const = default;
};

/// Loops sorted into buckets by smallest vertex, each bucket sorted by key.
std::vector<BucketEntry> sort_into_buckets(const CellLoops& cells,
                                           std::vector<std::uint32_t>& bucket_begin) {
  const std::size_t n_loops = cells.loops.n_rows();
  std::vector<std::int32_t> smallest(n_loops);
  parallel_for(n_loops, [&](std::size_t i) {
    const Loop loop = cells.loops[i];
    smallest[i] = *std::min_element(loop.begin(), loop.end());
  });
  bucket_begin.assign(static_cast<std::size_t>(cells.n_vertices) + 1, 0);
  for (const std::int32_t vertex : smallest) {
    ++bucket_begin[static_cast<std::size_t>(vertex) + 1];
  }
  std::partial_sum(bucket_begin.begin(), bucket_begin.end(), bucket_begin.begin());
  std::vector<BucketEntry> entries(n_loops);
  std::vector<std::uint32_t> fill(bucket_begin.begin(), bucket_begin.end() - 1);
  for (std::uint32_t i = 0; i < n_loops; ++i) {
    entries[fill[static_cast<std::size_t>(smallest[i])]++] = {neighbour_key(cells.loops[i]), i};
  }
  parallel_for(fill.size(), [&](std::size_t vertex) {
    std::sort(entries.begin() + bucket_begin[vertex], entries.begin() + bucket_begin[vertex + 1]);
  });
  return entries;
}

/// The first loop that is the same face, and whether it runs the other way.
struct Match {
  std::uint32_t first;
  bool is_reversed;
};

/// For every loop its match.
std::vector<Match> find_matches(const CellLoops& cells) {
  std::vector<std::uint32_t> bucket_begin;
  const std::vector<BucketEntry> entries = sort_into_buckets(cells, bucket_begin);
  std::vector<Match> matches(entries.size());
  parallel_for(bucket_begin.size() - 1, [&](std::size_t vertex) {
    for (std::size_t i = bucket_begin[vertex]; i < bucket_begin[vertex + 1]; ++i) {
      const BucketEntry& entry = entries[i];
      Match& match = matches[entry.loop] = {entry.loop, false};
      for (std::size_t j = i; j-- > bucket_begin[vertex] && entries[j].key == entry.key;) {
        const std::uint32_t first = matches[entries[j].loop].first;
        bool is_reversed = false;
        if (same_face(cells.loops[first], cells.loops[entry.loop], is_reversed)) {
          match = {first, is_reversed};
          break;
        }
      }
    }
  });
  return matches;
}

/// One use of an edge by one of a cell's half-faces.
struct EdgeUse {
  std::int32_t low;
  std::int32_t high;
  std::uint32_t place;  // of the half-face in the cell's row
  bool is_ascending;    // the face's loop, as stored, runs from low to high
};

/// All edge uses of a cell's faces as stored, sorted by edge.
void collect_edge_uses(const Polyhedra& polyhedra, std::size_t cell, std::vector<EdgeUse>& uses) {
  uses.clear();
  const auto half_faces = polyhedra.cells[cell];
  for (std::uint32_t place = 0; place < half_faces.size(); ++place) {
    const Loop loop = polyhedra.faces[static_cast<std::size_t>(half_faces[place] >> 1)];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t from = loop[i];
      const std::int32_t to = loop[(i + 1) % loop.size()];
      uses.push_back({std::min(from, to), std::max(from, to), place, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.place) < std::tie(b.low, b.high, b.place);
  });
}

/// Sets the sides of a cell's half-faces so that neighbours run against each other along their
/// edge; the first half-face of each connected shell gets side 0.
void orient_shell(Polyhedra& polyhedra, std::size_t cell, std::vector<EdgeUse>& uses) {
  collect_edge_uses(polyhedra, cell, uses);
  const auto half_faces = polyhedra.cells[cell];
  struct Link {
    std::uint32_t from;
    std::uint32_t to;
    bool flips;
  };
  std::vector<Link> links;
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    const EdgeUse& a = uses[i];
    const EdgeUse& b = uses[i + 1];
    if (a.low == b.low && a.high == b.high) {
      const bool flips = a.is_ascending == b.is_ascending;
      links.push_back({a.place, b.place, flips});
      links.push_back({b.place, a.place, flips});
    }
  }
  std::sort(links.begin(), links.end(),
            [](const Link& a, const Link& b) { return a.from < b.from; });
  std::vector<int> side(half_faces.size(), -1);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t start = 0; start < side.size(); ++start) {
    if (side[start] >= 0) {
      continue;
    }
    side[start] = 0;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      auto link = std::lower_bound(links.begin(), links.end(), at,
                                   [](const Link& l, std::uint32_t from) { return l.from < from; });
      for (; link != links.end() && link->from == at; ++link) {
        if (side[link->to] < 0) {
          side[link->to] = side[at] ^ static_cast<int>(link->flips);
          stack.push_back(link->to);
        }
      }
    }
  }
  for (std::size_t i = 0; i < side.size(); ++i) {
    half_faces[i] = (half_faces[i] & ~1) | side[i];
  }
}

void flip_cell(Polyhedra& polyhedra, std::size_t cell) {
  for (std::int32_t& half_face : polyhedra.cells[cell]) {
    half_face ^= 1;
  }
}

/// The cells that use each face, two at most; -1 none.
std::vector<std::array<std::int32_t, 2>> cells_of_faces(const Polyhedra& polyhedra) {
  std::vector<std::array<std::int32_t, 2>> users(polyhedra.faces.n_rows(), {-1, -1});
  for (std::size_t cell = 0; cell < polyhedra.cells.n_rows(); ++cell) {
    for (const std::int32_t half_face : std::as_const(polyhedra).cells[cell]) {
      auto& user = users[static_cast<std::size_t>(half_face >> 1)];
      user[user[0] < 0 ? 0 : 1] = static_cast<std::int32_t>(cell);
    }
  }
  return users;
}

int side_in_cell(const Polyhedra& polyhedra, std::size_t cell, std::int32_t face) {
  for (const std::int32_t half_face : polyhedra.cells[cell]) {
    if (half_face >> 1 == face) {
      return half_face & 1;
    }
  }
  return -1;
}

/// Flips cells until neighbours lie on opposite sides of their faces; returns the face-connected
/// parts.
std::vector<std::vector<std::size_t>> orient_neighbours(Polyhedra& polyhedra) {
  const auto users = cells_of_faces(polyhedra);
  std::vector<bool> is_reached(polyhedra.cells.n_rows(), false);
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t start = 0; start < is_reached.size(); ++start) {
    if (is_reached[start]) {
      continue;
    }
    is_reached[start] = true;
    std::vector<std::size_t> part = {start};
    for (std::size_t at = 0; at < part.size(); ++at) {
      const std::size_t cell = part[at];
      for (const std::int32_t half_face : std::as_const(polyhedra).cells[cell]) {
        const auto& user = users[static_cast<std::size_t>(half_face >> 1)];
        const std::int32_t other = user[0] == static_cast<std::int32_t>(cell) ? user[1] : user[0];
        if (other < 0 || is_reached[static_cast<std::size_t>(other)]) {
          continue;
        }
        const auto neighbour = static_cast<std::size_t>(other);
        if (side_in_cell(polyhedra, neighbour, half_face >> 1) == (half_face & 1)) {
          flip_cell(polyhedra, neighbour);
        }
        is_reached[neighbour] = true;
        part.push_back(neighbour);
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

CellLoops hexahedron_loops(std::int32_t n_vertices,
                           std::span<const std::array<std::int32_t, 8>> cells) {
  std::vector<std::int32_t> vertices(cells.size() * 24);
  std::vector<std::uint32_t> offsets(cells.size() + 1);
  parallel_for(cells.size(), [&](std::size_t cell) {
    auto out = vertices.begin() + static_cast<std::ptrdiff_t>(24 * cell);
    for (const auto& face : kHexahedronFaces) {
      out = std::transform(face.begin(), face.end(), out, [&](int corner) {
        return cells[cell][static_cast<std::size_t>(corner)];
      });
    }
    offsets[cell + 1] = static_cast<std::uint32_t>(6 * (cell + 1));
  });
  return {n_vertices, CompressedRows<std::int32_t>::uniform(4, std::move(vertices)),
          std::move(offsets)};
}

Polyhedra match_faces(CellLoops loops) {
  const std::vector<Match> matches = find_matches(loops);
  const std::size_t n_loops = matches.size();
  std::vector<std::int32_t> face_of(n_loops);
  std::vector<std::int32_t> vertices;
  std::vector<std::uint32_t> offsets = {0};
  std::int32_t n_faces = 0;
  for (std::size_t i = 0; i < n_loops; ++i) {
    if (matches[i].first == i) {
      const Loop loop = std::as_const(loops).loops[i];
      vertices.insert(vertices.end(), loop.begin(), loop.end());
      offsets.push_back(static_cast<std::uint32_t>(vertices.size()));
      face_of[i] = n_faces++;
    }
  }
  std::vector<std::int32_t> half_faces(n_loops);
  parallel_for(n_loops, [&](std::size_t i) {
    half_faces[i] = 2 * face_of[matches[i].first] + static_cast<int>(matches[i].is_reversed);
  });
  vertices.shrink_to_fit();
  return {
      loops.n_vertices,
      CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(vertices)),
      CompressedRows<std::int32_t>::from_offsets(std::move(loops.cells), std::move(half_faces))};
}

Polyhedra polyhedra_from_faces(std::int32_t n_vertices, CompressedRows<std::int32_t> faces,
                               const CompressedRows<std::int32_t>& cell_faces) {
  Polyhedra polyhedra{n_vertices, std::move(faces), cell_faces};
  for (std::size_t cell = 0; cell < polyhedra.cells.n_rows(); ++cell) {
    for (std::int32_t& half_face : polyhedra.cells[cell]) {
      half_face *= 2;
    }
  }
  return polyhedra;
}

void orient(Polyhedra& polyhedra, std::span<const glm::dvec3> points) {
  parallel_ranges(polyhedra.cells.n_rows(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<EdgeUse> uses;
    for (std::size_t cell = begin; cell < end; ++cell) {
      orient_shell(polyhedra, cell, uses);
    }
  });
  for (const std::vector<std::size_t>& part : orient_neighbours(polyhedra)) {
    double volume = 0;
    for (const std::size_t cell : part) {
      volume += signed_volume(polyhedra, cell, points);
    }
    if (volume < 0) {
      for (const std::size_t cell : part) {
        flip_cell(polyhedra, cell);
      }
    }
  }
}

double signed_volume(const Polyhedra& polyhedra, std::size_t cell,
                     std::span<const glm::dvec3> points) {
  const auto half_faces = polyhedra.cells[cell];
  double volume = 0;
  glm::dvec3 origin(0);
  bool has_origin = false;
  for (const std::int32_t half_face : half_faces) {
    const Loop loop = polyhedra.faces[static_cast<std::size_t>(half_face >> 1)];
    if (loop.empty()) {
      continue;
    }
    const auto point = [&](std::size_t i) {
      return points[static_cast<std::size_t>(loop[i % loop.size()])];
    };
    if (!has_origin) {
      origin = point(0);
      has_origin = true;
    }
    glm::dvec3 centroid(0);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      centroid += (point(i) - origin) / static_cast<double>(loop.size());
    }
    double fan = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      fan += glm::dot(centroid, glm::cross(point(i) - origin, point(i + 1) - origin));
    }
    volume += (half_face & 1) != 0 ? -fan : fan;
  }
  return volume / 6;
}

}  // namespace espalier
