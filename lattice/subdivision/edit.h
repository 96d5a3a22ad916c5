#pragma once

/// Edits of meshes applied to lattices: a lattice stays valid, or nothing changes.

#include "lattice/build/mesh_draft.h"
#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier {

/// The lattice's cells at rest.
[[nodiscard]] CellMesh mesh_of(const SubdivisionLattice& lattice);

/// The lattice after an edit of its mesh_of(). The pose follows as Edited says. Sharpness: tags
/// that are all automatic, or all smooth, stay so. Otherwise an edge or vertex whose tag was
/// automatic gets the automatic one of its new place; one whose tag was set by hand keeps it, as do
/// copies and parts of it, while it is on the boundary; of several that became one the sharpest
/// counts; new ones get automatic tags. Throws LatticeError with the first defect if the result is
/// no valid cell complex. About O(n log n).
[[nodiscard]] SubdivisionLattice edited_lattice(const SubdivisionLattice& lattice, Edited edit,
                                                const Progress& progress = {});

/// Two lattices as one, then edited; `edit` gets the cells of both side by side. The scheme and
/// unknown keys are the first's. Throws as edited_lattice().
[[nodiscard]] SubdivisionLattice merged_lattice(const SubdivisionLattice& first,
                                                const SubdivisionLattice& second, double tolerance,
                                                const Progress& progress = {});

}  // namespace espalier
