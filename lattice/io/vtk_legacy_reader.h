#pragma once

/// Legacy VTK volume meshes (.vtk, text, UNSTRUCTURED_GRID).

#include <string>
#include <string_view>

#include "lattice/io/lattice_file.h"

namespace espalier {

/// Reads the linear tetrahedra, voxels, hexahedra, wedges and pyramids of an unstructured grid, of
/// file versions up to 4.2 and from 5.1; cells of lower dimension are skipped, data that follow are
/// not read. Throws FileError at the line for anything else, indices out of range, missing
/// elements, or a file without cells.
[[nodiscard]] RawLattice parse_vtk_legacy(const std::string& path, std::string_view text);

}  // namespace espalier
