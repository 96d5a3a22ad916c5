#include "lattice/volume/stencil_table.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <utility>

#include "lattice/core/compressed_rows.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kRowsPerRange = 512;
constexpr std::size_t kRangesPerWave = 64;
constexpr std::size_t kSampleStep = 61;  // of rows that tell how long the others will be
constexpr std::size_t kProductsPerRange = 4096;

/// The rows of one range, before they are joined.
struct Block {
  std::vector<std::uint32_t> lengths;
  std::vector<std::int32_t> indices;
  std::vector<double> weights;

  void clear() {
    lengths.clear();
    indices.clear();
    weights.clear();
  }
};

glm::dvec3 weighted_sum(const StencilTable::Row& row, std::span<const glm::dvec3> controls) {
  glm::dvec3 sum(0);
  for (std::size_t k = 0; k < row.indices.size(); ++k) {
    sum += row.weights[k] * controls[static_cast<std::size_t>(row.indices[k])];
  }
  return sum;
}

}  // namespace

void StencilRow::reset(std::size_t n_controls) {
  for (const std::int32_t index : touched_) {
    weights_[static_cast<std::size_t>(index)] = 0;
    is_touched_[static_cast<std::size_t>(index)] = 0;
  }
  touched_.clear();
  if (weights_.size() < n_controls) {
    weights_.resize(n_controls, 0);
    is_touched_.resize(n_controls, 0);
  }
}

void StencilRow::finish(std::vector<std::int32_t>& indices, std::vector<double>& weights) {
  std::sort(touched_.begin(), touched_.end());
  for (const std::int32_t index : touched_) {
    const double weight = weights_[static_cast<std::size_t>(index)];
    if (weight != 0) {
      indices.push_back(index);
      weights.push_back(weight);
    }
  }
}

StencilTable StencilTable::build(std::size_t n_rows, std::size_t n_controls,
                                 const std::function<void(std::size_t, StencilRow&)>& fill) {
  const auto fill_rows = [&](std::size_t begin, std::size_t end, std::size_t step, Block& block) {
    thread_local StencilRow row;  // as large as the widest table so far; cleared row by row
    block.clear();
    for (std::size_t i = begin; i < end; i += step) {
      row.reset(n_controls);
      fill(i, row);
      const std::size_t length_before = block.indices.size();
      row.finish(block.indices, block.weights);
      block.lengths.push_back(static_cast<std::uint32_t>(block.indices.size() - length_before));
    }
  };
  StencilTable table;
  table.n_controls_ = n_controls;
  table.offsets_.reserve(n_rows + 1);
  std::vector<Block> blocks(std::min(kRangesPerWave, n_rows / kRowsPerRange + 1));
  if (n_rows > blocks.size() * kRowsPerRange) {  // or growing would take as much memory again
    fill_rows(0, n_rows, kSampleStep, blocks[0]);
    const double n_expected =
        1.05 * static_cast<double>(kSampleStep) * static_cast<double>(blocks[0].indices.size());
    table.indices_.reserve(static_cast<std::size_t>(n_expected));
    table.weights_.reserve(static_cast<std::size_t>(n_expected));
  }
  const std::size_t wave = blocks.size() * kRowsPerRange;
  for (std::size_t first = 0; first < n_rows; first += wave) {
    const std::size_t n = std::min(wave, n_rows - first);
    parallel_ranges(n, kRowsPerRange, [&](std::size_t begin, std::size_t end) {
      fill_rows(first + begin, first + end, 1, blocks[begin / kRowsPerRange]);
    });
    if (n == n_rows) {
      std::size_t n_weights = 0;
      for (const Block& block : blocks) {
        n_weights += block.indices.size();
      }
      table.indices_.reserve(n_weights);
      table.weights_.reserve(n_weights);
    }
    for (std::size_t i = 0; i * kRowsPerRange < n; ++i) {
      const Block& block = blocks[i];
      static_cast<void>(row_offset(table.indices_.size() + block.indices.size()));
      for (const std::uint32_t length : block.lengths) {
        table.offsets_.push_back(table.offsets_.back() + length);
      }
      table.indices_.insert(table.indices_.end(), block.indices.begin(), block.indices.end());
      table.weights_.insert(table.weights_.end(), block.weights.begin(), block.weights.end());
    }
  }
  return table;
}

std::vector<glm::dvec3> StencilTable::apply(std::span<const glm::dvec3> controls) const {
  assert(controls.size() == n_controls_);
  std::vector<glm::dvec3> points(n_rows());
  parallel_for(
      n_rows(), [&](std::size_t i) { points[i] = weighted_sum((*this)[i], controls); },
      kProductsPerRange);
  return points;
}

void StencilTable::apply(std::span<const glm::dvec3> controls, std::span<const std::int32_t> rows,
                         std::span<glm::dvec3> points) const {
  assert(controls.size() == n_controls_ && points.size() == n_rows());
  parallel_for(
      rows.size(),
      [&](std::size_t i) {
        const auto row = static_cast<std::size_t>(rows[i]);
        points[row] = weighted_sum((*this)[row], controls);
      },
      kProductsPerRange);
}

StencilTable StencilTable::transpose() const {
  StencilTable result;
  result.n_controls_ = n_rows();
  // Row j starts at offsets[j + 1] until it is filled, which moves it to its end.
  std::vector<std::uint32_t> offsets(n_controls_ + 2, 0);
  for (const std::int32_t index : indices_) {
    ++offsets[static_cast<std::size_t>(index) + 2];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  result.indices_.resize(n_weights());
  result.weights_.resize(n_weights());
  for (std::size_t i = 0; i < n_rows(); ++i) {
    const Row row = (*this)[i];
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      const std::uint32_t place = offsets[static_cast<std::size_t>(row.indices[k]) + 1]++;
      result.indices_[place] = static_cast<std::int32_t>(i);
      result.weights_[place] = row.weights[k];
    }
  }
  offsets.pop_back();
  result.offsets_ = std::move(offsets);
  return result;
}

std::size_t StencilTable::bytes() const {
  return offsets_.size() * sizeof(std::uint32_t) + indices_.size() * sizeof(std::int32_t) +
         weights_.size() * sizeof(double);
}

ReachedRows::ReachedRows(const StencilTable& table)
    : transposed_(table.transpose()), is_reached_((table.n_rows() + 63) / 64, 0) {}

std::span<const std::int32_t> ReachedRows::of(std::span<const std::int32_t> controls) {
  for (const std::int32_t control : controls) {
    for (const std::int32_t row : transposed_[static_cast<std::size_t>(control)].indices) {
      is_reached_[static_cast<std::size_t>(row) / 64] |= std::uint64_t{1} << (row % 64);
    }
  }
  rows_.clear();
  for (std::size_t word = 0; word < is_reached_.size(); ++word) {
    for (std::uint64_t& bits = is_reached_[word]; bits != 0; bits &= bits - 1) {
      rows_.push_back(static_cast<std::int32_t>(64 * word) + std::countr_zero(bits));
    }
  }
  return rows_;
}

StencilTable compose(const StencilTable& first, const StencilTable& second) {
  assert(second.n_controls() == first.n_rows());
  return StencilTable::build(
      second.n_rows(), first.n_controls(), [&](std::size_t i, StencilRow& row) {
        const StencilTable::Row outer = second[i];
        for (std::size_t k = 0; k < outer.indices.size(); ++k) {
          const StencilTable::Row inner = first[static_cast<std::size_t>(outer.indices[k])];
          for (std::size_t l = 0; l < inner.indices.size(); ++l) {
            row.add(inner.indices[l], outer.weights[k] * inner.weights[l]);
          }
        }
      });
}

}  // namespace espalier
