#pragma once

/// Geomview's OFF.

#include <string>

#include "deform/model/model.h"

namespace espalier {

/// Scans the text of an OFF file: OFF, and COFF, NOFF, STOFF and their combinations, of whose
/// colours and texture coordinates nothing is asked. Normals (NOFF) belong to their points. Faces
/// of fewer than three corners are kept in the file but are no faces of the model.
///
/// path: named in errors and kept as the model's.
/// Throws FileError, naming the line, for another kind of file (binary, four or n dimensions),
/// counts that are missing or larger than what follows, a coordinate that is missing, no number,
/// not finite or beyond kLargestCoordinate, and a corner that is no point. O(bytes).
[[nodiscard]] Model parse_off(std::string path, std::string bytes);

}  // namespace espalier
