#include "lattice/subdivision/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/parallel.h"
#include "lattice/osd/crease_masks.h"
#include "lattice/subdivision/refinement_stencils.h"

namespace espalier {
namespace {

/// Position of a vertex among a cell's vertices.
std::size_t corner_of(const CellComplex& complex, CellId cell, VertexId vertex) {
  const auto vertices = complex.vertices(cell);
  return static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                                  vertices.begin());
}

/// An inner face of the refinement: the quadrilateral between a cell's point and one of its edges'
/// points, through the points of the two faces at that edge.
struct InnerFace {
  EdgeId edge;
  CellId cell;
  FaceId before;  // the face at the edge whose side runs along it
  FaceId after;
};

std::vector<InnerFace> find_inner_faces(const CellComplex& complex) {
  std::vector<InnerFace> inner;
  for (const EdgeId edge : complex.edges()) {
    const auto fans = complex.half_faces(edge);
    for (std::size_t i = 0; i < fans.size(); ++i) {
      const CellId cell = complex.cell(fans[i]);
      if (cell.is_valid()) {
        inner.push_back({edge, cell, fans[i].face(), fans[(i + 1) % fans.size()].face()});
      }
    }
  }
  return inner;
}

void check_size(const CellComplex& complex) {
  std::size_t n_corners = 0;
  for (const FaceId face : complex.faces()) {
    n_corners += complex.vertices(face).size();
  }
  std::size_t n_children = 0;
  for (const CellId cell : complex.cells()) {
    n_children += complex.vertices(cell).size();
  }
  // Half-faces are the most numerous: two a face, a face for each corner and each edge of a cell.
  const std::size_t n_half_faces = 2 * (n_corners + 2 * n_children * 3);
  if (n_half_faces > std::numeric_limits<std::int32_t>::max() / 4) {
    throw LatticeError("the refined lattice would have about " + std::to_string(n_children) +
                       " cells, too many; refine fewer times");
  }
}

/// The refined faces: first a quadrilateral for every corner of every face, then the inner ones.
class RefinedTables {
 public:
  explicit RefinedTables(const CellComplex& coarse)
      : coarse_(coarse), inner_(find_inner_faces(coarse)) {
    first_corner_.reserve(coarse.n_faces() + 1);
    first_corner_.push_back(0);
    for (const FaceId face : coarse.faces()) {
      first_corner_.push_back(first_corner_.back() +
                              static_cast<std::int32_t>(coarse.vertices(face).size()));
    }
  }

  [[nodiscard]] Polyhedra polyhedra(const ParentMap& points) const {
    return {points.cell_point(CellId{static_cast<std::int32_t>(coarse_.n_cells())}).value,
            faces(points), cells()};
  }

  [[nodiscard]] std::vector<Parent> face_parents() const {
    std::vector<Parent> parents;
    parents.reserve(static_cast<std::size_t>(first_corner_.back()) + inner_.size());
    for (const FaceId face : coarse_.faces()) {
      parents.insert(parents.end(), coarse_.vertices(face).size(),
                     Parent{Parent::Kind::Face, face.value});
    }
    for (const InnerFace& face : inner_) {
      parents.push_back({Parent::Kind::Cell, face.cell.value});
    }
    return parents;
  }

  [[nodiscard]] std::vector<CellId> cell_parents() const {
    std::vector<CellId> parents;
    parents.reserve(8 * coarse_.n_cells());
    for (const CellId cell : coarse_.cells()) {
      parents.insert(parents.end(), coarse_.vertices(cell).size(), cell);
    }
    return parents;
  }

 private:
  [[nodiscard]] CompressedRows<std::int32_t> faces(const ParentMap& points) const {
    std::vector<std::int32_t> vertices;
    vertices.reserve(4 * (static_cast<std::size_t>(first_corner_.back()) + inner_.size()));
    for (const FaceId face : coarse_.faces()) {
      const auto loop = coarse_.vertices(face);
      const auto edges = coarse_.edges(face);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const EdgeId before = edges[(i + loop.size() - 1) % loop.size()];
        vertices.insert(vertices.end(),
                        {points.vertex_point(loop[i]).value, points.edge_point(edges[i]).value,
                         points.face_point(face).value, points.edge_point(before).value});
      }
    }
    // Wound so that side 0 belongs to the child at the edge's first vertex.
    for (const InnerFace& face : inner_) {
      vertices.insert(vertices.end(),
                      {points.edge_point(face.edge).value, points.face_point(face.after).value,
                       points.cell_point(face.cell).value, points.face_point(face.before).value});
    }
    return CompressedRows<std::int32_t>::uniform(4, std::move(vertices));
  }

  /// Offset of each child's row: a corner of valence n has n faces of its cell and n inner ones.
  [[nodiscard]] std::vector<std::uint32_t> child_offsets(
      const std::vector<std::uint32_t>& first_child) const {
    std::vector<std::uint32_t> offsets(first_child.back() + 1, 0);
    parallel_for(coarse_.n_cells(), [&](std::size_t i) {
      const CellId cell{static_cast<std::int32_t>(i)};
      for (const HalfFaceId half_face : coarse_.half_faces(cell)) {
        for (const VertexId vertex : coarse_.vertices(half_face.face())) {
          offsets[first_child[i] + corner_of(coarse_, cell, vertex) + 1] += 2;
        }
      }
    });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    return offsets;
  }

  /// The cells, one for each corner: the faces at the corner, then the inner faces at its edges.
  [[nodiscard]] CompressedRows<std::int32_t> cells() const {
    std::vector<std::uint32_t> first_child(coarse_.n_cells() + 1, 0);
    for (const CellId cell : coarse_.cells()) {
      first_child[cell.index() + 1] =
          first_child[cell.index()] + static_cast<std::uint32_t>(coarse_.vertices(cell).size());
    }
    std::vector<std::uint32_t> offsets = child_offsets(first_child);
    const CompressedRows<std::int32_t> inner_of_cell = inner_faces_of_cells();
    std::vector<std::int32_t> half_faces(offsets.back());
    parallel_ranges(coarse_.n_cells(), 1024, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> place;  // where each corner's next half-face goes
      for (std::size_t i = begin; i < end; ++i) {
        const CellId cell{static_cast<std::int32_t>(i)};
        place.assign(offsets.begin() + first_child[i], offsets.begin() + first_child[i + 1]);
        const auto append = [&](VertexId corner, std::int32_t half_face) {
          half_faces[place[corner_of(coarse_, cell, corner)]++] = half_face;
        };
        for (const HalfFaceId half_face : coarse_.half_faces(cell)) {
          std::int32_t refined = first_corner_[half_face.face().index()];
          for (const VertexId corner : coarse_.vertices(half_face.face())) {
            append(corner, 2 * refined++ + half_face.side());
          }
        }
        for (const std::int32_t inner : inner_of_cell[i]) {
          const auto& ends = coarse_.vertices(inner_[static_cast<std::size_t>(inner)].edge);
          const std::int32_t refined = first_corner_.back() + inner;
          append(ends[0], 2 * refined);
          append(ends[1], 2 * refined + 1);
        }
      }
    });
    return CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(half_faces));
  }

  [[nodiscard]] CompressedRows<std::int32_t> inner_faces_of_cells() const {
    std::vector<std::uint32_t> offsets(coarse_.n_cells() + 2, 0);
    for (const InnerFace& face : inner_) {
      ++offsets[face.cell.index() + 2];
    }
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    std::vector<std::int32_t> values(inner_.size());
    for (std::size_t i = 0; i < inner_.size(); ++i) {
      values[offsets[inner_[i].cell.index() + 1]++] = static_cast<std::int32_t>(i);
    }
    offsets.pop_back();
    return CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(values));
  }

  const CellComplex& coarse_;
  std::vector<InnerFace> inner_;
  std::vector<std::int32_t> first_corner_;  // of each face, among all corners
};

Sharpness refined_sharpness(const Sharpness& coarse, const CellComplex& refined,
                            const ParentMap& parents) {
  Sharpness sharpness = smooth_sharpness(refined);
  parallel_for(refined.n_edges(), [&](std::size_t i) {
    const EdgeId edge{static_cast<std::int32_t>(i)};
    const Parent parent = parents.parent(edge, refined);
    if (parent.kind == Parent::Kind::Edge) {
      sharpness.edges[edge] = osd::refined_sharpness(coarse.edges[EdgeId{parent.index}]);
    }
  });
  for (std::size_t i = 0; i < coarse.vertices.size(); ++i) {
    const VertexId vertex{static_cast<std::int32_t>(i)};
    sharpness.vertices[parents.vertex_point(vertex)] =
        osd::refined_sharpness(coarse.vertices[vertex]);
  }
  return sharpness;
}

}  // namespace

ParentMap::ParentMap(const CellComplex& coarse, std::vector<Parent> faces,
                     std::vector<CellId> cells)
    : first_edge_point_(static_cast<std::int32_t>(coarse.n_vertices())),
      first_face_point_(first_edge_point_ + static_cast<std::int32_t>(coarse.n_edges())),
      first_cell_point_(first_face_point_ + static_cast<std::int32_t>(coarse.n_faces())),
      faces_(std::move(faces)),
      cells_(std::move(cells)) {}

Parent ParentMap::parent(VertexId refined) const {
  if (refined.value >= first_cell_point_) {
    return {Parent::Kind::Cell, refined.value - first_cell_point_};
  }
  if (refined.value >= first_face_point_) {
    return {Parent::Kind::Face, refined.value - first_face_point_};
  }
  if (refined.value >= first_edge_point_) {
    return {Parent::Kind::Edge, refined.value - first_edge_point_};
  }
  return {Parent::Kind::Vertex, refined.value};
}

Parent ParentMap::parent(EdgeId refined, const CellComplex& refined_complex) const {
  // Points of larger elements have larger numbers, and an edge's second vertex is the larger one.
  return parent(refined_complex.vertices(refined)[1]);
}

Refinement refine(const CellComplex& complex, const Sharpness& sharpness, Scheme scheme) {
  check_size(complex);
  const RefinedTables tables(complex);
  Refinement refinement;
  refinement.parents = ParentMap(complex, tables.face_parents(), tables.cell_parents());
  refinement.complex = std::make_shared<const CellComplex>(
      CellComplex::from_valid(tables.polyhedra(refinement.parents)));
  refinement.sharpness = refined_sharpness(sharpness, *refinement.complex, refinement.parents);
  refinement.stencils = refinement_stencils(complex, sharpness, scheme);
  return refinement;
}

std::vector<Refinement> refine(const SubdivisionLattice& lattice, int levels,
                               const Progress& progress) {
  std::vector<Refinement> refinements;
  const Sharpness sharpness = with_touching_elements(*lattice.complex, lattice.sharpness);
  for (int level = 0; level < levels; ++level) {
    // Each level has about eight times the cells of the one before.
    progress.update("refine", level == 0 ? 0.0 : std::pow(8.0, level - levels));
    refinements.push_back(level == 0 ? refine(*lattice.complex, sharpness, lattice.scheme)
                                     : refine(*refinements.back().complex,
                                              refinements.back().sharpness, lattice.scheme));
  }
  progress.update("refine", 1.0);
  return refinements;
}

SubdivisionLattice refined(const SubdivisionLattice& lattice, int levels,
                           const Progress& progress) {
  SubdivisionLattice result = lattice;
  for (Refinement& level : refine(lattice, levels, progress)) {
    result.complex = std::move(level.complex);
    result.sharpness = std::move(level.sharpness);
    result.rest = level.stencils.apply(result.rest);
    if (!result.pose.empty()) {
      result.pose = level.stencils.apply(result.pose);
    }
  }
  return result;
}

}  // namespace espalier
