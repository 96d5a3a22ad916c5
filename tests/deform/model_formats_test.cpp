/// What OFF, PLY and STL files have in common with OBJ: a model is its file.

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "deform/model/deformed.h"
#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Row = std::vector<std::int32_t>;

struct Sample {
  std::string what;
  ModelFormat format;
  std::string bytes;
};

std::string number(double value, NumberEncoding encoding) {
  return std::string(EncodedNumber(value, encoding).view());
}

const std::string kOff =
    "# a roof\nCOFF 5 3 0\n\n"
    "0 0 0  1 0 0 1 # red\n1 0 0  1 0 0 1\n\n0.5 0.10 -0.0 0 1 0 1\n1 1 0\n-1e-1 1 0\n"
    "3 0 1 2  0.5 0.5 0.5\n4 0 1 3 4\n2 0 1\n";

const std::string kNormalOff = "NOFF\n3 1 3\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0.6 0 0.8\n3 0 1 2\n";

const std::string kTextPly =
    "ply\r\nformat ascii 1.0\r\ncomment a triangle and more\r\nelement vertex 4\r\n"
    "property uchar red\r\nproperty float x\r\nproperty float y\r\nproperty list uchar int "
    "marks\r\n"
    "property float z\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
    "element face 3\r\nproperty list uchar uint vertex_index\r\nproperty float quality\r\n"
    "element nothing 3\r\nelement edge 1\r\nproperty int a\r\nend_header\r\n"
    "255 0 0 2 7 8 0 0 0 1\r\n0 1.0 0 0 0 0 0 1\r\n0 0 1 1 5 0.25 0 0 1\r\n1 1 1 0 0 0 0 1\r\n"
    "3 0 1 2 0.5\r\n2 0 1 0.5\r\n4 0 1 3 2 1\r\n9\r\n";

/// x, z doubles and y a float, after a byte and before a list.
std::string binary_ply(bool is_big) {
  const NumberEncoding as_float = is_big ? NumberEncoding::BigFloat : NumberEncoding::LittleFloat;
  const NumberEncoding as_double =
      is_big ? NumberEncoding::BigDouble : NumberEncoding::LittleDouble;
  std::string bytes =
      std::string("ply\nformat ") + (is_big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\nelement face 1\nproperty list uchar ushort vertex_indices\nelement vertex 3\n"
      "property int8 flag\nproperty double x\nproperty float y\nproperty float64 z\n"
      "property list uint8 int16 marks\nend_header\n";
  const auto add_short = [&](int value) {
    const char low = static_cast<char>(value & 255);
    const char high = static_cast<char>(value >> 8);
    bytes += is_big ? high : low;
    bytes += is_big ? low : high;
  };
  bytes += '\3';
  add_short(0);
  add_short(1);
  add_short(2);
  for (int i = 0; i < 3; ++i) {
    bytes += '\xFF';
    bytes += number(0.1 + i, as_double) + number(0.5 * i, as_float) + number(-i, as_double);
    bytes += '\1';
    add_short(-2);
  }
  return bytes;
}

const std::string kTextStl =
    "solid roof top\n"
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n"
    "      vertex 1 1 0\n    endloop\n  endfacet\n"
    "  facet normal 0 0 0\n    outer loop\n      vertex 0 0 0\n      vertex 1.0 1 -0\n"
    "      vertex 0 1 0\n    endloop\n  endfacet\nendsolid roof top\n";

std::string binary_stl() {
  std::string bytes = "solid, but not text" + std::string(61, ' ') + std::string("\2\0\0\0", 4);
  const double corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                   {{0, 0, 0}, {1, 1, -0.0}, {0, 1, 0}}};
  for (const auto& facet : corners) {
    for (const double n : {0.0, 0.0, 1.0}) {
      bytes += number(n, NumberEncoding::LittleFloat);
    }
    for (const auto& corner : facet) {
      for (const double x : corner) {
        bytes += number(x, NumberEncoding::LittleFloat);
      }
    }
    bytes += "ab";
  }
  return bytes;
}

std::vector<Sample> samples() {
  return {{"off", ModelFormat::Off, kOff},
          {"off with normals", ModelFormat::Off, kNormalOff},
          {"text ply", ModelFormat::Ply, kTextPly},
          {"little ply", ModelFormat::Ply, binary_ply(false)},
          {"big ply", ModelFormat::Ply, binary_ply(true)},
          {"text stl", ModelFormat::Stl, kTextStl},
          {"binary stl", ModelFormat::Stl, binary_stl()}};
}

Model parse(const Sample& sample) {
  return parse_model(sample.format, "m", sample.bytes);
}

std::string error_of(ModelFormat format, const std::string& bytes) {
  try {
    (void)parse_model(format, "m", bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Row row(std::span<const std::int32_t> values) {
  return {values.begin(), values.end()};
}

std::vector<glm::dvec3> points_of(const Model& model) {
  return {model.points().begin(), model.points().end()};
}

TEST(ModelFormats, off_has_points_and_faces_of_three_corners_or_more) {
  const Model model = parse_model(ModelFormat::Off, "m", kOff);
  EXPECT_EQ(points_of(model), (std::vector<glm::dvec3>{
                                  {0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}, {1, 1, 0}, {-0.1, 1, 0}}));
  ASSERT_EQ(model.faces().n_rows(), 2u);
  EXPECT_EQ(row(model.faces()[1]), (Row{0, 1, 3, 4}));
  EXPECT_TRUE(model.pairs().empty());
  const Model with_normals = parse_model(ModelFormat::Off, "m", kNormalOff);
  EXPECT_EQ(with_normals.normals()[1], glm::dvec3(0, 0, 2));
  EXPECT_EQ(row(with_normals.corner_pairs()), (Row{0, 1, 2}));
}

TEST(ModelFormats, ply_finds_its_coordinates_among_other_properties) {
  const Model text = parse_model(ModelFormat::Ply, "m", kTextPly);
  EXPECT_EQ(points_of(text),
            (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.25}, {1, 1, 0}}));
  ASSERT_EQ(text.faces().n_rows(), 2u);
  EXPECT_EQ(row(text.faces()[1]), (Row{0, 1, 3, 2}));
  EXPECT_EQ(text.normals().size(), 4u);
  for (const bool is_big : {false, true}) {
    const Model binary = parse_model(ModelFormat::Ply, "m", binary_ply(is_big));
    EXPECT_EQ(points_of(binary),
              (std::vector<glm::dvec3>{{0.1, 0, 0}, {1.1, 0.5, -1}, {2.1, 1, -2}}));
    EXPECT_EQ(row(binary.faces()[0]), (Row{0, 1, 2}));
  }
}

TEST(ModelFormats, stl_makes_corners_at_one_place_one_point) {
  for (const std::string& bytes : {kTextStl, binary_stl()}) {
    const Model model = parse_model(ModelFormat::Stl, "m", bytes);
    EXPECT_EQ(points_of(model),
              (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(row(model.faces()[0]), (Row{0, 1, 2}));
    EXPECT_EQ(row(model.faces()[1]), (Row{0, 2, 3}));
  }
  EXPECT_EQ(parse_model(ModelFormat::Stl, "m", kTextStl).groups()[0].name, "roof");
}

TEST(ModelFormats, keep_every_byte_at_rest_and_every_other_byte_when_a_point_moves) {
  for (const Sample& sample : samples()) {
    const Model model = parse(sample);
    std::vector<glm::dvec3> points = points_of(model);
    EXPECT_EQ(deformed_bytes(model, points, {}), sample.bytes) << sample.what;
    points[1] += glm::dvec3(0.25, 0, 0.5);
    const Model moved = deformed(model, points, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(moved.points()[i], points[i]) << sample.what << " point " << i;
    }
    EXPECT_EQ(row(moved.faces().values()), row(model.faces().values()));
    EXPECT_NE(moved.bytes(), sample.bytes);
    EXPECT_EQ(deformed_bytes(moved, model.points(), {}).size(),
              sample.bytes.size() - (sample.what == "text ply" ? 2 : 0))
        << sample.what;  // 1.0 comes back as 1
  }
}

TEST(ModelFormats, turn_normals_of_points_and_recompute_those_of_facets) {
  for (const std::string& bytes : {kNormalOff, kTextPly}) {
    const ModelFormat format = bytes == kNormalOff ? ModelFormat::Off : ModelFormat::Ply;
    const Model model = parse_model(format, "m", bytes);
    std::vector<glm::dvec3> normals(model.pairs().size(), glm::dvec3(1, 0, 0));
    const Model turned = deformed(model, model.points(), normals);
    for (const glm::dvec3& normal : turned.normals()) {
      EXPECT_EQ(normal, glm::dvec3(1, 0, 0));
    }
  }
  for (const std::string& bytes : {kTextStl, binary_stl()}) {
    const Model model = parse_model(ModelFormat::Stl, "m", bytes);
    std::vector<glm::dvec3> points = points_of(model);
    points[1] = {1, 0, 1};  // of the first facet only
    const Model moved = deformed(model, points, {});
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-1, 1, 1));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(static_cast<float>(moved.layout().facet_normals[0][axis]),
                static_cast<float>(expected[axis]));
    }
    EXPECT_EQ(moved.layout().facet_normals[1], model.layout().facet_normals[1]);
  }
}

TEST(ModelFormats, stl_files_can_be_given_no_normals) {
  const Model model = parse(samples()[5]);
  ASSERT_EQ(model.format(), ModelFormat::Stl);
  try {
    (void)deformed_bytes_with_normals(model, model.points(),
                                      corner_normals(model.points(), model.faces()));
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(), "normals: m is an STL file, which has normals of its facets alone");
  }
}

TEST(ModelFormats, refuse_bad_files_by_place_and_reason) {
  const std::string stl = binary_stl();
  std::string nan_stl = stl;
  nan_stl.replace(84 + 12, 4, number(std::nan(""), NumberEncoding::LittleFloat));
  std::string far_ply = binary_ply(false);
  far_ply.replace(far_ply.find("end_header\n") + 11 + 7 + 1, 8,
                  number(1e19, NumberEncoding::LittleDouble));
  const std::tuple<ModelFormat, std::string, std::string> cases[] = {
      {ModelFormat::Off, "", "m: is empty; an OFF file begins with OFF"},
      {ModelFormat::Off, "OFF BINARY\n", "m:1: is a binary OFF file; only text can be read"},
      {ModelFormat::Off, "4OFF 1 0 0\n", "m:1: '4OFF' has points that are not in space"},
      {ModelFormat::Off, "OFF\n1000000000 1 0\n0 0 0\n",
       "m:3: ends after 1 of the 1000000000 points that it announces"},
      {ModelFormat::Off, "OFF\n-1 1 0\n", "m:2: the number of points is '-1', must be a whole"},
      {ModelFormat::Off, "OFF 0 0 0\n", "m:1: has no points"},
      {ModelFormat::Off, "OFF 1 0 0\n0 nan 0\n", "m:2: y of a point is not finite"},
      {ModelFormat::Off, "OFF 1 1 0\n0 0 0\n3 0 0 1\n", "m:3: a face names point 1, there are 1"},
      {ModelFormat::Off, "OFF 1 1 0\n0 0 0\n1000000000 0 0\n", "corner 2 of a face is missing"},
      {ModelFormat::Ply, "solid\n", "m:1: a PLY file begins with a line 'ply'"},
      {ModelFormat::Ply, "ply\n", "the header ends without a line 'end_header'"},
      {ModelFormat::Ply, "ply\nformat ascii 1.0\nend_header\n", "m: has no points"},
      {ModelFormat::Ply, "ply\nend_header\n", "m:2: the header has no line 'format ascii 1.0'"},
      {ModelFormat::Ply, replaced(kTextPly, "float x", "int x"),
       "m: x of the points must be float"},
      {ModelFormat::Ply, replaced(kTextPly, "float y", "real y"), "m:7: a property has the type "},
      {ModelFormat::Ply, replaced(kTextPly, "vertex 4", "vertex 999999999"),
       "m:24: vertex 4: marks is missing"},
      {ModelFormat::Ply, replaced(kTextPly, "1.0 0 0 0", "1e400 0 0 0"), "m:21: vertex 1: x is "},
      {ModelFormat::Ply, replaced(kTextPly, "0 1 3 2 1", "0 1 4 2 1"),
       "m: face 1 names point 4, there are 4"},
      {ModelFormat::Ply, replaced(kTextPly, "4 0 1 3 2", "-4 0 1 3 2"),
       "face 2: the number of corners is -4, must be a whole number from 0"},
      {ModelFormat::Ply, far_ply, "m: vertex 0: x is 1e+19, must be a number up to 1e18"},
      {ModelFormat::Ply, binary_ply(true).substr(0, binary_ply(true).size() - 1),
       "m: ends in element 2 of the 3 'vertex' that it announces"},
      {ModelFormat::Stl, "", "m: is no STL file"},
      {ModelFormat::Stl, "solid nothing\nendsolid\n", "m: has no facets"},
      {ModelFormat::Stl, stl.substr(0, 184 - 1),
       "m: announces 2 facets of 50 bytes, but has room for 1"},
      {ModelFormat::Stl, nan_stl, "m: facet 0: x of corner 0 is nan, must be a number up to 1e18"},
      {ModelFormat::Stl, replaced(kTextStl, "endloop", "vertex 1 2 3"),
       "m:7: a facet is not whole: 'endloop' is missing"},
      {ModelFormat::Stl, replaced(kTextStl, "vertex 1.0 1 -0", "vertex 1.0 inf 0"),
       "m:12: y of a vertex is not finite"},
  };
  for (const auto& [format, bytes, message] : cases) {
    EXPECT_NE(error_of(format, bytes).find(message), std::string::npos) << message << "\n"
                                                                        << error_of(format, bytes);
  }
}

TEST(ModelFormats, survive_truncation_at_every_byte_with_no_less_than_they_announce) {
  for (const Sample& sample : samples()) {
    const std::size_t n_points = parse(sample).points().size();
    for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
      try {
        const Model cut = parse_model(sample.format, "m", sample.bytes.substr(0, length));
        EXPECT_LE(cut.points().size(), n_points);
        EXPECT_TRUE(sample.format == ModelFormat::Stl || cut.points().size() == n_points)
            << sample.what << " cut to " << length;
      } catch (const FileError&) {
        SUCCEED();
      }
    }
  }
}

TEST(ModelFormats, survive_random_changes) {
  std::mt19937 random(7);
  for (const Sample& sample : samples()) {
    std::size_t n_parsed = 0;
    for (int i = 0; i < 1000; ++i) {
      std::string bytes = sample.bytes;
      bytes[random() % bytes.size()] = static_cast<char>(random());
      try {
        const Model model = parse_model(sample.format, "m", bytes);
        EXPECT_EQ(deformed_bytes(model, model.points(), {}), bytes);
        ++n_parsed;
      } catch (const FileError&) {
        SUCCEED();
      }
    }
    EXPECT_GT(n_parsed, 10u) << sample.what;
    EXPECT_LT(n_parsed, 1000u) << sample.what;
  }
}

}  // namespace
}  // namespace espalier
