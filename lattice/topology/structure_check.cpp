#include "lattice/topology/structure_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lattice/core/disjoint_sets.h"
#include "lattice/topology/defect_collection.h"

namespace espalier {
namespace {

using Row = std::span<const std::int32_t>;

std::optional<Defect> check_face_indices(const Polyhedra& polyhedra, std::size_t face) {
  for (const std::int32_t vertex : polyhedra.faces[face]) {
    if (vertex < 0 || vertex >= polyhedra.n_vertices) {
      return make_defect(
          DefectKind::IndexOutOfRange, "face", face,
          fmt::format("vertex {} does not exist, there are {}", vertex, polyhedra.n_vertices));
    }
  }
  return std::nullopt;
}

std::optional<Defect> check_cell_indices(const Polyhedra& polyhedra, std::size_t cell) {
  const auto n_faces = static_cast<std::int64_t>(polyhedra.faces.n_rows());
  for (const std::int32_t half_face : polyhedra.cells[cell]) {
    if (half_face < 0 || half_face >= 2 * n_faces) {
      return make_defect(
          DefectKind::IndexOutOfRange, "cell", cell,
          fmt::format("face {} does not exist, there are {}", half_face >> 1, n_faces));
    }
  }
  return std::nullopt;
}

std::optional<Defect> check_face(const Polyhedra& polyhedra, std::size_t face) {
  const Row loop = polyhedra.faces[face];
  if (loop.size() < 3) {
    return make_defect(DefectKind::FaceTooSmall, "face", face,
                       fmt::format("has {} vertices, needs three or more", loop.size()));
  }
  for (std::size_t i = 0; i < loop.size() && loop.size() <= 8; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (loop[i] == loop[j]) {
        return make_defect(DefectKind::FaceRepeatsVertex, "face", face,
                           fmt::format("contains vertex {} twice", loop[i]));
      }
    }
  }
  if (loop.size() > 8) {
    std::vector<std::int32_t> sorted(loop.begin(), loop.end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      return make_defect(DefectKind::FaceRepeatsVertex, "face", face,
                         fmt::format("contains vertex {} twice", *twice));
    }
  }
  return std::nullopt;
}

/// One use of an edge by a half-face of a cell.
struct EdgeUse {
  std::uint64_t edge;  // smaller vertex << 32 | larger
  std::uint32_t place;
  bool is_ascending;
};

/// What checking a cell takes; kept from cell to cell.
struct CellMemory {
  std::vector<std::int32_t> faces;
  std::vector<std::int32_t> vertices;
  DisjointSets sets;
  std::vector<EdgeUse> uses;
};

void collect_edge_uses(const Polyhedra& polyhedra, std::size_t cell, std::vector<EdgeUse>& uses) {
  uses.clear();
  const Row half_faces = polyhedra.cells[cell];
  for (std::uint32_t place = 0; place < half_faces.size(); ++place) {
    const Row loop = polyhedra.faces[static_cast<std::size_t>(half_faces[place] >> 1)];
    const bool is_reversed = (half_faces[place] & 1) != 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto from = static_cast<std::uint32_t>(loop[i]);
      const auto to = static_cast<std::uint32_t>(loop[i + 1 < loop.size() ? i + 1 : 0]);
      uses.push_back({std::uint64_t{std::min(from, to)} << 32 | std::max(from, to), place,
                      (from < to) != is_reversed});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.place < b.place;
  });
}

std::string edge_name(std::uint64_t edge) {
  return fmt::format("{}-{}", edge >> 32, edge & 0xffffffffU);
}

/// Whether a closed shell is one sphere: its faces hang together by edges, and V − E + F = 2. A
/// handle or a vertex where the shell touches itself lowers that number.
bool is_sphere(const Polyhedra& polyhedra, std::size_t cell, CellMemory& memory) {
  const Row half_faces = polyhedra.cells[cell];
  const std::vector<EdgeUse>& uses = memory.uses;
  memory.sets.reset(half_faces.size());
  std::size_t n_shells = half_faces.size();
  for (std::size_t i = 0; i + 1 < uses.size(); i += 2) {
    n_shells -= memory.sets.join(uses[i].place, uses[i + 1].place) ? 1 : 0;
  }
  std::vector<std::int32_t>& vertices = memory.vertices;
  vertices.clear();
  for (const std::int32_t half_face : half_faces) {
    const Row loop = polyhedra.faces[static_cast<std::size_t>(half_face >> 1)];
    vertices.insert(vertices.end(), loop.begin(), loop.end());
  }
  std::sort(vertices.begin(), vertices.end());
  const auto n_vertices = std::unique(vertices.begin(), vertices.end()) - vertices.begin();
  const auto n_edges = static_cast<std::ptrdiff_t>(uses.size() / 2);
  const auto n_faces = static_cast<std::ptrdiff_t>(half_faces.size());
  return n_shells == 1 && n_vertices - n_edges + n_faces == 2;
}

std::optional<Defect> check_cell(const Polyhedra& polyhedra, std::size_t cell, CellMemory& memory) {
  const Row half_faces = polyhedra.cells[cell];
  std::vector<std::int32_t>& faces = memory.faces;
  faces.resize(half_faces.size());
  std::transform(half_faces.begin(), half_faces.end(), faces.begin(), [](int h) { return h >> 1; });
  std::sort(faces.begin(), faces.end());
  if (const auto twice = std::adjacent_find(faces.begin(), faces.end()); twice != faces.end()) {
    return make_defect(DefectKind::CellRepeatsFace, "cell", cell,
                       fmt::format("contains face {} twice", *twice));
  }
  if (half_faces.size() < 4) {
    return make_defect(DefectKind::CellTooSmall, "cell", cell,
                       fmt::format("has {} faces, needs four or more", half_faces.size()));
  }
  std::vector<EdgeUse>& uses = memory.uses;
  collect_edge_uses(polyhedra, cell, uses);
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].edge == uses[i].edge) {
      ++end;
    }
    if (end - i != 2) {
      return make_defect(DefectKind::CellNotClosed, "cell", cell,
                         fmt::format("is not closed: its edge {} has {} of its faces, needs two",
                                     edge_name(uses[i].edge), end - i));
    }
    if (uses[i].is_ascending == uses[i + 1].is_ascending) {
      return make_defect(
          DefectKind::CellNotSphere, "cell", cell,
          fmt::format("its faces cannot be oriented along edge {}", edge_name(uses[i].edge)));
    }
    i = end;
  }
  if (!is_sphere(polyhedra, cell, memory)) {
    return make_defect(DefectKind::CellNotSphere, "cell", cell,
                       "its faces do not form one shell like a sphere's");
  }
  return std::nullopt;
}

/// Faces used by no cell, by too many, or by two on the same side.
void check_face_uses(const Polyhedra& polyhedra, std::vector<Defect>& defects) {
  std::vector<std::array<std::uint32_t, 2>> n_uses(polyhedra.faces.n_rows(), {0, 0});
  for (const std::int32_t half_face : polyhedra.cells.values()) {
    ++n_uses[static_cast<std::size_t>(half_face >> 1)][half_face & 1];
  }
  for (std::size_t face = 0; face < n_uses.size(); ++face) {
    const std::uint32_t n = n_uses[face][0] + n_uses[face][1];
    if (n == 0) {
      defects.push_back(make_defect(DefectKind::UnusedFace, "face", face, "belongs to no cell"));
    } else if (n > 2) {
      defects.push_back(
          make_defect(DefectKind::FaceUsedTooOften, "face", face,
                      fmt::format("belongs to {} cells, at most two can share it", n)));
    } else if (n_uses[face][0] == 2 || n_uses[face][1] == 2) {
      defects.push_back(make_defect(DefectKind::CellsOnOneSide, "face", face,
                                    "has both of its cells on one side"));
    }
  }
}

/// Different faces with the same vertices.
void check_duplicate_faces(const Polyhedra& polyhedra, std::vector<Defect>& defects) {
  const auto smallest = [&](std::size_t face) {
    const Row loop = polyhedra.faces[face];
    return *std::min_element(loop.begin(), loop.end());
  };
  const auto sorted_loop = [&](std::uint32_t face) {
    std::vector<std::int32_t> loop(polyhedra.faces[face].begin(), polyhedra.faces[face].end());
    std::sort(loop.begin(), loop.end());
    return loop;
  };
  // Buckets by smallest vertex; within one, faces of equal size and vertex sum are compared whole.
  struct Key {
    std::int64_t sum;
    std::uint32_t size;
    std::uint32_t face;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<std::uint32_t> begin(static_cast<std::size_t>(polyhedra.n_vertices) + 1, 0);
  const std::size_t n_faces = polyhedra.faces.n_rows();
  for (std::size_t face = 0; face < n_faces; ++face) {
    ++begin[static_cast<std::size_t>(smallest(face)) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Key> keys(n_faces);
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  for (std::uint32_t face = 0; face < n_faces; ++face) {
    const Row loop = polyhedra.faces[face];
    keys[fill[static_cast<std::size_t>(smallest(face))]++] = {
        std::accumulate(loop.begin(), loop.end(), std::int64_t{0}),
        static_cast<std::uint32_t>(loop.size()), face};
  }
  const auto check_bucket = [&](std::size_t vertex) -> std::optional<Defect> {
    std::sort(keys.begin() + begin[vertex], keys.begin() + begin[vertex + 1]);
    for (std::size_t i = begin[vertex] + 1; i < begin[vertex + 1]; ++i) {
      const Key& a = keys[i - 1];
      const Key& b = keys[i];
      if (a.sum == b.sum && a.size == b.size && sorted_loop(a.face) == sorted_loop(b.face)) {
        return make_defect(
            DefectKind::DuplicateFace, "face", b.face,
            fmt::format("has the vertices of face {}; cells must share one face", a.face));
      }
    }
    return std::nullopt;
  };
  collect_defects(static_cast<std::size_t>(polyhedra.n_vertices), check_bucket, defects);
}

void check_unused_vertices(const Polyhedra& polyhedra, std::vector<Defect>& defects) {
  std::vector<bool> is_used(static_cast<std::size_t>(polyhedra.n_vertices), false);
  for (const std::int32_t vertex : polyhedra.faces.values()) {
    is_used[static_cast<std::size_t>(vertex)] = true;
  }
  for (std::size_t vertex = 0; vertex < is_used.size(); ++vertex) {
    if (!is_used[vertex]) {
      defects.push_back(
          make_defect(DefectKind::UnusedVertex, "vertex", vertex, "belongs to no face"));
    }
  }
}

}  // namespace

std::vector<Defect> find_structural_defects(const Polyhedra& polyhedra) {
  std::vector<Defect> defects;
  const std::size_t n_faces = polyhedra.faces.n_rows();
  const std::size_t n_cells = polyhedra.cells.n_rows();
  if (n_cells == 0) {
    defects.push_back({DefectKind::NoCells, "cell", -1, "has no cells"});
    return defects;
  }
  collect_defects(
      n_faces, [&](std::size_t i) { return check_face_indices(polyhedra, i); }, defects);
  collect_defects(
      n_cells, [&](std::size_t i) { return check_cell_indices(polyhedra, i); }, defects);
  if (!defects.empty()) {
    return defects;
  }
  collect_defects(
      n_faces, [&](std::size_t i) { return check_face(polyhedra, i); }, defects);
  check_duplicate_faces(polyhedra, defects);
  if (defects.empty()) {
    const auto make_check = [&polyhedra] {
      return [&polyhedra, memory = CellMemory()](std::size_t i) mutable {
        return check_cell(polyhedra, i, memory);
      };
    };
    collect_defects_with(n_cells, make_check, defects);
    check_face_uses(polyhedra, defects);
  }
  check_unused_vertices(polyhedra, defects);
  return defects;
}

}  // namespace espalier
