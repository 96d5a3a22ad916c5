#include "deform/model/obj.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "lattice/core/error.h"
#include "tests/deform/odd_obj_files.h"

namespace espalier {
namespace {

using Row = std::vector<std::int32_t>;

Row row(std::span<const std::int32_t> values) {
  return {values.begin(), values.end()};
}

std::string error_of(const std::string& bytes) {
  try {
    (void)parse_obj("m.obj", bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

/// Throws nothing but FileError on what is no OBJ file, and returns whether it was one.
bool parses(const std::string& bytes, std::size_t& n_points, std::size_t& n_corners) {
  try {
    const Model model = parse_obj("m.obj", bytes);
    EXPECT_EQ(model.bytes(), bytes);
    n_points = model.points().size();
    n_corners = model.faces().n_values();
    for (const std::int32_t point : model.faces().values()) {
      EXPECT_TRUE(point >= 0 && static_cast<std::size_t>(point) < n_points);
    }
    for (const PointNormal& pair : model.pairs()) {
      EXPECT_LT(static_cast<std::size_t>(pair.point), n_points);
      EXPECT_LT(static_cast<std::size_t>(pair.normal), model.normals().size());
    }
    return true;
  } catch (const FileError&) {
    return false;
  }
}

TEST(ParseObj, reads_points_faces_normals_and_their_places) {
  const Model model = parse_obj("m.obj", kRichObj);
  ASSERT_EQ(model.points().size(), 6u);
  EXPECT_EQ(model.points()[0], glm::dvec3(-1, -1.5, 0));
  EXPECT_EQ(model.points()[2], glm::dvec3(1, 1, 0.5));
  EXPECT_EQ(model.points()[3], glm::dvec3(-1, 1, 0));
  EXPECT_EQ(model.normals().size(), 2u);
  EXPECT_EQ(model.normals()[1], glm::dvec3(0.7071, 0, 0.7071));
  ASSERT_EQ(model.faces().n_rows(), 5u);
  EXPECT_EQ(row(model.faces()[0]), (Row{0, 1, 2}));
  EXPECT_EQ(row(model.faces()[1]), (Row{0, 2, 3}));
  EXPECT_EQ(row(model.faces()[4]), (Row{0, 1, 5}));
  const BytePlace y = model.layout().point_places[0].axis[1];
  EXPECT_EQ(model.bytes().substr(y.begin(), y.length()), "-1.50");
  const BytePlace x = model.layout().point_places[1].axis[0];
  EXPECT_EQ(model.bytes().substr(x.begin(), x.length()), "+1");
  EXPECT_EQ(model.layout().encoding, NumberEncoding::FloatText);
}

TEST(ParseObj, finds_the_pairs_of_point_and_normal) {
  const Model model = parse_obj("m.obj", kRichObj);
  const std::vector<PointNormal> pairs(model.pairs().begin(), model.pairs().end());
  const std::vector<PointNormal> expected = {{0, 0}, {1, 0}, {1, 1}, {2, 1},
                                             {3, 0}, {3, 1}, {5, 0}};
  EXPECT_EQ(pairs, expected);
  EXPECT_EQ(row(model.corner_pairs()), (Row{0, 1, 3, 0, 3, 4, -1, -1, -1, -1, -1, -1, 0, 2, 6}));
}

TEST(ParseObj, has_no_corner_pairs_where_no_corner_has_a_normal) {
  const Model model = parse_obj("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\n");
  EXPECT_TRUE(model.corner_pairs().empty());
  EXPECT_TRUE(model.pairs().empty());
}

TEST(ParseObj, names_groups_and_objects) {
  const Model model = parse_obj("m.obj", kRichObj);
  ASSERT_EQ(model.groups().size(), 4u);
  EXPECT_EQ(model.groups()[0].name, "thing");
  EXPECT_EQ(model.groups()[0].ranges, (std::vector<FaceRange>{{0, 5}}));
  EXPECT_EQ(model.groups()[2].name, "side#2");
  EXPECT_EQ(model.groups()[2].ranges, (std::vector<FaceRange>{{0, 2}}));
  EXPECT_EQ(model.groups()[3].ranges, (std::vector<FaceRange>{{2, 5}}));
}

TEST(ParseObj, merges_the_faces_of_a_group_that_is_taken_up_again) {
  const Model model = parse_obj("m.obj",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a a\nf 1 2 3\ng b\nf 1 2 3\n"
                                "g a\nf 1 2 3\no a\nf 1 2 3\n");
  EXPECT_EQ(model.groups()[0].ranges, (std::vector<FaceRange>{{0, 1}, {2, 4}}));
}

TEST(ParseObj, keeps_every_byte_of_odd_files) {
  for (const OddObjFile& file : odd_obj_files()) {
    EXPECT_EQ(parse_obj("m.obj", file.bytes).bytes(), file.bytes) << file.what;
  }
}

TEST(ParseObj, reads_the_same_with_every_kind_of_line_end) {
  const std::vector<OddObjFile> files = odd_obj_files();
  const Model lf = parse_obj("m.obj", files[0].bytes);
  for (const int other : {1, 2}) {
    const Model model = parse_obj("m.obj", files[other].bytes);
    EXPECT_EQ(row(model.faces().values()), row(lf.faces().values())) << files[other].what;
    EXPECT_EQ(row(model.corner_pairs()), row(lf.corner_pairs())) << files[other].what;
    EXPECT_TRUE(std::equal(model.points().begin(), model.points().end(), lf.points().begin()));
  }
}

TEST(ParseObj, does_not_continue_a_comment) {
  const Model model = parse_obj("m.obj", "# C:\\models\\\nv 1 2 3\n");
  EXPECT_EQ(model.points().size(), 1u);
}

TEST(ParseObj, takes_numbers_of_more_than_nine_digits_for_doubles) {
  EXPECT_EQ(parse_obj("m.obj", "v 0.123456789 0 0\n").layout().encoding, NumberEncoding::FloatText);
  EXPECT_EQ(parse_obj("m.obj", "v 0 0 0\nv 0 -1.123456789 0\n").layout().encoding,
            NumberEncoding::DoubleText);
  EXPECT_EQ(parse_obj("m.obj", "v 0 0 0\nvn 0 0.1234567890123 0\n").layout().encoding,
            NumberEncoding::FloatText);
}

TEST(ParseObj, refuses_bad_files_by_line_and_reason) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string one_of_each = three + "vt 0 0\nvn 0 0 1\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "m.obj: has no vertices: an OBJ file needs lines like 'v 1.0 2.0 3.0'"},
      {"# nothing\n", "has no vertices"},
      {std::string("\x7F"
                   "ELF\0\0\1\2",
                   8),
       "has no vertices"},
      {"v 0 0\n", "m.obj:1: z of a vertex (v x y z) is missing"},
      {"v\n", "m.obj:1: x of a vertex (v x y z) is missing"},
      {"v 1 # 2 3\n", "m.obj:1: y of a vertex (v x y z) is missing"},
      {"\r\nv 1 2x 3\n", "m.obj:2: y of a vertex (v x y z) is '2x', not a number"},
      {"v 1 \\\n2 \\\nnan\n", "m.obj:3: z of a vertex (v x y z) is not finite"},
      {"v inf 0 0\n", "is not finite"},
      {"v 1e999 0 0\n", "is not finite"},
      {"v 1e19 0 0\n", "m.obj:1: x of a vertex (v x y z) is beyond the largest coordinate"},
      {"v 0 0 0\nvn 0 0\n", "m.obj:2: z of a normal (vn x y z) is missing"},
      {"v 0 0 0\nvn nan 0 0\n", "m.obj:2: x of a normal (vn x y z) is not finite"},
      {three + "f\n", "m.obj:4: a face needs three corners or more, this has 0"},
      {three + "f 1 2\n", "m.obj:4: a face needs three corners or more, this has 2"},
      {three + "f 1 2 x\n", "m.obj:4: 'x' is no reference"},
      {three + "f 1 2 3.0\n", "'3.0' is no reference"},
      {three + "f 1 2 /1\n", "'/1' is no reference"},
      {three + "f 1 2 3/1/1/1\n", "'3/1/1/1' is no reference"},
      {three + "f 1 2 99999999999999999999\n", "is no reference"},
      {three + "f 1 2 0\n", "m.obj:4: '0' refers to vertex 0: they count from 1"},
      {three + "f 1 2 4\n", "m.obj:4: '4' refers to vertex 4, but the file has only 3 'v'"},
      {three + "f 1 2 -4\n",
       "m.obj:4: '-4' refers to vertex -4, but the file has only 3 'v' before it"},
      {"f -1 -1 -1\n" + three, "m.obj:1: '-1' refers to vertex -1, but the file has only 0 'v'"},
      {three + "f 1 2 2147483648\n", "refers to vertex 2147483648"},
      {one_of_each + "f 1/2 2/1 3/1\n", "m.obj:6: '1/2' refers to texture vertex 2"},
      {one_of_each + "f 1//2 2//1 3//1\n", "m.obj:6: '1//2' refers to normal 2"},
      {one_of_each + "f 1//0 2//1 3//1\n", "m.obj:6: '1//0' refers to normal 0"},
      {one_of_each + "f 1//-2 2//1 3//1\n", "m.obj:6: '1//-2' refers to normal -2"},
      {three + "l 1 4\n", "m.obj:4: '4' refers to vertex 4"},
      {three + "p 0\n", "m.obj:4: '0' refers to vertex 0"},
      {one_of_each + "surf 0 1 0 1 1/1/9\n", "m.obj:6: '1/1/9' refers to normal 9"},
  };
  for (const auto& [bytes, message] : cases) {
    EXPECT_NE(error_of(bytes).find(message), std::string::npos) << bytes << error_of(bytes);
  }
}

TEST(ParseObj, refuses_a_number_too_long_to_keep_its_place) {
  EXPECT_EQ(error_of("v 0." + std::string(std::size_t{1} << 24, '0') + " 0 0\n"),
            "m.obj:1: x of a vertex (v x y z) has more than 16777215 characters");
}

TEST(ParseObj, survives_truncation_at_every_byte) {
  for (const OddObjFile& file : odd_obj_files()) {
    std::size_t n_points = 0;
    std::size_t n_corners = 0;
    ASSERT_TRUE(parses(file.bytes, n_points, n_corners)) << file.what;
    for (std::size_t length = 0; length < file.bytes.size(); ++length) {
      std::size_t n_cut_points = 0;
      std::size_t n_cut_corners = 0;
      parses(file.bytes.substr(0, length), n_cut_points, n_cut_corners);
      EXPECT_LE(n_cut_points, n_points) << file.what << " cut to " << length;
      EXPECT_LE(n_cut_corners, n_corners) << file.what << " cut to " << length;
    }
  }
}

TEST(ParseObj, survives_random_changes) {
  std::mt19937 random(20240607);
  std::size_t n_parsed = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::string bytes = mutated(kRichObj, random);
    std::size_t n_points = 0;
    std::size_t n_corners = 0;
    n_parsed += parses(bytes, n_points, n_corners) ? 1 : 0;
  }
  EXPECT_GT(n_parsed, 500u);
  EXPECT_LT(n_parsed, 5000u);
}

}  // namespace
}  // namespace espalier
