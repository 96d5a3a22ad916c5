#include "deform/fit/conversion.h"

#include "deform/embed/embed.h"
#include "lattice/subdivision/freeze.h"

namespace espalier {

Conversion measured(const SubdivisionLattice& lattice, const Model& model,
                    const Progress& progress) {
  const Volume volume = freeze_adaptive(lattice, {.tolerance = 1e-3, .most_levels = 2}, progress);
  const StatusCounts counts = embed(volume, model.points(), progress).counts();
  return {model.points().size(), counts.inside + counts.border, {}, 0};
}

}  // namespace espalier
