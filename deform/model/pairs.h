#pragma once

/// Which (point, normal) pairs occur in a model.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "deform/model/model_layout.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

/// Row k: the indices i with keys[i] = k, increasing. Negative keys are in no row. O(keys + rows).
[[nodiscard]] CompressedRows<std::int32_t> rows_by_key(std::span<const std::int32_t> keys,
                                                       std::size_t n_rows);

struct UniquePairs {
  std::vector<PointNormal> pairs;         ///< each once, sorted by point, then normal
  std::vector<std::int32_t> pair_of_use;  ///< #uses, -1 for a use without normal
};

/// The different pairs among `uses`; those with normal -1 are no pairs.
/// O(uses + points), times the logarithm of the number of uses of one point.
[[nodiscard]] UniquePairs unique_pairs(std::span<const PointNormal> uses, std::size_t n_points);

/// Makes normal i that of point i, wherever the point is used. layout: #P normals, and its faces.
void pair_points_with_own_normals(ModelLayout& layout);

}  // namespace espalier
