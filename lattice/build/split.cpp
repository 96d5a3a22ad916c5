#include "lattice/build/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/topology/cell_complex.h"

namespace espalier {
namespace {

/// The edges of a layer, each from its lower to its upper vertex, and the vertices that cut them.
struct Layer {
  IdVector<EdgeId, bool> has;
  IdVector<EdgeId, VertexId> lower;
  std::vector<EdgeId> edges;
};

/// Adds an edge of the layer, which must point the same way each time it is reached.
void reach(const CellComplex& complex, EdgeId edge, VertexId lower, Layer& layer) {
  if (!layer.has[edge]) {
    layer.has[edge] = true;
    layer.lower[edge] = lower;
    layer.edges.push_back(edge);
  } else if (layer.lower[edge] != lower) {
    throw LatticeError(fmt::format("split: the layer is one-sided or crosses itself at edge {}-{}",
                                   complex.vertices(edge)[0].value,
                                   complex.vertices(edge)[1].value));
  }
}

Layer layer_of(const CellComplex& complex, EdgeId seed, VertexId lower) {
  Layer layer{IdVector<EdgeId, bool>(complex.n_edges(), false),
              IdVector<EdgeId, VertexId>(complex.n_edges()),
              {}};
  reach(complex, seed, lower, layer);
  for (std::size_t at = 0; at < layer.edges.size(); ++at) {
    const EdgeId edge = layer.edges[at];
    for (const HalfFaceId half_face : complex.half_faces(edge)) {
      const FaceId face = half_face.face();
      const auto edges = complex.edges(face);
      if (edges.size() != 4) {
        throw LatticeError(fmt::format(
            "split: the layer runs into face {}, which has {} vertices; it can only pass "
            "quadrilaterals",
            face.value, edges.size()));
      }
      const auto place =
          static_cast<std::size_t>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
      const EdgeId side = edges[(place + 1) % 4];  // joins the two edges' ends
      const EdgeId opposite = edges[(place + 2) % 4];
      const auto& corners = complex.vertices(side);
      const VertexId common = layer.lower[edge];
      const bool is_at_lower = corners[0] == common || corners[1] == common;
      const EdgeId lower_side = is_at_lower ? side : edges[(place + 3) % 4];
      reach(complex, opposite, complex.other_end(lower_side, common), layer);
    }
  }
  return layer;
}

/// Cuts one cell of the layer.
class CellCut {
 public:
  CellCut(const CellComplex& complex, const Layer& layer,
          const std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t>& cuts)
      : complex_(complex), layer_(layer), cuts_(cuts) {}

  /// The two parts; the lower keeps the old numbers.
  [[nodiscard]] std::pair<DraftCell, DraftCell> parts(const DraftCell& cell) {
    std::pair<DraftCell, DraftCell> parts;
    parts.first.cell = cell.cell;
    find_levels(cell);
    for (const DraftSide& side : cell.sides) {
      cut_side(side, parts);
    }
    add_cut_face(cell, parts);
    return parts;
  }

 private:
  [[noreturn]] static void fail(const DraftCell& cell) {
    throw LatticeError(fmt::format(
        "split: the layer crosses itself in cell {}, or the cell is no prism along it", cell.cell));
  }

  /// Says of each vertex of the cell whether it is below or above the cut.
  void find_levels(const DraftCell& cell) {
    is_upper_.clear();
    for (const DraftSide& side : cell.sides) {
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const VertexId a{side.loop[i]};
        const VertexId b{side.loop[(i + 1) % side.loop.size()]};
        const EdgeId edge = complex_.find_edge(a, b);
        if (layer_.has[edge]) {
          const bool is_up = layer_.lower[edge] == a;
          if (is_upper_.emplace(a.value, !is_up).first->second == is_up ||
              is_upper_.emplace(b.value, is_up).first->second != is_up) {
            fail(cell);
          }
        }
      }
    }
    for (const DraftSide& side : cell.sides) {
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const std::int32_t a = side.loop[i];
        const std::int32_t b = side.loop[(i + 1) % side.loop.size()];
        if (!is_upper_.contains(a) ||
            (is_upper_.at(a) != is_upper_[b]) != cuts_.contains(std::minmax(a, b))) {
          fail(cell);
        }
      }
    }
  }

  void cut_side(const DraftSide& side, std::pair<DraftCell, DraftCell>& parts) {
    DraftSide lower{{}, side.face};
    DraftSide upper{{}, -1};
    for (std::size_t i = 0; i < side.loop.size(); ++i) {
      const std::int32_t a = side.loop[i];
      const std::int32_t b = side.loop[(i + 1) % side.loop.size()];
      (is_upper_.at(a) ? upper : lower).loop.push_back(a);
      if (is_upper_.at(a) != is_upper_.at(b)) {
        const std::int32_t cut = cuts_.at(std::minmax(a, b));
        lower.loop.push_back(cut);
        upper.loop.push_back(cut);
      }
    }
    if (lower.loop.empty()) {
      upper.face = side.face;
    }
    for (const auto& [from, to] : {std::pair(&lower, &parts.first), {&upper, &parts.second}}) {
      if (!from->loop.empty()) {
        to->sides.push_back(std::move(*from));
      }
    }
  }

  /// Closes the parts with the face through the cuts: against the lower part's sides.
  void add_cut_face(const DraftCell& cell, std::pair<DraftCell, DraftCell>& parts) {
    const auto is_cut = [this](std::int32_t vertex) { return !is_upper_.contains(vertex); };
    std::map<std::int32_t, std::int32_t> next;
    for (const DraftSide& side : parts.first.sides) {
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const std::int32_t a = side.loop[i];
        const std::int32_t b = side.loop[(i + 1) % side.loop.size()];
        if (is_cut(a) && is_cut(b)) {
          next[b] = a;
        }
      }
    }
    VertexLoop loop = {next.begin()->first};
    while (loop.size() < next.size() && next.contains(loop.back())) {
      loop.push_back(next.at(loop.back()));
    }
    if (loop.size() < 3) {
      fail(cell);
    }
    parts.first.sides.push_back({loop, -1});
    std::reverse(loop.begin(), loop.end());
    parts.second.sides.push_back({std::move(loop), -1});
  }

  const CellComplex& complex_;
  const Layer& layer_;
  const std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t>& cuts_;
  std::map<std::int32_t, bool> is_upper_;
};

}  // namespace

Edited split_layer(const CellMesh& mesh, std::int32_t from, std::int32_t to, double at) {
  if (!(at > 0 && at < 1)) {
    throw ParameterError(fmt::format("split: at is {}, must be between 0 and 1", at));
  }
  const CellComplex complex(mesh.cells);
  const auto is_vertex = [&](std::int32_t v) { return v >= 0 && v < mesh.cells.n_vertices; };
  const EdgeId seed =
      is_vertex(from) && is_vertex(to) ? complex.find_edge(VertexId{from}, VertexId{to}) : EdgeId{};
  if (!seed.is_valid()) {
    throw ParameterError(fmt::format("split: there is no edge {}-{}", from, to));
  }
  const Layer layer = layer_of(complex, seed, VertexId{from});
  MeshDraft draft(mesh);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> cuts;
  std::vector<bool> is_crossed(complex.n_cells(), false);
  for (const EdgeId edge : layer.edges) {
    const std::int32_t a = layer.lower[edge].value;
    const std::int32_t b = complex.other_end(edge, layer.lower[edge]).value;
    const glm::dvec3 point = mesh.points[static_cast<std::size_t>(a)] * (1 - at) +
                             mesh.points[static_cast<std::size_t>(b)] * at;
    cuts[std::minmax(a, b)] = draft.add_vertex(point, {{a, 1 - at}, {b, at}});
    for (const HalfFaceId half_face : complex.half_faces(edge)) {
      for (const HalfFaceId side : {half_face, half_face.opposite()}) {
        if (complex.cell(side).is_valid()) {
          is_crossed[complex.cell(side).index()] = true;
        }
      }
    }
  }
  for (std::size_t cell = 0; cell < is_crossed.size(); ++cell) {
    if (is_crossed[cell]) {
      auto [lower, upper] = CellCut(complex, layer, cuts).parts(draft.cells[cell]);
      draft.cells[cell] = std::move(lower);
      draft.cells.push_back(std::move(upper));
    }
  }
  return finished(std::move(draft));
}

}  // namespace espalier
