#include "lattice/volume/stencil_blocks.h"

#include <algorithm>
#include <compare>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_map>

#include "lattice/core/error.h"
#include "lattice/core/hash.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

constexpr std::size_t kBlocksPerRange = 512;
/// What a block costs besides its columns, in columns: mostly putting its points where they belong.
constexpr std::size_t kBlockCost = 8;

std::span<const std::int32_t> indices(const StencilTable& table, std::int32_t row) {
  return table[static_cast<std::size_t>(row)].indices;
}

/// The table's rows, those with the same indices together, and such next to each other whose
/// indices begin alike. Rows with the same indices are in the order of their weights, so that
/// regions which are made alike are blocked alike.
std::vector<std::int32_t> sorted_rows(const StencilTable& table) {
  std::vector<std::int32_t> rows(table.n_rows());
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](std::int32_t i, std::int32_t j) {
    const StencilTable::Row a = table[static_cast<std::size_t>(i)];
    const StencilTable::Row b = table[static_cast<std::size_t>(j)];
    const auto order = std::lexicographical_compare_three_way(a.indices.begin(), a.indices.end(),
                                                              b.indices.begin(), b.indices.end());
    return order != 0 ? order < 0 : std::ranges::lexicographical_compare(a.weights, b.weights);
  });
  return rows;
}

/// Counts the different columns of rows, from none.
class ColumnCounter {
 public:
  ColumnCounter(const StencilTable& table, std::span<const std::int32_t> rows)
      : table_(table), rows_(rows), last_seen_(table.n_controls(), 0), repeats_(rows.size(), 0) {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      repeats_[i] =
          std::ranges::equal(indices(table, rows[i]), indices(table, rows[i + 1])) ? 1 : 0;
    }
  }

  void start() {
    ++stamp_;
    n_columns_ = 0;
  }
  /// Adds row i of those given, after row i + 1 or as the first.
  std::size_t add(std::size_t i, bool is_first) {
    if (is_first || repeats_[i] == 0) {
      for (const std::int32_t column : indices(table_, rows_[i])) {
        std::uint32_t& seen = last_seen_[static_cast<std::size_t>(column)];
        n_columns_ += seen != stamp_ ? 1 : 0;
        seen = stamp_;
      }
    }
    return n_columns_;
  }

 private:
  const StencilTable& table_;
  std::span<const std::int32_t> rows_;
  std::vector<std::uint32_t> last_seen_;
  std::vector<std::uint8_t> repeats_;  // has the columns of the next row
  std::uint32_t stamp_ = 0;
  std::size_t n_columns_ = 0;
};

/// Where to cut the rows into blocks of at most kStencilRows, so that they cost least in all: the
/// cheapest way to cut the first n rows ends with a block after the cheapest way to cut the rest.
CompressedRows<std::int32_t> cut_rows(const StencilTable& table, std::vector<std::int32_t> rows) {
  std::vector<std::size_t> costs(rows.size() + 1, 0);
  std::vector<std::size_t> begins(rows.size() + 1, 0);
  ColumnCounter counter(table, rows);
  for (std::size_t end = 1; end <= rows.size(); ++end) {
    counter.start();
    costs[end] = std::numeric_limits<std::size_t>::max();
    for (std::size_t begin = end; begin-- > 0 && end - begin <= kStencilRows;) {
      const std::size_t cost = costs[begin] + kBlockCost + counter.add(begin, begin + 1 == end);
      if (cost <= costs[end]) {
        costs[end] = cost;
        begins[end] = begin;
      }
    }
  }
  std::vector<std::uint32_t> offsets;
  for (std::size_t end = rows.size(); end > 0; end = begins[end]) {
    offsets.push_back(static_cast<std::uint32_t>(end));
  }
  offsets.push_back(0);
  std::reverse(offsets.begin(), offsets.end());
  return CompressedRows<std::int32_t>::from_offsets(std::move(offsets), std::move(rows));
}

/// The columns of a block's rows, ascending.
std::vector<std::int32_t> columns_of(const StencilTable& table,
                                     std::span<const std::int32_t> rows) {
  std::vector<std::int32_t> columns;
  for (const std::int32_t row : rows) {
    const auto more = indices(table, row);
    columns.insert(columns.end(), more.begin(), more.end());
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

/// The weights of a block's rows, column by column.
template <class Real>
void find_weights(const StencilTable& table, std::span<const std::int32_t> rows,
                  std::span<const std::int32_t> columns, std::vector<ColumnWeights<Real>>& out) {
  out.assign(columns.size(), {});
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const StencilTable::Row row = table[static_cast<std::size_t>(rows[at])];
    std::size_t column = 0;
    for (std::size_t k = 0; k < row.indices.size(); ++k) {
      while (columns[column] != row.indices[k]) {
        ++column;
      }
      out[column].of_rows[at] = static_cast<Real>(row.weights[k]);
    }
  }
}

/// Stores lists of weights, equal ones once.
template <class Real>
class WeightStore {
 public:
  explicit WeightStore(std::vector<ColumnWeights<Real>>& stored) : stored_(stored) {}

  /// Where the list begins.
  std::uint32_t add(const std::vector<ColumnWeights<Real>>& list) {
    Fingerprint fingerprint;
    for (const ColumnWeights<Real>& weights : list) {
      fingerprint.add_all(std::span<const Real>(weights.of_rows));
    }
    const auto [first, last] = begins_.equal_range(fingerprint.value());
    for (auto same = first; same != last; ++same) {
      if (begins_with(list, same->second)) {
        return same->second;
      }
    }
    const auto begin = row_offset(stored_.size());
    begins_.emplace(fingerprint.value(), begin);
    stored_.insert(stored_.end(), list.begin(), list.end());
    return begin;
  }

 private:
  [[nodiscard]] bool begins_with(const std::vector<ColumnWeights<Real>>& list,
                                 std::size_t begin) const {
    return list.size() <= stored_.size() - begin &&
           std::equal(list.begin(), list.end(), stored_.begin() + static_cast<long>(begin),
                      [](const auto& a, const auto& b) {
                        return std::ranges::equal(a.of_rows, b.of_rows);
                      });
  }

  std::vector<ColumnWeights<Real>>& stored_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> begins_;
};

void require_length(std::size_t n, std::size_t wanted, const char* what) {
  if (n != wanted) {
    throw ParameterError("StencilBlocks: " + std::to_string(n) + " " + what + " given, must be " +
                         std::to_string(wanted));
  }
}

}  // namespace

template <class Real>
StencilBlocks<Real>::StencilBlocks(const StencilTable& table, InstructionSet set)
    : sum_rows_(stencil_kernel<Real>(set)),
      n_controls_(table.n_controls()),
      rows_(cut_rows(table, sorted_rows(table))) {
  WeightStore<Real> store(weights_);
  std::vector<ColumnWeights<Real>> of_block;
  for (std::size_t block = 0; block < rows_.n_rows(); ++block) {
    columns_.push_back(columns_of(table, rows_[block]));
    find_weights(table, rows_[block], columns_[block], of_block);
    first_weights_.push_back(store.add(of_block));
  }
  columns_.shrink_to_fit();
  first_weights_.shrink_to_fit();
  weights_.shrink_to_fit();
}

template <class Real>
void StencilBlocks<Real>::apply(std::span<const Point> controls, std::span<Point> points) const {
  require_length(controls.size(), n_controls(), "control points");
  require_length(points.size(), n_rows(), "points");
  const auto sum_block = [&](std::size_t block) {
    const auto columns = columns_[block];
    Point sums[kStencilRows];
    sum_rows_(columns.data(), columns.size(), weights_.data() + first_weights_[block],
              reinterpret_cast<const Real*>(controls.data()), glm::value_ptr(sums[0]));
    const auto rows = rows_[block];
    for (std::size_t at = 0; at < rows.size(); ++at) {
      points[static_cast<std::size_t>(rows[at])] = sums[at];
    }
  };
  parallel_for(rows_.n_rows(), sum_block, kBlocksPerRange);
}

template <class Real>
std::size_t StencilBlocks<Real>::bytes() const {
  return rows_.bytes() + columns_.bytes() + first_weights_.capacity() * sizeof(std::uint32_t) +
         weights_.capacity() * sizeof(ColumnWeights<Real>);
}

template class StencilBlocks<float>;
template class StencilBlocks<double>;

}  // namespace espalier
