#pragma once

/// Gmsh volume meshes (.msh, text, version 4.1).

#include <string>
#include <string_view>

#include "lattice/io/lattice_file.h"

namespace espalier {

/// Reads the linear tetrahedra, hexahedra, prisms and pyramids; elements of lower dimension and
/// other sections are skipped. Throws FileError at the line for other versions, binary files,
/// volume elements of higher order, nodes that do not exist, missing elements, or a file without
/// cells.
[[nodiscard]] RawLattice parse_gmsh(const std::string& path, std::string_view text);

}  // namespace espalier
