#include "deform/model/pairs.h"

#include <algorithm>
#include <utility>

namespace espalier {

CompressedRows<std::int32_t> rows_by_key(std::span<const std::int32_t> keys, std::size_t n_rows) {
  std::vector<std::uint32_t> offsets(n_rows + 1, 0);
  for (const std::int32_t key : keys) {
    if (key >= 0) {
      ++offsets[static_cast<std::size_t>(key) + 1];
    }
  }
  for (std::size_t row = 0; row < n_rows; ++row) {
    offsets[row + 1] += offsets[row];
  }
  std::vector<std::int32_t> values(offsets.back());
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] >= 0) {
      values[next[static_cast<std::size_t>(keys[i])]++] = static_cast<std::int32_t>(i);
    }
  }
  return CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(values));
}

UniquePairs unique_pairs(std::span<const PointNormal> uses, std::size_t n_points) {
  UniquePairs result;
  result.pair_of_use.resize(uses.size());
  for (std::size_t use = 0; use < uses.size(); ++use) {
    result.pair_of_use[use] = uses[use].normal < 0 ? -1 : uses[use].point;
  }
  CompressedRows<std::int32_t> uses_of_point = rows_by_key(result.pair_of_use, n_points);
  for (std::size_t point = 0; point < n_points; ++point) {
    const std::span<std::int32_t> row = uses_of_point[point];
    std::sort(row.begin(), row.end(),
              [uses](std::int32_t a, std::int32_t b) { return uses[a].normal < uses[b].normal; });
    for (const std::int32_t use : row) {
      if (result.pairs.empty() || result.pairs.back() != uses[use]) {
        result.pairs.push_back(uses[use]);
      }
      result.pair_of_use[use] = static_cast<std::int32_t>(result.pairs.size()) - 1;
    }
  }
  return result;
}

void pair_points_with_own_normals(ModelLayout& layout) {
  for (std::size_t i = 0; i < layout.points.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    layout.pairs.push_back({index, index});
  }
  const std::span<const std::int32_t> corners = layout.faces.values();
  layout.corners.pairs.assign(corners.begin(), corners.end());
}

}  // namespace espalier
