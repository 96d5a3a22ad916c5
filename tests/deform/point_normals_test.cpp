#include "deform/model/point_normals.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "deform/model/deformed.h"
#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

/// A step's two faces meet at a right angle in points 1 and 2; point 6 is of no face.
const std::string kOff =
    "OFF\n# a step\n7 2 0\n0 0 0 255 0 0\n1 0 0 0 255 0 # edge\n1 1 0 0 0 255\n0 1 0\n1 1 1\n"
    "1 0 1\n9 9 9\n4 0 1 2 3 1 0 0\n4  1 5 4 2 0 0 1 # riser\n";

/// The bytes with normals after all moved up by one.
std::string with_normals(const Model& model, double angle = 40) {
  std::vector<glm::dvec3> points(model.points().begin(), model.points().end());
  for (glm::dvec3& p : points) {
    p.z += 1;
  }
  return deformed_bytes_with_normals(
      model, points, corner_normals(model.points(), model.faces(), {.angle = angle}));
}

Model off_model() {
  return parse_model(ModelFormat::Off, "m", kOff);
}

TEST(PointNormals, of_an_off_file_stand_after_coordinates_and_split_points_at_sharp_edges) {
  EXPECT_EQ(with_normals(off_model()),
            "NOFF\n# a step\n9 2 0\n0 0 1 0 0 1 255 0 0\n1 0 1 0 0 1 0 255 0 # edge\n"
            "1 1 1 0 0 1 0 0 255\n0 1 1 0 0 1\n1 1 2 -1 0 0\n1 0 2 -1 0 0\n9 9 10 0 0 0\n"
            "1 0 1 -1 0 0 0 255 0\n1 1 1 -1 0 0 0 0 255\n"
            "4 0 1 2 3 1 0 0\n4 7 5 4 8 0 0 1 # riser\n");
}

TEST(PointNormals, split_nothing_where_no_edge_is_sharp) {
  const Model smooth = parse_model(ModelFormat::Off, "m", with_normals(off_model(), 180));
  ASSERT_EQ(smooth.points().size(), 7u);
  const glm::dvec3 between = glm::normalize(glm::dvec3(-1, 0, 1));
  EXPECT_LT(glm::distance(smooth.normals()[1], between), 1e-7);
  EXPECT_EQ(smooth.normals()[0], glm::dvec3(0, 0, 1));
}

TEST(PointNormals, are_not_added_where_nothing_moves) {
  const Model model = off_model();
  EXPECT_EQ(deformed_bytes_with_normals(model, model.points(),
                                        corner_normals(model.points(), model.faces())),
            kOff);
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nelement face 3\nproperty uchar flag\n"
    "property list uchar char vertex_index\nend_header\n"
    "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 4\n1 1 1 5\n1 0 1 6\n7 4 0 1 2 3\n7 2 0 1\n8 4 1 5 4 2\n";

TEST(PointNormals, of_a_ply_file_are_properties_after_all_others) {
  EXPECT_EQ(with_normals(parse_model(ModelFormat::Ply, "m", kPly)),
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nproperty uchar red\nproperty float nx\nproperty float ny\n"
            "property float nz\nelement face 3\nproperty uchar flag\n"
            "property list uchar char vertex_index\nend_header\n"
            "0 0 1 1 0 0 1\n1 0 1 2 0 0 1\n1 1 1 3 0 0 1\n0 1 1 4 0 0 1\n1 1 2 5 -1 0 0\n"
            "1 0 2 6 -1 0 0\n1 0 1 2 -1 0 0\n1 1 1 3 -1 0 0\n"
            "7 4 0 1 2 3\n7 2 0 1\n8 4 6 5 4 7\n");
}

TEST(PointNormals, of_a_binary_ply_file_are_of_its_numbers) {
  const Model step = off_model();
  for (const bool is_big : {false, true}) {
    const NumberEncoding encoding =
        is_big ? NumberEncoding::BigDouble : NumberEncoding::LittleDouble;
    std::string bytes = std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
                        "_endian 1.0\nelement face 2\nproperty list uchar uchar vertex_indices\n"
                        "element vertex 6\nproperty double x\nproperty double y\n"
                        "property double z\nproperty uchar red\nend_header\n" +
                        std::string("\4\0\1\2\3\4\1\5\4\2", 10);
    for (const glm::dvec3& p : step.points().first(6)) {
      for (int axis = 0; axis < 3; ++axis) {
        bytes += EncodedNumber(p[axis], encoding).view();
      }
      bytes += "r";
    }
    const Model model =
        parse_model(ModelFormat::Ply, "m", with_normals(parse_model(ModelFormat::Ply, "m", bytes)));
    ASSERT_EQ(model.points().size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(model.normals()[i], i < 4 ? glm::dvec3(0, 0, 1) : glm::dvec3(-1, 0, 0));
    }
    EXPECT_EQ(model.points()[6], glm::dvec3(1, 0, 1));
    EXPECT_EQ(std::vector(model.faces()[1].begin(), model.faces()[1].end()),
              (std::vector<std::int32_t>{6, 5, 4, 7}));
    EXPECT_EQ(model.bytes().substr(model.bytes().find("property uchar red"), 75),
              "property uchar red\nproperty double nx\nproperty double ny\nproperty double nz");
  }
}

TEST(PointNormals, name_what_they_cannot_be_written_to) {
  const auto error_of = [](const std::string& bytes) -> std::string {
    try {
      (void)with_normals(parse_model(ModelFormat::Ply, "m", bytes));
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  std::string half = kPly;
  half.replace(half.find("uchar red"), 9, "float ny");
  EXPECT_EQ(error_of(half), "normals: m has points with ny, but not all of nx, ny and nz");
  const auto with_unused = [](int n) {
    std::string bytes = kPly;
    bytes.replace(bytes.find("vertex 6"), 8, "vertex " + std::to_string(6 + n));
    for (int i = 0; i < n; ++i) {
      bytes.insert(bytes.find("7 4 0"), "2 2 2 2\n");
    }
    return bytes;
  };
  EXPECT_EQ(error_of(with_unused(120)), "");  // the last is number 127
  EXPECT_EQ(error_of(with_unused(121)),
            "normals: m numbers points in a type that ends at 127, and 129 are needed: give a "
            "larger angle to split at, or a file with int vertex_index");
  std::string twice = kPly;
  twice.insert(twice.find("end_header"), "property list uchar char vertex_indices\n");
  twice.replace(twice.find("7 4 0 1 2 3\n7 2 0 1\n8 4 1 5 4 2"), 31,
                "7 4 0 1 2 3 0\n7 2 0 1 0\n8 4 1 5 4 2 0");
  EXPECT_EQ(error_of(twice),
            "m lists the corners of its faces 2 times: they can be rewritten only where it does "
            "once");
}

TEST(PointNormals, of_a_damaged_file_are_added_or_refused) {
  for (const auto& [format, bytes] :
       {std::pair(ModelFormat::Off, kOff), std::pair(ModelFormat::Ply, kPly)}) {
    for (std::size_t n = 0; n <= bytes.size(); ++n) {
      for (const std::string& damaged : {bytes.substr(0, n), std::string(bytes).erase(n, 1)}) {
        try {
          const Model model = parse_model(format, "m", damaged);
          EXPECT_FALSE(parse_model(format, "n", with_normals(model)).normals().empty()) << damaged;
        } catch (const Error&) {
        }
      }
    }
  }
}

}  // namespace
}  // namespace espalier
