#pragma once

/// Rows of weights as others read them: what our kernels are measured against.

#include <opensubdiv/osd/cpuEvaluator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::bench {

/// Compressed rows in float, and the ways to apply them to points of four numbers each.
struct WeightRows {
  std::vector<int> sizes, offsets, indices;
  std::vector<float> weights;

  template <class Weight>
  void add(std::span<const std::int32_t> row, std::span<const Weight> row_weights) {
    sizes.push_back(static_cast<int>(row.size()));
    offsets.push_back(static_cast<int>(indices.size()));
    indices.insert(indices.end(), row.begin(), row.end());
    for (const Weight weight : row_weights) {
      weights.push_back(static_cast<float>(weight));
    }
  }

  void apply_as_opensubdiv(const float* from, float* to) const {
    using OpenSubdiv::Osd::BufferDescriptor;
    OpenSubdiv::Osd::CpuEvaluator::EvalStencils(
        from, BufferDescriptor(0, 3, 4), to, BufferDescriptor(0, 3, 4), sizes.data(),
        offsets.data(), indices.data(), weights.data(), 0, static_cast<int>(sizes.size()));
  }

  void apply_plainly(const float* from, float* to) const {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      float sum[3] = {0, 0, 0};
      for (int k = offsets[i]; k < offsets[i] + sizes[i]; ++k) {
        const float* const point = from + 4 * indices[static_cast<std::size_t>(k)];
        const float weight = weights[static_cast<std::size_t>(k)];
        sum[0] += weight * point[0];
        sum[1] += weight * point[1];
        sum[2] += weight * point[2];
      }
      std::copy_n(sum, 3, to + 4 * i);
    }
  }
};

}  // namespace espalier::bench
