#pragma once

/// Everything that can be wrong with a lattice, named.

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/topology/cell_complex.h"
#include "lattice/topology/defect.h"
#include "lattice/topology/polyhedra.h"

namespace espalier {

/// Defects that show once edges are built: TooFewFacesAtEdge, EdgeEnclosedTwice.
[[nodiscard]] std::vector<Defect> find_edge_defects(const CellComplex& complex);

/// Defects of a complex at rest points: NotFinite … IntersectingCells. Later kinds are looked for
/// only where earlier ones leave sense in it. Lengths below 1e-9 of the lattice's diagonal count as
/// zero. points: #vertices, model units. About O(n log n).
[[nodiscard]] std::vector<Defect> find_geometric_defects(const CellComplex& complex,
                                                         std::span<const glm::dvec3> points,
                                                         const Progress& progress = {});

/// The complex of oriented tables that are valid at rest points; throws LatticeError with the first
/// defect otherwise.
[[nodiscard]] std::shared_ptr<const CellComplex> valid_complex(Polyhedra polyhedra,
                                                               std::span<const glm::dvec3> points,
                                                               const Progress& progress = {});

/// All defects of oriented tables at rest points; empty if the lattice is valid.
[[nodiscard]] std::vector<Defect> validate(const Polyhedra& polyhedra,
                                           std::span<const glm::dvec3> points,
                                           const Progress& progress = {});

}  // namespace espalier
