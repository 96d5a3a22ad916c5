#pragma once

/// Rows of varying length in two arrays.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lattice/core/error.h"

namespace espalier {

/// n as an offset of a row. Throws Error beyond 2^32 - 1.
[[nodiscard]] inline std::uint32_t row_offset(std::size_t n) {
  if (n > std::numeric_limits<std::uint32_t>::max()) {
    throw Error("a table of " + std::to_string(n) + " values is too large: it can hold " +
                std::to_string(std::numeric_limits<std::uint32_t>::max()));
  }
  return static_cast<std::uint32_t>(n);
}

/// `n_rows()` rows of values, stored end to end. Rows that all have one length store no offsets.
/// Offsets are 32 bit: what would make it hold more than 2^32 - 1 values throws Error.
template <class T>
class CompressedRows {
 public:
  CompressedRows() = default;
  CompressedRows(std::initializer_list<std::vector<T>> rows) {
    for (const std::vector<T>& row : rows) {
      push_back(row);
    }
  }

  /// Rows of one `width`; values: #rows × width.
  [[nodiscard]] static CompressedRows uniform(std::size_t width, std::vector<T> values) {
    assert(width > 0 && values.size() % width == 0);
    CompressedRows rows;
    static_cast<void>(row_offset(values.size()));
    rows.width_ = static_cast<std::uint32_t>(width);
    rows.n_rows_ = values.size() / width;
    rows.values_ = std::move(values);
    return rows;
  }

  /// offsets: #rows + 1, from 0 to #values, not decreasing.
  [[nodiscard]] static CompressedRows from_offsets(std::vector<std::uint32_t> offsets,
                                                   std::vector<T> values) {
    assert(!offsets.empty() && offsets.front() == 0 && offsets.back() == values.size());
    static_cast<void>(row_offset(values.size()));
    CompressedRows rows;
    rows.n_rows_ = offsets.size() - 1;
    rows.values_ = std::move(values);
    if (!rows.adopt_uniform_width(offsets)) {
      rows.offsets_ = std::move(offsets);
    }
    return rows;
  }

  /// Appends a row.
  void push_back(std::span<const T> row) {
    const std::uint32_t end = row_offset(values_.size() + row.size());
    if (n_rows_ == 0 && offsets_.empty()) {
      width_ = static_cast<std::uint32_t>(row.size());
    } else if (offsets_.empty() && row.size() != width_) {
      offsets_.reserve(n_rows_ + 2);
      for (std::size_t i = 0; i <= n_rows_; ++i) {
        offsets_.push_back(static_cast<std::uint32_t>(i * width_));
      }
    }
    values_.insert(values_.end(), row.begin(), row.end());
    ++n_rows_;
    if (!offsets_.empty()) {
      offsets_.push_back(end);
    }
  }

  [[nodiscard]] std::size_t n_rows() const { return n_rows_; }
  [[nodiscard]] std::size_t n_values() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return n_rows_ == 0; }

  [[nodiscard]] std::size_t offset(std::size_t row) const {
    return offsets_.empty() ? row * width_ : offsets_[row];
  }
  [[nodiscard]] std::span<const T> operator[](std::size_t row) const {
    assert(row < n_rows_);
    return {values_.data() + offset(row), offset(row + 1) - offset(row)};
  }
  [[nodiscard]] std::span<T> operator[](std::size_t row) {
    assert(row < n_rows_);
    return {values_.data() + offset(row), offset(row + 1) - offset(row)};
  }
  [[nodiscard]] std::span<const T> values() const { return values_; }

  [[nodiscard]] std::size_t bytes() const {
    return values_.capacity() * sizeof(T) + offsets_.capacity() * sizeof(std::uint32_t);
  }
  void shrink_to_fit() {
    values_.shrink_to_fit();
    offsets_.shrink_to_fit();
  }

 private:
  bool adopt_uniform_width(const std::vector<std::uint32_t>& offsets) {
    const std::uint32_t width = n_rows_ == 0 ? 0 : offsets[1];
    for (std::size_t i = 0; i < n_rows_; ++i) {
      if (offsets[i + 1] - offsets[i] != width) {
        return false;
      }
    }
    width_ = width;
    return true;
  }

  std::vector<T> values_;
  std::vector<std::uint32_t> offsets_;  // empty: all rows have length width_
  std::size_t n_rows_ = 0;
  std::uint32_t width_ = 0;
};

}  // namespace espalier
