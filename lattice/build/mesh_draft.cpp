#include "lattice/build/mesh_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// The loop without vertices that repeat the one before them.
void collapse(VertexLoop& loop) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) {
    loop.pop_back();
  }
}

void drop_collapsed(std::vector<DraftCell>& cells) {
  for (DraftCell& cell : cells) {
    for (DraftSide& side : cell.sides) {
      collapse(side.loop);
    }
    std::erase_if(cell.sides, [](const DraftSide& side) { return side.loop.size() < 3; });
  }
  std::erase_if(cells, [](const DraftCell& cell) { return cell.sides.size() < 4; });
}

/// New numbers of the vertices that cells use, in their order; -1 for the others.
std::vector<std::int32_t> number_vertices(const MeshDraft& draft) {
  std::vector<std::int32_t> number(draft.vertices.size(), -1);
  for (const DraftCell& cell : draft.cells) {
    for (const DraftSide& side : cell.sides) {
      for (const std::int32_t vertex : side.loop) {
        number[static_cast<std::size_t>(vertex)] = 0;
      }
    }
  }
  std::int32_t n_used = 0;
  for (std::int32_t& one : number) {
    one = one < 0 ? -1 : n_used++;
  }
  return number;
}

CellLoops loops_of(MeshDraft& draft, const std::vector<std::int32_t>& number,
                   std::size_t n_vertices) {
  CellLoops loops{static_cast<std::int32_t>(n_vertices), {}, {0}};
  for (DraftCell& cell : draft.cells) {
    for (DraftSide& side : cell.sides) {
      for (std::int32_t& vertex : side.loop) {
        vertex = number[static_cast<std::size_t>(vertex)];
      }
      loops.loops.push_back(side.loop);
    }
    loops.cells.push_back(static_cast<std::uint32_t>(loops.loops.n_rows()));
  }
  return loops;
}

void map_elements(const MeshDraft& draft, const std::vector<std::int32_t>& number, Edited& edited) {
  edited.map.vertices.resize(draft.vertex_map.size());
  std::transform(draft.vertex_map.begin(), draft.vertex_map.end(), edited.map.vertices.begin(),
                 [&](std::int32_t v) { return v < 0 ? -1 : number[static_cast<std::size_t>(v)]; });
  edited.map.faces.assign(draft.n_old_faces, -1);
  edited.map.cells.assign(draft.n_old_cells, -1);
  for (std::size_t i = 0; i < draft.cells.size(); ++i) {
    const DraftCell& cell = draft.cells[i];
    if (cell.cell >= 0) {
      edited.map.cells[static_cast<std::size_t>(cell.cell)] = static_cast<std::int32_t>(i);
    }
    for (std::size_t j = 0; j < cell.sides.size(); ++j) {
      if (cell.sides[j].face >= 0) {
        edited.map.faces[static_cast<std::size_t>(cell.sides[j].face)] =
            std::as_const(edited.mesh.cells).cells[i][j] >> 1;
      }
    }
  }
}

/// Numbers faces so that old ones come first, in their old order.
void keep_face_order(Edited& edited) {
  Polyhedra& cells = edited.mesh.cells;
  std::vector<std::int32_t> order;
  std::vector<std::int32_t> number(cells.faces.n_rows(), -1);
  const auto append = [&](std::int32_t face) {
    if (face >= 0 && number[static_cast<std::size_t>(face)] < 0) {
      number[static_cast<std::size_t>(face)] = static_cast<std::int32_t>(order.size());
      order.push_back(face);
    }
  };
  std::for_each(edited.map.faces.begin(), edited.map.faces.end(), append);
  for (std::size_t face = 0; face < number.size(); ++face) {
    append(static_cast<std::int32_t>(face));
  }
  CompressedRows<std::int32_t> faces;
  for (const std::int32_t face : order) {
    faces.push_back(std::as_const(cells.faces)[static_cast<std::size_t>(face)]);
  }
  cells.faces = std::move(faces);
  for (std::size_t cell = 0; cell < cells.cells.n_rows(); ++cell) {
    for (std::int32_t& half_face : cells.cells[cell]) {
      half_face = 2 * number[static_cast<std::size_t>(half_face >> 1)] + (half_face & 1);
    }
  }
  for (std::int32_t& face : edited.map.faces) {
    face = face < 0 ? -1 : number[static_cast<std::size_t>(face)];
  }
}

}  // namespace

MeshDraft::MeshDraft(const CellMesh& mesh)
    : vertex_map(mesh.points.size()),
      n_old_faces(mesh.cells.faces.n_rows()),
      n_old_cells(mesh.cells.cells.n_rows()) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    vertex_map[i] = static_cast<std::int32_t>(i);
    vertices.push_back({mesh.points[i], {{vertex_map[i], 1}}, glm::dmat3(1)});
  }
  cells.resize(n_old_cells);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].cell = static_cast<std::int32_t>(i);
    for (const std::int32_t half_face : mesh.cells.cells[i]) {
      const auto loop = mesh.cells.faces[static_cast<std::size_t>(half_face >> 1)];
      DraftSide& side = cells[i].sides.emplace_back();
      side.face = half_face >> 1;
      side.loop.assign(loop.begin(), loop.end());
      if ((half_face & 1) != 0) {
        std::reverse(side.loop.begin(), side.loop.end());
      }
    }
  }
}

std::int32_t MeshDraft::add_vertex(const glm::dvec3& point, std::vector<Source> sources,
                                   const glm::dmat3& turn) {
  vertices.push_back({point, std::move(sources), turn});
  return static_cast<std::int32_t>(vertices.size() - 1);
}

void MeshDraft::add_cell(std::vector<VertexLoop> loops) {
  DraftCell& cell = cells.emplace_back();
  for (VertexLoop& loop : loops) {
    cell.sides.push_back({std::move(loop), -1});
  }
}

Edited finished(MeshDraft draft) {
  drop_collapsed(draft.cells);
  const std::vector<std::int32_t> number = number_vertices(draft);
  Edited edited;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] >= 0) {
      edited.mesh.points.push_back(draft.vertices[i].point);
      edited.sources.push_back(draft.vertices[i].sources);
      edited.turns.push_back(draft.vertices[i].turn);
    }
  }
  edited.mesh.cells = match_faces(loops_of(draft, number, edited.mesh.points.size()));
  map_elements(draft, number, edited);
  keep_face_order(edited);
  orient(edited.mesh.cells, edited.mesh.points);
  return edited;
}

void check_selection(std::span<const std::int32_t> indices, std::size_t n, const char* what) {
  if (indices.empty()) {
    throw ParameterError(fmt::format("{}s: none is given", what));
  }
  std::vector<bool> is_given(n, false);
  for (const std::int32_t index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= n) {
      throw ParameterError(fmt::format("{} {} does not exist, there are {}", what, index, n));
    }
    if (is_given[static_cast<std::size_t>(index)]) {
      throw ParameterError(fmt::format("{} {} is given twice", what, index));
    }
    is_given[static_cast<std::size_t>(index)] = true;
  }
}

}  // namespace espalier
