#pragma once

/// OpenVolumeMesh ASCII (.ovm): a header "OVM ASCII", the sections Vertices, Edges, Faces (of
/// half-edges 2e, 2e + 1) and Polyhedra (of half-faces 2f, 2f + 1), each with its count, then
/// properties with one value an element. Blank lines and lines that begin with '#' are skipped.
/// What OpenVolumeMesh has no place for is in properties of ours:
///
///     MProp string "espalier:scheme"        "catmull-clark" (also when absent) or "mj96"
///     EProp float  "espalier:sharpness"     absent: automatic tags
///     VProp float  "espalier:sharpness"     absent: automatic tags
///     VProp vec3d  "espalier:pose"          absent: at rest
///     MProp string "espalier:extra"         keys of the JSON file that are not ours, an object
///
/// Other properties are skipped. Strings are written as "LENGTH:BYTES", as OpenVolumeMesh does.

#include <string>
#include <string_view>

#include "lattice/io/lattice_file.h"

namespace espalier {

/// Throws FileError naming the line. O(n log n); memory is reserved only for what the file's size
/// allows.
[[nodiscard]] RawLattice parse_ovm(const std::string& path, std::string_view text);

}  // namespace espalier
