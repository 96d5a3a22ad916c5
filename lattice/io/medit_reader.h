#pragma once

/// MEDIT volume meshes (.mesh, text).

#include <string>
#include <string_view>

#include "lattice/io/lattice_file.h"

namespace espalier {

/// Reads Vertices, Tetrahedra, Pyramids, Prisms and Hexahedra; other keywords are skipped. Throws
/// FileError at the line for anything that is not MEDIT's text format in three dimensions, indices
/// out of range, missing elements, or a file without cells.
[[nodiscard]] RawLattice parse_medit(const std::string& path, std::string_view text);

}  // namespace espalier
