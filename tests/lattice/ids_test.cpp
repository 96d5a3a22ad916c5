#include "lattice/core/ids.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

namespace espalier {
namespace {

static_assert(!std::is_convertible_v<VertexId, EdgeId>);
static_assert(!std::is_convertible_v<int, HalfFaceId>);
static_assert(sizeof(HalfFaceId) == sizeof(std::int32_t));

TEST(Id, means_none_by_default) {
  EXPECT_FALSE(VertexId().is_valid());
  EXPECT_FALSE(HalfFaceId().is_valid());
  EXPECT_TRUE(VertexId{0}.is_valid());
  EXPECT_LT(VertexId(), VertexId{0});
}

TEST(HalfFaceId, knows_its_face_its_side_and_its_opposite) {
  for (std::int32_t face = 0; face < 5; ++face) {
    for (const int side : {0, 1}) {
      const HalfFaceId half_face(FaceId{face}, side);
      EXPECT_EQ(half_face.value, 2 * face + side);
      EXPECT_EQ(half_face.face(), FaceId{face});
      EXPECT_EQ(half_face.side(), side);
      EXPECT_EQ(half_face.opposite(), HalfFaceId(FaceId{face}, 1 - side));
      EXPECT_EQ(half_face.opposite().opposite(), half_face);
    }
  }
}

TEST(IdRange, counts_from_zero) {
  std::vector<int> values;
  for (const CellId cell : IdRange<CellId>(3)) {
    values.push_back(cell.value);
  }
  EXPECT_EQ(values, (std::vector<int>{0, 1, 2}));
  EXPECT_FALSE(IdRange<CellId>(0).begin() != IdRange<CellId>(0).end());
}

TEST(IdVector, is_indexed_by_its_ids) {
  IdVector<FaceId, int> values(3, 7);
  values[FaceId{1}] = 8;
  EXPECT_EQ(values.values(), (std::vector<int>{7, 8, 7}));
  EXPECT_EQ(values, (IdVector<FaceId, int>(std::vector<int>{7, 8, 7})));
  EXPECT_GE(values.bytes(), 3 * sizeof(int));
}

}  // namespace
}  // namespace espalier
