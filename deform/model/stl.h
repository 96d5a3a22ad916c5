#pragma once

/// Stereolithography files, STL.

#include <string>

#include "deform/model/model.h"

namespace espalier {

/// Scans an STL file, text or binary. Corners at one and the same place are one point: points are
/// numbered as they first appear. Solids with a name are groups. A facet's normal is no normal of
/// the model's points: it follows from its triangle when that moves, unless it is zero.
///
/// path: named in errors and kept as the model's.
/// Throws FileError, naming the line or the facet, for a file that is neither, facets that are not
/// whole or fewer than announced, a coordinate that is no number, not finite or beyond
/// kLargestCoordinate, and for a file without facets. O(bytes log bytes).
[[nodiscard]] Model parse_stl(std::string path, std::string bytes);

}  // namespace espalier
