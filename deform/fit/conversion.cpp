#include "deform/fit/conversion.h"

#include "deform/embed/embed.h"
#include "lattice/subdivision/freeze.h"

namespace espalier {
namespace {

/// Cells with more faces take too long to refine for a mere count.
constexpr std::size_t kMostFaces = 128;
/// Lattices of more cells are fine enough to be refined once.
constexpr std::size_t kMostCoarseCells = 20000;

}  // namespace

Conversion measured(const SubdivisionLattice& lattice, const Model& model,
                    const Progress& progress) {
  const CellComplex& complex = *lattice.complex;
  for (const CellId cell : complex.cells()) {
    if (complex.half_faces(cell).size() > kMostFaces) {
      return {};
    }
  }
  const int levels = complex.n_cells() > kMostCoarseCells ? 1 : 2;
  const Volume volume = freeze_uniform(lattice, levels, progress);
  const StatusCounts counts = embed(volume, model.points(), progress).counts();
  return {model.points().size(), counts.inside + counts.border, {}, 0};
}

}  // namespace espalier
