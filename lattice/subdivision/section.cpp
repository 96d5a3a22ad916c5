#include "lattice/subdivision/section.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "lattice/subdivision/cell_class.h"
#include "lattice/subdivision/limit.h"
#include "lattice/subdivision/refine.h"
#include "lattice/subdivision/sub_complex.h"

namespace espalier {
namespace {

// The surface is the bottom of a lattice one cell thick: refined lattices' boundaries are
// Catmull-Clark surfaces, so the volume's own rules, walks and blocks serve here.

/// The prisms over the faces, vertex i + n above vertex i.
CellComplex prisms(std::int32_t n, const CompressedRows<std::int32_t>& faces) {
  CellLoops cells{2 * n, {}, {0}};
  for (std::size_t face = 0; face < faces.n_rows(); ++face) {
    const auto base = faces[face];
    std::vector<std::int32_t> bottom(base.rbegin(), base.rend());
    std::vector<std::int32_t> top;
    cells.loops.push_back(bottom);
    for (std::size_t i = 0; i < base.size(); ++i) {
      const std::int32_t a = base[i];
      const std::int32_t b = base[(i + 1) % base.size()];
      top.push_back(a + n);
      cells.loops.push_back(std::array{a, b, b + n, a + n});
    }
    cells.loops.push_back(top);
    cells.cells.push_back(static_cast<std::uint32_t>(cells.loops.n_rows()));
  }
  return CellComplex::from_valid(match_faces(std::move(cells)));
}

/// One quadrilateral still to be cut, at one level.
struct Piece {
  Frame frame;  // w from the surface upward
  std::array<double, 2> low;
  double size;
};

/// One level: the prisms round the pieces, and their vertices over the mesh's.
struct Level {
  CellComplex complex;
  Sharpness sharpness;
  StencilTable points;
  std::vector<char> is_low;  // vertices on the surface; the others carry no points
  std::vector<Piece> pieces;
};

/// The vertex that a refinement puts at the middle of some corners of a hexahedron.
VertexId refined_vertex(const CellComplex& complex, const ParentMap& parents,
                        const std::set<VertexId>& corners, CellId cell) {
  const auto is_it = [&](const auto& vertices) {
    return vertices.size() == corners.size() &&
           std::ranges::all_of(vertices, [&](VertexId v) { return corners.contains(v); });
  };
  switch (corners.size()) {
    case 1:
      return parents.vertex_point(*corners.begin());
    case 2:
      return parents.edge_point(complex.find_edge(*corners.begin(), *std::next(corners.begin())));
    case 4:
      for (const HalfFaceId side : complex.half_faces(cell)) {
        if (is_it(complex.vertices(side.face()))) {
          return parents.face_point(side.face());
        }
      }
      return {};
    default:
      return parents.cell_point(cell);
  }
}

/// The child of a hexahedron at its corner (i, j, 0), in the same directions.
Frame child_frame(const CellComplex& coarse, const Refinement& refinement, const Frame& frame,
                  int i, int j) {
  Frame child;
  for (int c = 0; c < 8; ++c) {
    const std::array<int, 3> at = {i + c % 2, j + c / 2 % 2, c / 4};
    std::set<VertexId> corners;
    for (int d = 0; d < 8; ++d) {
      corners.insert(frame.corners[static_cast<std::size_t>(
          (at[0] + d % 2) / 2 + 2 * ((at[1] + d / 2 % 2) / 2) + 4 * ((at[2] + d / 4) / 2))]);
    }
    child.corners[static_cast<std::size_t>(c)] =
        refined_vertex(coarse, refinement.parents, corners, frame.cell);
  }
  const VertexId own = child.corners[static_cast<std::size_t>(i + 2 * j)];
  const VertexId middle = refinement.parents.cell_point(frame.cell);
  for (const CellId cell : refinement.complex->cells(own)) {
    const auto vertices = refinement.complex->vertices(cell);
    if (std::find(vertices.begin(), vertices.end(), middle) != vertices.end()) {
      child.cell = cell;
    }
  }
  return child;
}

/// Collects the section's points and patches.
class SectionBuilder {
 public:
  SectionBuilder(std::int32_t n_vertices, const CompressedRows<std::int32_t>& faces) {
    Level level;
    level.complex = prisms(n_vertices, faces);
    level.sharpness = with_touching_elements(level.complex, automatic_sharpness(level.complex));
    const auto n = static_cast<std::size_t>(n_vertices);
    level.points = StencilTable::build(2 * n, n, [&](std::size_t i, StencilRow& row) {
      if (i < n) {
        row.add(static_cast<std::int32_t>(i), 1.0);
      }
    });
    level.is_low.assign(2 * n, 0);
    std::fill_n(level.is_low.begin(), n, char{1});
    const auto loop = faces[0];
    level.pieces = {{{CellId{0},
                      {VertexId{loop[0]}, VertexId{loop[1]}, VertexId{loop[3]}, VertexId{loop[2]},
                       VertexId{loop[0] + n_vertices}, VertexId{loop[1] + n_vertices},
                       VertexId{loop[3] + n_vertices}, VertexId{loop[2] + n_vertices}}},
                     {0, 0},
                     1}};
    levels_.push_back(std::move(level));
  }

  Section build(const std::array<int, 4>& levels) {
    // The first cut parts the corners; from then on each piece goes on to its own one's level.
    for (int level = 0; !levels_.back().pieces.empty(); ++level) {
      if (!cut(level, levels)) {
        break;
      }
    }
    Section section;
    section.patches = std::move(patches_);
    section.blocks = std::move(blocks_);
    section.points = StencilTable::build(
        points_.size(), levels_.front().points.n_controls(), [&](std::size_t i, StencilRow& row) {
          const StencilTable& table = levels_[points_[i].level].points;
          for (const auto& [vertex, weight] : points_[i].combination) {
            const StencilTable::Row source = table[vertex.index()];
            for (std::size_t k = 0; k < source.indices.size(); ++k) {
              row.add(source.indices[k], weight * source.weights[k]);
            }
          }
        });
    return section;
  }

 private:
  struct Point {
    std::size_t level;
    VertexCombination combination;
  };

  /// Turns the last level's regular pieces into patches, and refines the others, or makes them
  /// leaves. Whether pieces are left.
  bool cut(int depth, const std::array<int, 4>& levels) {
    const std::size_t at = levels_.size() - 1;
    const Level& level = levels_[at];
    const Hexahedra hexahedra(level.complex);
    const CellClassifier classifier(hexahedra, level.sharpness, Scheme::CatmullClark);
    std::vector<Piece> rest;
    numbers_.clear();
    for (const Piece& piece : level.pieces) {
      if (is_regular(level, classifier, piece)) {
        add_patch(at, hexahedra, piece);
      } else if (depth >= std::max(1, levels[corner_of(piece)])) {
        add_leaf(at, hexahedra, piece);
      } else {
        rest.push_back(piece);
      }
    }
    if (!rest.empty()) {
      levels_.push_back(refine_pieces(level, rest));
    }
    return !rest.empty();
  }

  /// The corner of the face, in the order of its loop, that a piece smaller than the face lies at.
  [[nodiscard]] static std::size_t corner_of(const Piece& piece) {
    const bool is_right = piece.low[0] > 0;
    const bool is_upper = piece.low[1] > 0;
    return is_upper ? (is_right ? 2 : 3) : (is_right ? 1 : 0);
  }

  /// Only the surface counts: at the first level the upper vertices lie on the other boundary.
  [[nodiscard]] static bool is_regular(const Level& level, const CellClassifier& classifier,
                                       const Piece& piece) {
    return std::all_of(piece.frame.corners.begin(), piece.frame.corners.begin() + 4,
                       [&](VertexId vertex) {
                         const std::size_t n = level.complex.cells(vertex).size();
                         return (n == 4 || n <= 2) && classifier.is_regular(vertex);
                       });
  }

  void add_patch(std::size_t level, const Hexahedra& hexahedra, const Piece& piece) {
    const RegularBlock block = regular_block(hexahedra, piece.frame);
    Section::Patch patch{piece.low, piece.size, {}, {}, false, {block.size[0], block.size[1]}};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      patch.natural_begin[axis] = block.natural_begin[axis];
      patch.natural_end[axis] = block.natural_end[axis];
    }
    std::vector<std::int32_t> row;
    const auto n = static_cast<std::size_t>(block.size[0] * block.size[1]);
    for (std::size_t i = 0; i < n; ++i) {
      row.push_back(point(level, {{block.points[i], 1.0}}, 2 * block.points[i].value));
    }
    patches_.push_back(patch);
    blocks_.push_back(row);
  }

  void add_leaf(std::size_t level, const Hexahedra& hexahedra, const Piece& piece) {
    std::vector<std::int32_t> row;
    for (std::size_t c = 0; c < 4; ++c) {
      const VertexId vertex = piece.frame.corners[c];
      auto limit =
          limit_position(hexahedra, levels_[level].sharpness, Scheme::CatmullClark, vertex);
      assert(limit.has_value());
      row.push_back(point(level, *std::move(limit), 2 * vertex.value + 1));
    }
    patches_.push_back({piece.low, piece.size, {}, {}, true, {2, 2}});
    blocks_.push_back(row);
  }

  /// The number of a point; key: tells points of one level apart.
  std::int32_t point(std::size_t level, VertexCombination combination, std::int32_t key) {
    const auto [found, is_new] = numbers_.emplace(key, static_cast<std::int32_t>(points_.size()));
    if (is_new) {
      points_.push_back({level, std::move(combination)});
    }
    return found->second;
  }

  /// The children of some pieces, with the prisms of the lowest layer round them.
  static Level refine_pieces(const Level& level, const std::vector<Piece>& pieces) {
    const Refinement refinement = refine(level.complex, level.sharpness, Scheme::CatmullClark);
    const StencilTable points = compose(level.points, refinement.stencils);
    std::vector<Piece> children;
    std::vector<CellId> cells;
    for (const Piece& piece : pieces) {
      for (int c = 0; c < 4; ++c) {
        const int i = c % 2;
        const int j = c / 2;
        const double size = piece.size / 2;
        children.push_back({child_frame(level.complex, refinement, piece.frame, i, j),
                            {piece.low[0] + i * size, piece.low[1] + j * size},
                            size});
        cells.push_back(children.back().frame.cell);
      }
    }
    std::vector<CellId> around = with_neighbours(*refinement.complex, cells);
    const std::vector<char> is_low = find_low(level, refinement);
    std::erase_if(around, [&](CellId cell) {
      return std::ranges::none_of(refinement.complex->vertices(cell),
                                  [&](VertexId v) { return is_low[v.index()] != 0; });
    });
    SubComplex sub = cut_out(*refinement.complex, refinement.sharpness, around);
    Level next;
    next.points = rows_of(points, sub.vertices);
    for (std::size_t i = 0; i < children.size(); ++i) {
      children[i].frame.cell = CellId{static_cast<std::int32_t>(i)};
      for (VertexId& corner : children[i].frame.corners) {
        corner.value = static_cast<std::int32_t>(
            std::lower_bound(sub.vertices.begin(), sub.vertices.end(), corner) -
            sub.vertices.begin());
      }
    }
    for (const VertexId vertex : sub.vertices) {
      next.is_low.push_back(is_low[vertex.index()]);
    }
    next.pieces = std::move(children);
    next.complex = std::move(sub.complex);
    next.sharpness = std::move(sub.sharpness);
    return next;
  }

  /// Refined vertices that stand for an element of the surface.
  static std::vector<char> find_low(const Level& level, const Refinement& refinement) {
    const auto all_low = [&](const auto& vertices) {
      return std::ranges::all_of(vertices,
                                 [&](VertexId v) { return level.is_low[v.index()] != 0; });
    };
    std::vector<char> is_low(refinement.complex->n_vertices(), 0);
    for (const VertexId vertex : level.complex.vertices()) {
      is_low[refinement.parents.vertex_point(vertex).index()] = level.is_low[vertex.index()];
    }
    for (const EdgeId edge : level.complex.edges()) {
      is_low[refinement.parents.edge_point(edge).index()] =
          all_low(level.complex.vertices(edge)) ? 1 : 0;
    }
    for (const FaceId face : level.complex.faces()) {
      is_low[refinement.parents.face_point(face).index()] =
          all_low(level.complex.vertices(face)) ? 1 : 0;
    }
    return is_low;
  }

  std::vector<Level> levels_;
  std::vector<Point> points_;
  std::map<std::int32_t, std::int32_t> numbers_;
  std::vector<Section::Patch> patches_;
  CompressedRows<std::int32_t> blocks_;
};

}  // namespace

Section isolate_section(std::int32_t n_vertices, const CompressedRows<std::int32_t>& faces,
                        const std::array<int, 4>& levels) {
  return SectionBuilder(n_vertices, faces).build(levels);
}

}  // namespace espalier
