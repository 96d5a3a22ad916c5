#pragma once

/// What operations on lattices have in common.

#include <string>
#include <vector>

#include "deform/scene/operation.h"
#include "lattice/build/cell_mesh.h"

namespace espalier {

[[nodiscard]] const std::vector<std::string>& scheme_names();

[[nodiscard]] Parameter result_parameter(const char* help);
[[nodiscard]] Parameter scheme_parameter();
[[nodiscard]] Scheme scheme_of(const Arguments& arguments, Scheme fallback);
[[nodiscard]] Parameter sharp_parameter();
/// "freeze", as freeze() takes it.
[[nodiscard]] Parameter freeze_parameter();

/// The scene with a new lattice named "output", its scheme and tags by "scheme" and "sharp". Throws
/// LatticeError if the mesh is no valid lattice, which blames `source`, or "output" if that is
/// empty; ParameterError for a bad "sharp".
[[nodiscard]] Scene add_lattice(const Scene& scene, const Arguments& arguments, CellMesh mesh,
                                const Progress& progress, const std::string& source = {});
/// The same with a lattice that is valid; it keeps its own tags where "sharp" is absent.
[[nodiscard]] Scene add_lattice(const Scene& scene, const Arguments& arguments,
                                SubdivisionLattice lattice);

}  // namespace espalier
