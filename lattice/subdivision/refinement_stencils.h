#pragma once

/// The points of one refinement as combinations of the coarse vertices.

#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/sharpness.h"
#include "lattice/volume/stencil_table.h"

namespace espalier {

/// Rows: vertex points, edge points, face points, cell points, each in the order of the coarse
/// elements. Inner rows follow masks.h, boundary rows lattice/osd/crease_masks.h. Rows sum to 1.
[[nodiscard]] StencilTable refinement_stencils(const CellComplex& complex,
                                               const Sharpness& sharpness, Scheme scheme);

}  // namespace espalier
