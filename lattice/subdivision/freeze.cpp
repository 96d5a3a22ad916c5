#include "lattice/subdivision/freeze.h"

#include <string>
#include <utility>
#include <vector>

#include "lattice/core/error.h"
#include "lattice/subdivision/refine.h"
#include "lattice/topology/hexahedron.h"

namespace espalier {
namespace {

constexpr int kMostLevels = 8;

/// Patches and their blocks of eight points, all trilinear.
struct Leaves {
  std::vector<Patch> patches;
  std::vector<std::int32_t> points;
};

void add_hexahedron(Leaves& leaves, const CellComplex& complex, const Hexahedron& hexahedron) {
  Patch patch;
  for (std::size_t face = 0; face < 6; ++face) {
    if (complex.is_boundary(hexahedron.faces[face].face())) {
      patch.boundary_faces = static_cast<std::uint8_t>(patch.boundary_faces | (1u << face));
    }
  }
  leaves.patches.push_back(patch);
  for (const VertexId corner : hexahedron.corners) {
    leaves.points.push_back(corner.value);
  }
}

/// The pyramid from a quadrilateral side to the apex; the side becomes w = 0, corners 0 2 3 1.
void add_pyramid(Leaves& leaves, const CellComplex& complex, HalfFaceId base, std::int32_t apex) {
  Patch patch;
  patch.is_pyramid = true;
  if (complex.is_boundary(base.face())) {
    patch.boundary_faces = 1u << 4;
  }
  leaves.patches.push_back(patch);
  const std::vector<VertexId> corners = loop(complex, base);
  leaves.points.insert(leaves.points.end(), {corners[0].value, corners[3].value, corners[1].value,
                                             corners[2].value, apex, apex, apex, apex});
}

/// The points of the last refinement over the control points. Takes the refinements' stencils, so
/// that no more than two levels are held at a time.
StencilTable composed(std::vector<Refinement>& refinements) {
  StencilTable stencils = std::move(refinements.front().stencils);
  for (std::size_t level = 1; level < refinements.size(); ++level) {
    const StencilTable next = std::move(refinements[level].stencils);
    stencils = compose(stencils, next);
  }
  return stencils;
}

/// The rows of `table`, then the mean of the rows of each cell's vertices.
StencilTable with_centroids(const StencilTable& table, const CellComplex& complex,
                            const std::vector<CellId>& cells) {
  const std::size_t n = table.n_rows();
  return StencilTable::build(
      n + cells.size(), table.n_controls(), [&](std::size_t i, StencilRow& out) {
        const auto add_row = [&](std::size_t row, double weight) {
          const StencilTable::Row source = table[row];
          for (std::size_t k = 0; k < source.indices.size(); ++k) {
            out.add(source.indices[k], weight * source.weights[k]);
          }
        };
        if (i < n) {
          add_row(i, 1.0);
          return;
        }
        const auto vertices = complex.vertices(cells[i - n]);
        for (const VertexId vertex : vertices) {
          add_row(vertex.index(), 1.0 / static_cast<double>(vertices.size()));
        }
      });
}

}  // namespace

Volume freeze_uniform(const SubdivisionLattice& lattice, int levels, const Progress& progress) {
  return {uniform_tables(lattice, levels, progress), lattice.rest};
}

VolumeTables uniform_tables(const SubdivisionLattice& lattice, int levels,
                            const Progress& progress) {
  if (levels < 1 || levels > kMostLevels) {
    throw ParameterError("freeze: uniform levels is " + std::to_string(levels) + ", must be 1 to " +
                         std::to_string(kMostLevels));
  }
  std::vector<Refinement> refinements = refine(lattice, levels, progress);
  const CellComplex& complex = *refinements.back().complex;
  Leaves leaves;
  std::vector<CellId> split_cells;
  for (const CellId cell : complex.cells()) {
    if (const auto leaf = hexahedron(complex, cell)) {
      add_hexahedron(leaves, complex, *leaf);
      continue;
    }
    const auto apex = static_cast<std::int32_t>(complex.n_vertices() + split_cells.size());
    split_cells.push_back(cell);
    for (const HalfFaceId side : complex.half_faces(cell)) {
      add_pyramid(leaves, complex, side, apex);
    }
  }
  StencilTable stencils = composed(refinements);
  if (!split_cells.empty()) {
    stencils = with_centroids(stencils, complex, split_cells);
  }
  return {std::move(stencils),
          {bezier_extraction(1)},
          std::move(leaves.patches),
          CompressedRows<std::int32_t>::uniform(8, std::move(leaves.points))};
}

}  // namespace espalier
