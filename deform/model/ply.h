#pragma once

/// The polygon file format, PLY.

#include <string>

#include "deform/model/model.h"

namespace espalier {

/// Scans a PLY file: text, or binary of either byte order. Points are the elements "vertex" with
/// x, y, z (and nx, ny, nz) of type float or double; faces the lists "vertex_indices" or
/// "vertex_index" of the elements "face". All other properties and elements are kept as they are.
/// Faces of fewer than three corners are kept in the file but are no faces of the model. A normal
/// that is not finite has no direction.
///
/// path: named in errors and kept as the model's.
/// Throws FileError, naming the line or the element, for a header that is no PLY header, has no
/// points or gives them other types, elements that end before their announced number, a coordinate
/// that is no number, not finite or beyond kLargestCoordinate, and a corner that is no point.
/// O(bytes).
[[nodiscard]] Model parse_ply(std::string path, std::string bytes);

}  // namespace espalier
