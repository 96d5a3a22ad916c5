#pragma once

/// Wavefront OBJ.

#include <string>

#include "deform/model/model.h"

namespace espalier {

/// Scans the text of an OBJ file. Points are all `v`, also those that only free-form curves and
/// surfaces use; of their further numbers (weight, colour) nothing is asked. Faces are `f` (and
/// the old `fo`). Groups are the names of `g` and `o`. Every other statement is kept as it is.
///
/// The file's coordinates are taken to be doubles if one of them has more than nine significant
/// digits, else floats; what deforming changes is written at that precision.
///
/// path: named in errors and kept as the model's.
/// Throws FileError, naming the line, for a coordinate that is missing, no number, not finite or
/// beyond kLargestCoordinate; a face with fewer than three corners; a reference that is no number,
/// 0, or to something that the file has not; and for a file without any `v`. By absolute numbers a
/// face may name what only comes later; and where a file has no `vt` or no `vn` at all, numbers
/// that name one are left alone. O(bytes).
[[nodiscard]] Model parse_obj(std::string path, std::string bytes);

}  // namespace espalier
