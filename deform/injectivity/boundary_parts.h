#pragma once

/// The parts of a boundary, and whether one lies inside another.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "deform/injectivity/boundary_seams.h"

namespace espalier {

/// #faces: the number of the part that each hangs together with along seams of two faces, from 0 in
/// the order of their first faces. Where cells only touch, parts end.
[[nodiscard]] std::vector<std::int32_t> boundary_parts(const BoundaryMesh& mesh);

/// Whether every point of space is inside as many parts, counted by their sides, as the volume
/// covers it at most once: 1 inside a part that is seen from its volume's outside, less 1 inside a
/// hollow's wall. Of a simple boundary in the pose; is_mirrored: the patches are left-handed there.
/// False too if it cannot be told. O(#parts · #faces).
[[nodiscard]] bool is_covered_once(const BoundaryMesh& mesh, std::span<const std::int32_t> parts,
                                   bool is_mirrored);

}  // namespace espalier
