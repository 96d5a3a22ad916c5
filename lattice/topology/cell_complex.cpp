#include "lattice/topology/cell_complex.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "lattice/core/parallel.h"
#include "lattice/topology/structure_check.h"

namespace espalier {
namespace {

template <class To, class From>
CompressedRows<To> cast_rows(const CompressedRows<From>& rows) {
  std::vector<To> values;
  values.reserve(rows.n_values());
  for (const From value : rows.values()) {
    values.push_back(To{value});
  }
  std::vector<std::uint32_t> offsets(rows.n_rows() + 1);
  for (std::size_t i = 0; i <= rows.n_rows(); ++i) {
    offsets[i] = static_cast<std::uint32_t>(rows.offset(i));
  }
  return CompressedRows<To>::from_offsets(std::move(offsets), std::move(values));
}

/// The rows of `down` turned round: for each of the n_values values the rows that contain it,
/// ascending.
template <class Up, class Rows>
CompressedRows<Up> transpose(const Rows& row, std::size_t n_rows, std::size_t n_values) {
  std::vector<std::uint32_t> offsets(n_values + 2, 0);
  for (std::size_t i = 0; i < n_rows; ++i) {
    for (const auto value : row(i)) {
      ++offsets[value.index() + 2];
    }
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<Up> values(offsets.back());
  for (std::size_t i = 0; i < n_rows; ++i) {
    for (const auto value : row(i)) {
      values[offsets[value.index() + 1]++] = Up{static_cast<std::int32_t>(i)};
    }
  }
  offsets.pop_back();
  return CompressedRows<Up>::from_offsets(std::move(offsets), std::move(values));
}

/// Puts the half-faces at one edge, each running along it, into radial order.
class RadialSorter {
 public:
  void sort(std::span<HalfFaceId> half_faces, const IdVector<HalfFaceId, CellId>& cells) {
    entries_.clear();
    for (std::uint32_t i = 0; i < half_faces.size(); ++i) {
      entries_.push_back({cells[half_faces[i].opposite()], i});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.entered_from != b.entered_from ? a.entered_from < b.entered_from : a.place < b.place;
    });
    ordered_.clear();
    is_placed_.assign(half_faces.size(), false);
    // Open fans first, each from its first face; they sort first, entered from no cell.
    for (const Entry& entry : entries_) {
      walk(entry.place, half_faces, cells);
    }
    std::copy(ordered_.begin(), ordered_.end(), half_faces.begin());
  }

 private:
  /// A face by the cell one comes from when one reaches it going round the edge.
  struct Entry {
    CellId entered_from;
    std::uint32_t place;
  };

  void walk(std::uint32_t place, std::span<const HalfFaceId> half_faces,
            const IdVector<HalfFaceId, CellId>& cells) {
    while (!is_placed_[place]) {
      is_placed_[place] = true;
      ordered_.push_back(half_faces[place]);
      const CellId cell = cells[half_faces[place]];
      if (!cell.is_valid()) {
        return;
      }
      const auto next =
          std::lower_bound(entries_.begin(), entries_.end(), cell,
                           [](const Entry& e, CellId c) { return e.entered_from < c; });
      assert(next != entries_.end() && next->entered_from == cell);
      place = next->place;
    }
  }

  std::vector<Entry> entries_;
  std::vector<HalfFaceId> ordered_;
  std::vector<bool> is_placed_;
};

}  // namespace

CellComplex::CellComplex(Polyhedra polyhedra) {
  throw_if_defective(find_structural_defects(polyhedra));
  build(std::move(polyhedra));
}

CellComplex CellComplex::from_valid(Polyhedra polyhedra) {
  CellComplex complex;
  complex.build(std::move(polyhedra));
  return complex;
}

void CellComplex::build(Polyhedra polyhedra) {
  face_vertices_ = cast_rows<VertexId>(polyhedra.faces);
  polyhedra.faces = {};
  build_edges();
  build_cells(polyhedra.cells);
  polyhedra.cells = {};
  build_upward_incidences();
  build_radial_order();
  mark_boundary();
}

void CellComplex::build_edges() {
  // Every face corner is a use of the edge to the next corner. Bucket the uses by the smaller
  // vertex, sort each bucket by the larger one, and count what differs. The uses of an edge then
  // stand together, so they are the faces at it, too: put into radial order later.
  struct Use {
    std::int32_t larger;
    std::uint32_t corner;
    HalfFaceId half_face;  // the side that runs from the smaller vertex to the larger
    auto operator<=>(const Use&) const = default;
  };
  const std::size_t n_vertices =
      face_vertices_.n_values() == 0
          ? 0
          : std::max_element(face_vertices_.values().begin(), face_vertices_.values().end())
                    ->index() +
                1;
  const std::size_t n_faces = face_vertices_.n_rows();
  const auto for_each_use = [&](const auto& visit) {
    std::uint32_t corner = 0;
    for (std::size_t face = 0; face < n_faces; ++face) {
      const auto loop = std::as_const(face_vertices_)[face];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const VertexId next = loop[i + 1 < loop.size() ? i + 1 : 0];
        const HalfFaceId side(FaceId{static_cast<std::int32_t>(face)}, loop[i] < next ? 0 : 1);
        visit(std::min(loop[i], next), Use{std::max(loop[i], next).value, corner++, side});
      }
    }
  };
  std::vector<std::uint32_t> begin(n_vertices + 2, 0);
  for_each_use([&](VertexId smaller, const Use&) { ++begin[smaller.index() + 2]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Use> uses(begin.back());
  for_each_use([&](VertexId smaller, const Use& use) { uses[begin[smaller.index() + 1]++] = use; });
  std::vector<std::uint32_t> first_edge(n_vertices + 1, 0);
  parallel_for(n_vertices, [&](std::size_t vertex) {
    std::sort(uses.begin() + begin[vertex], uses.begin() + begin[vertex + 1]);
    for (std::size_t i = begin[vertex]; i < begin[vertex + 1]; ++i) {
      first_edge[vertex + 1] += i == begin[vertex] || uses[i].larger != uses[i - 1].larger;
    }
  });
  std::partial_sum(first_edge.begin(), first_edge.end(), first_edge.begin());
  edge_vertices_ = IdVector<EdgeId, std::array<VertexId, 2>>(first_edge.back());
  face_edges_.resize(uses.size());
  std::vector<std::uint32_t> first_use(edge_vertices_.size() + 1,
                                       static_cast<std::uint32_t>(uses.size()));
  std::vector<HalfFaceId> half_faces(uses.size());
  parallel_for(n_vertices, [&](std::size_t vertex) {
    EdgeId edge{static_cast<std::int32_t>(first_edge[vertex]) - 1};
    for (std::size_t i = begin[vertex]; i < begin[vertex + 1]; ++i) {
      if (i == begin[vertex] || uses[i].larger != uses[i - 1].larger) {
        ++edge.value;
        edge_vertices_[edge] = {VertexId{static_cast<std::int32_t>(vertex)},
                                VertexId{uses[i].larger}};
        first_use[edge.index()] = static_cast<std::uint32_t>(i);
      }
      face_edges_[uses[i].corner] = edge;
      half_faces[i] = uses[i].half_face;
    }
  });
  edge_half_faces_ =
      CompressedRows<HalfFaceId>::from_offsets(std::move(first_use), std::move(half_faces));
}

void CellComplex::build_cells(const CompressedRows<std::int32_t>& cells) {
  cell_half_faces_ = cast_rows<HalfFaceId>(cells);
  half_face_cells_ = IdVector<HalfFaceId, CellId>(2 * n_faces());
  std::vector<std::uint32_t> offsets(n_cells() + 1, 0);
  const auto collect_vertices = [this](std::size_t cell, std::vector<VertexId>& vertices) {
    vertices.clear();
    for (const HalfFaceId half_face : std::as_const(cell_half_faces_)[cell]) {
      const auto loop = std::as_const(face_vertices_)[half_face.face().index()];
      vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  };
  // A cell is a sphere, V = 2 + E − F, so rows are sized before they are filled.
  for (std::size_t cell = 0; cell < n_cells(); ++cell) {
    std::size_t n_corners = 0;
    for (const HalfFaceId half_face : std::as_const(cell_half_faces_)[cell]) {
      half_face_cells_[half_face] = CellId{static_cast<std::int32_t>(cell)};
      n_corners += std::as_const(face_vertices_)[half_face.face().index()].size();
    }
    const std::size_t cell_faces = std::as_const(cell_half_faces_)[cell].size();
    offsets[cell + 1] = offsets[cell] + static_cast<std::uint32_t>(2 + n_corners / 2 - cell_faces);
  }
  std::vector<VertexId> values(offsets.back());
  parallel_ranges(n_cells(), 4096, [&](std::size_t begin, std::size_t end) {
    std::vector<VertexId> vertices;
    for (std::size_t cell = begin; cell < end; ++cell) {
      collect_vertices(cell, vertices);
      assert(vertices.size() == offsets[cell + 1] - offsets[cell]);
      std::copy(vertices.begin(), vertices.end(), values.begin() + offsets[cell]);
    }
  });
  cell_vertices_ = CompressedRows<VertexId>::from_offsets(std::move(offsets), std::move(values));
}

void CellComplex::build_upward_incidences() {
  std::size_t n = 0;
  for (const auto& ends : edge_vertices_) {
    n = std::max(n, ends[1].index() + 1);
  }
  const auto transpose_one = [&](std::size_t which) {
    if (which == 0) {
      vertex_faces_ = transpose<FaceId>(
          [&](std::size_t i) { return std::as_const(face_vertices_)[i]; }, n_faces(), n);
    } else if (which == 1) {
      vertex_cells_ = transpose<CellId>(
          [&](std::size_t i) { return std::as_const(cell_vertices_)[i]; }, n_cells(), n);
    } else {
      vertex_edges_ = transpose<EdgeId>([&](std::size_t i) { return edge_vertices_.values()[i]; },
                                        n_edges(), n);
    }
  };
  parallel_for(3, transpose_one, n_edges() < 4096 ? 3 : 1);
}

void CellComplex::build_radial_order() {
  parallel_ranges(n_edges(), 4096, [&](std::size_t begin, std::size_t end) {
    RadialSorter sorter;
    for (std::size_t i = begin; i < end; ++i) {
      sorter.sort(edge_half_faces_[i], half_face_cells_);
    }
  });
}

void CellComplex::mark_boundary() {
  edge_is_boundary_ = IdVector<EdgeId, bool>(n_edges(), false);
  vertex_is_boundary_ = IdVector<VertexId, bool>(n_vertices(), false);
  for (const FaceId face : faces()) {
    if (!is_boundary(face)) {
      continue;
    }
    for (const EdgeId edge : edges(face)) {
      edge_is_boundary_[edge] = true;
    }
    for (const VertexId vertex : vertices(face)) {
      vertex_is_boundary_[vertex] = true;
    }
  }
}

int CellComplex::n_cells(EdgeId edge) const {
  return static_cast<int>(half_faces(edge).size()) - n_open_fans(edge);
}

int CellComplex::n_open_fans(EdgeId edge) const {
  const auto row = half_faces(edge);
  return static_cast<int>(
      std::count_if(row.begin(), row.end(), [&](HalfFaceId h) { return !cell(h).is_valid(); }));
}

EdgeId CellComplex::find_edge(VertexId a, VertexId b) const {
  for (const EdgeId edge : edges(a)) {
    if (other_end(edge, a) == b) {
      return edge;
    }
  }
  return {};
}

bool CellComplex::runs_along(HalfFaceId half_face, EdgeId edge) const {
  const auto face_edges = edges(half_face.face());
  const auto at = static_cast<std::size_t>(std::find(face_edges.begin(), face_edges.end(), edge) -
                                           face_edges.begin());
  assert(at < face_edges.size());
  const bool is_ascending = vertices(half_face.face())[at] == vertices(edge)[0];
  return is_ascending == (half_face.side() == 0);
}

Polyhedra CellComplex::polyhedra() const {
  const auto to_ints = [](const auto& rows) {
    CompressedRows<std::int32_t> ints;
    std::vector<std::uint32_t> offsets(rows.n_rows() + 1);
    for (std::size_t i = 0; i <= rows.n_rows(); ++i) {
      offsets[i] = static_cast<std::uint32_t>(rows.offset(i));
    }
    std::vector<std::int32_t> values;
    values.reserve(rows.n_values());
    for (const auto id : rows.values()) {
      values.push_back(id.value);
    }
    return CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(values));
  };
  return {static_cast<std::int32_t>(n_vertices()), to_ints(face_vertices_),
          to_ints(cell_half_faces_)};
}

std::size_t CellComplex::bytes() const {
  return face_vertices_.bytes() + face_edges_.capacity() * sizeof(EdgeId) + edge_vertices_.bytes() +
         cell_half_faces_.bytes() + cell_vertices_.bytes() + half_face_cells_.bytes() +
         vertex_edges_.bytes() + vertex_faces_.bytes() + vertex_cells_.bytes() +
         edge_half_faces_.bytes() + (n_edges() + n_vertices()) / 8;
}

}  // namespace espalier
