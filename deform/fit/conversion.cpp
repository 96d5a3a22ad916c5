#include "deform/fit/conversion.h"

#include "deform/embed/embed.h"
#include "lattice/subdivision/freeze.h"

namespace espalier {
namespace {

/// Cells with more faces take too long to freeze for a mere count.
constexpr std::size_t kMostFaces = 32;

}  // namespace

Conversion measured(const SubdivisionLattice& lattice, const Model& model,
                    const Progress& progress) {
  const CellComplex& complex = *lattice.complex;
  for (const CellId cell : complex.cells()) {
    if (complex.half_faces(cell).size() > kMostFaces) {
      return {};
    }
  }
  const Volume volume = freeze_adaptive(lattice, {.tolerance = 1e-3, .most_levels = 2}, progress);
  const StatusCounts counts = embed(volume, model.points(), progress).counts();
  return {model.points().size(), counts.inside + counts.border, {}, 0};
}

}  // namespace espalier
