#include "lattice/core/compressed_rows.h"

#include <gtest/gtest.h>

#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

using Rows = CompressedRows<int>;
using Values = std::vector<std::vector<int>>;

Values to_vectors(const Rows& rows) {
  Values values;
  for (std::size_t i = 0; i < rows.n_rows(); ++i) {
    values.emplace_back(rows[i].begin(), rows[i].end());
  }
  return values;
}

TEST(CompressedRows, gives_back_the_rows_put_in) {
  const std::vector<Values> cases = {{},
                                     {{}},
                                     {{1}},
                                     {{1, 2}, {3, 4}},
                                     {{1, 2}, {3, 4}, {5}, {6, 7}},
                                     {{}, {1}},
                                     {{}, {}, {}},
                                     {{1}, {}, {2, 3}}};
  for (const Values& values : cases) {
    Rows rows;
    std::size_t n_values = 0;
    std::vector<std::uint32_t> offsets = {0};
    std::vector<int> flat;
    for (const std::vector<int>& row : values) {
      rows.push_back(row);
      n_values += row.size();
      flat.insert(flat.end(), row.begin(), row.end());
      offsets.push_back(static_cast<std::uint32_t>(n_values));
    }
    EXPECT_EQ(to_vectors(rows), values);
    EXPECT_EQ(rows.n_values(), n_values);
    EXPECT_EQ(rows.empty(), values.empty());
    Rows from_offsets = Rows::from_offsets(offsets, flat);
    EXPECT_EQ(to_vectors(from_offsets), values);
    for (std::size_t i = 0; i <= values.size(); ++i) {
      EXPECT_EQ(rows.offset(i), offsets[i]);
      EXPECT_EQ(from_offsets.offset(i), offsets[i]);
    }
    // Either can be appended to.
    Values longer = values;
    longer.push_back({8, 9, 10});
    rows.push_back(longer.back());
    from_offsets.push_back(longer.back());
    EXPECT_EQ(to_vectors(rows), longer);
    EXPECT_EQ(to_vectors(from_offsets), longer);
  }
}

TEST(CompressedRows, stores_no_offsets_for_rows_of_one_length) {
  Rows uniform = Rows::uniform(3, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(to_vectors(uniform), (Values{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(uniform.bytes(), 6 * sizeof(int));
  Rows found = Rows::from_offsets({0, 3, 6}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(found.bytes(), 6 * sizeof(int));
  found.push_back(std::vector<int>{7});
  found.shrink_to_fit();
  EXPECT_EQ(found.bytes(), 7 * sizeof(int) + 4 * sizeof(std::uint32_t));
}

TEST(CompressedRows, refuses_more_values_than_its_offsets_can_count) {
  constexpr std::size_t kMost = 0xffffffffU;
  EXPECT_EQ(row_offset(kMost), kMost);
  EXPECT_THROW((void)row_offset(kMost + 1), Error);
  Rows rows = {{1, 2}};
  const int value = 0;
  try {
    rows.push_back({&value, kMost - 1});  // refused before it is read
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a table of 4294967296 values is too large: it can hold 4294967295");
  }
  EXPECT_EQ(to_vectors(rows), (Values{{1, 2}}));
}

TEST(CompressedRows, lets_values_be_changed_in_place) {
  Rows rows = {{1, 2}, {3}};
  rows[1][0] = 30;
  EXPECT_EQ(to_vectors(rows), (Values{{1, 2}, {30}}));
  EXPECT_EQ(std::vector<int>(rows.values().begin(), rows.values().end()),
            (std::vector<int>{1, 2, 30}));
}

}  // namespace
}  // namespace espalier
