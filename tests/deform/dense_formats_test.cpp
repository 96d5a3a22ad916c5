// Models of OFF, PLY and STL files made denser.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "deform/model/dense_model.h"
#include "deform/model/encoded_number.h"
#include "deform/model/model_file.h"
#include "lattice/core/error.h"
#include "lattice/topology/face_triangles.h"
#include "tests/deform/surfaces.h"

namespace espalier {
namespace {

std::string dense(ModelFormat format, const std::string& bytes, double longest,
                  DensifyMethod method = DensifyMethod::Midpoint) {
  return std::string(dense_model(parse_model(format, "m", bytes), method, longest, "d").bytes());
}

std::string error_of(ModelFormat format, const std::string& bytes, double longest) {
  try {
    (void)dense(format, bytes, longest);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

std::string float_bytes(double number) {
  return std::string(EncodedNumber(number, NumberEncoding::LittleFloat).view());
}

const std::string kOff =
    "COFF # mine\n4 3 5\n"
    "0 0 0  255 0 0 255\n2 0 0  0 255 0 255\n0 1 0  0 0 255 255 # top\n1 -0.5 0  0 0 0 255\n"
    "3  0 1 2  0.5 0 1 # the one\n2 0 3\n3 0 3 1\n";

TEST(DenseOff, keeps_colours_of_points_and_faces_and_all_else_that_the_file_says) {
  EXPECT_EQ(dense(ModelFormat::Off, kOff, 2),
            "COFF # mine\n5 4 7\n"
            "0 0 0  255 0 0 255\n2 0 0  0 255 0 255\n0 1 0  0 0 255 255 # top\n"
            "1 -0.5 0  0 0 0 255\n1 0.5 0 0 128 128 255\n"
            "3 1 4 0 0.5 0 1\n3 4 2 0  0.5 0 1 # the one\n2 0 3\n3 0 3 1\n");
}

TEST(DenseOff, interpolates_normals_and_colours_from_0_to_1) {
  EXPECT_EQ(dense(ModelFormat::Off,
                  "NOFF\n3 1\n0 0 0 3 0 0 1\n2 0 0 0 3 0 0\n0 1 0 0 1 0 1\n3 0 1 2\n", 2),
            "NOFF\n4 2\n0 0 0 3 0 0 1\n2 0 0 0 3 0 0\n0 1 0 0 1 0 1\n1 0.5 0 0 1 0 0.5\n"
            "3 1 3 0\n3 3 2 0\n");
}

TEST(DenseOff, gives_new_points_only_numbers_that_all_have) {
  EXPECT_EQ(dense(ModelFormat::Off, "OFF\n3 1 0\n0 0 0 1 2\n2 0 0 3\n0 1 0 5 6 7\n3 0 1 2\n", 2),
            "OFF\n4 2 0\n0 0 0 1 2\n2 0 0 3\n0 1 0 5 6 7\n1 0.5 0 4\n3 1 3 0\n3 3 2 0\n");
}

TEST(DenseOff, moves_old_points_by_smooth_methods) {
  const Model model =
      parse_model(ModelFormat::Off, "m",
                  dense(ModelFormat::Off, "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 9\n",
                        1.2, DensifyMethod::CatmullClark));
  EXPECT_EQ(model.points().size(), 4u);  // short already
  const Model fine = parse_model(
      ModelFormat::Off, "m",
      dense(ModelFormat::Off,
            "OFF 6 8 0\n1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n3 0 1 2\n3 1 3 2\n3 3 4 2\n"
            "3 4 0 2\n3 1 0 5\n3 3 1 5\n3 4 3 5\n3 0 4 5\n",
            1.2, DensifyMethod::Loop));
  ASSERT_EQ(fine.faces().n_rows(), 32u);
  EXPECT_EQ(fine.points()[0], glm::dvec3(33.0 / 64, 0, 0));
}

const std::string kPly =
    "ply\nformat ascii 1.0\ncomment mine\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property double z\nproperty uchar red\nproperty float s\nproperty list uchar int marks\n"
    "element face 2\nproperty int material\nproperty list uchar ushort vertex_indices\n"
    "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\n"
    "property int vertex2\nend_header\n"
    "0 0 0 255 0.5 2 8 9\n2 0 0 0 1 0\n0 1 0 10 0 0\n"
    "7 3 0 1 2 6 0 0 1 0 0 1\n8 2 0 1 0\n0 1\n";

TEST(DensePly, keeps_properties_of_points_faces_and_corners) {
  EXPECT_EQ(dense(ModelFormat::Ply, kPly, 2),
            "ply\nformat ascii 1.0\ncomment mine\nelement vertex 4\nproperty float x\n"
            "property float y\nproperty double z\nproperty uchar red\nproperty float s\n"
            "property list uchar int marks\nelement face 3\nproperty int material\n"
            "property list uchar ushort vertex_indices\nproperty list uchar float texcoord\n"
            "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
            "0 0 0 255 0.5 2 8 9\n2 0 0 0 1 0\n0 1 0 10 0 0\n1 0.5 0 5 0.5 0\n"
            "7 3 1 3 0 6 1 0 0.5 0.5 0 0\n7 3 3 2 0 6 0.5 0.5 0 1 0 0\n8 2 0 1 0\n0 1\n");
}

/// The file in a binary encoding, of floats, uchars and ints alone.
std::string binary_ply(bool is_big) {
  const auto number = [&](std::uint32_t bits, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) {
      bytes += static_cast<char>(bits >> (8 * (is_big ? size - 1 - i : i)) & 0xFF);
    }
    return bytes;
  };
  const auto real = [&](double value) {
    return std::string(
        EncodedNumber(value, is_big ? NumberEncoding::BigFloat : NumberEncoding::LittleFloat)
            .view());
  };
  std::string bytes = std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
                      "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                      "property float z\nproperty short heat\nproperty float nx\n"
                      "property float ny\nproperty float nz\nelement face 1\n"
                      "property list uchar int vertex_index\nproperty uint flags\nend_header\n";
  const auto add_point = [&](double x, double y, std::uint32_t heat, double nx, double ny) {
    bytes += real(x) + real(y) + real(0) + number(heat, 2) + real(nx) + real(ny) + real(0);
  };
  add_point(0, 0, 10, 1, 0);
  add_point(2, 0, 0xFFF8, 1, 0);  // −8
  add_point(0, 1, 0xFFF0, 0, 1);  // −16
  return bytes + number(3, 1) + number(0, 4) + number(1, 4) + number(2, 4) + number(0xCAFE0001, 4);
}

TEST(DensePly, keeps_binary_files_of_both_byte_orders) {
  for (const bool is_big : {false, true}) {
    const std::string bytes = dense(ModelFormat::Ply, binary_ply(is_big), 2);
    const Model model = parse_model(ModelFormat::Ply, "d", bytes);
    ASSERT_EQ(model.points().size(), 4u);
    EXPECT_EQ(model.points()[3], glm::dvec3(1, 0.5, 0));
    EXPECT_LT(glm::distance(model.normals()[3], glm::normalize(glm::dvec3(1, 1, 0))), 1e-7);
    ASSERT_EQ(model.faces().n_rows(), 2u);
    EXPECT_EQ(std::vector(model.faces()[0].begin(), model.faces()[0].end()),
              (std::vector<std::int32_t>{1, 3, 0}));
    const std::string flags =
        is_big ? std::string("\xCA\xFE\0\1", 4) : "\1" + std::string("\0\xFE\xCA", 3);
    EXPECT_EQ(bytes.substr(bytes.size() - 4), flags);
    EXPECT_EQ(bytes.substr(bytes.size() - 21, 4), flags);
    const std::size_t heat = bytes.find("end_header\n") + 11 + 3 * 26 + 12;
    EXPECT_EQ(bytes.substr(heat, 2), is_big ? "\xFF\xF4" : "\xF4\xFF");  // −12
  }
}

TEST(DensePly, refuses_more_points_than_its_corners_can_number) {
  std::string text = kPly;
  text.replace(text.find("ushort"), 6, "char");
  EXPECT_EQ(error_of(ModelFormat::Ply, text, 0.1),
            "densify: m numbers points in a type that ends at 127, and 425 are needed: give a "
            "larger length, or a file with int vertex_indices");
}

const std::string kStl =
    "solid part\r\n\tfacet normal 0 0 9\r\n\t\touter loop\r\n\t\t\tvertex 0.0 0 0\r\n"
    "\t\t\tvertex 2.00 0 0\r\n\t\t\tvertex 0 1e0 0\r\n\t\tendloop\r\n\tendfacet\r\n"
    "facet normal 0 0 0\r\nouter loop\r\nvertex 0 0 0\r\nvertex 1 -0.5 0\r\nvertex 2 0 0\r\n"
    "endloop\r\nendfacet\r\nendsolid part\r\n";

TEST(DenseStl, of_text_splits_facets_as_they_are_written) {
  const auto part = [](const std::string& a, const std::string& b, const std::string& c) {
    return "\tfacet normal 0 0 9\r\n\t\touter loop\r\n\t\t\tvertex " + a + "\r\n\t\t\tvertex " + b +
           "\r\n\t\t\tvertex " + c + "\r\n\t\tendloop\r\n\tendfacet\r\n";
  };
  std::string expected = kStl;
  const std::size_t begin = expected.find("\tfacet");
  expected.replace(begin, expected.find("facet normal 0 0 0") - begin,
                   part("2.00 0 0", "1 0.5 0", "0.0 0 0") + part("1 0.5 0", "0 1e0 0", "0.0 0 0"));
  EXPECT_EQ(dense(ModelFormat::Stl, kStl, 2), expected);
}

TEST(DenseStl, of_bytes_keeps_what_stands_at_facets) {
  std::string facet;
  for (const double number : {0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0}) {
    facet += float_bytes(number);
  }
  facet += "\x12\x34";
  const std::string bytes =
      dense(ModelFormat::Stl, std::string(80, 'h') + std::string("\1\0\0\0", 4) + facet, 2);
  ASSERT_EQ(bytes.size(), 84u + 2 * 50);
  EXPECT_EQ(bytes.substr(0, 84), std::string(80, 'h') + std::string("\2\0\0\0", 4));
  EXPECT_EQ(bytes.substr(84 + 48, 2), "\x12\x34");
  EXPECT_EQ(bytes.substr(84 + 98, 2), "\x12\x34");
  EXPECT_EQ(bytes.substr(84, 12), facet.substr(0, 12));
  EXPECT_EQ(test::area_of(parse_model(ModelFormat::Stl, "d", bytes)), glm::dvec3(0, 0, 2));
}

TEST(DenseStl, by_smooth_methods_consists_of_triangles_with_normals_of_their_own) {
  const std::string tetrahedron = [] {
    const std::vector<glm::dvec3> p = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    std::string text = "solid t\n";
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}) {
      text += "facet normal 1 0 0\nouter loop\n";
      for (const int i : {a, b, c}) {
        const glm::dvec3& v = p[static_cast<std::size_t>(i)];
        text += "vertex " + std::to_string(v.x) + " " + std::to_string(v.y) + " " +
                std::to_string(v.z) + "\n";
      }
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid t\n";
  }();
  for (const auto& [method, n] :
       {std::pair(DensifyMethod::Loop, 16u), std::pair(DensifyMethod::CatmullClark, 24u)}) {
    const Model model =
        parse_model(ModelFormat::Stl, "d", dense(ModelFormat::Stl, tetrahedron, 2, method));
    EXPECT_EQ(model.faces().n_rows(), n);
    EXPECT_LT(glm::length(test::area_of(model)), 1e-6);  // closed
    for (std::size_t facet = 0; facet < model.faces().n_rows(); ++facet) {
      std::vector<glm::dvec3> loop;
      for (const std::int32_t i : model.faces()[facet]) {
        loop.push_back(model.points()[static_cast<std::size_t>(i)]);
      }
      EXPECT_LT(
          glm::distance(model.layout().facet_normals[facet], glm::normalize(area_vector(loop))),
          1e-6);
    }
  }
}

TEST(DenseModelOfAnyFormat, keeps_the_surface_and_reaches_the_length) {
  for (const auto& [format, bytes] :
       {std::pair(ModelFormat::Off, kOff), std::pair(ModelFormat::Ply, kPly),
        std::pair(ModelFormat::Ply, binary_ply(false)),
        std::pair(ModelFormat::Ply, binary_ply(true)), std::pair(ModelFormat::Stl, kStl)}) {
    const Model before = parse_model(format, "m", bytes);
    for (const double longest : {1.0, 0.3, 0.11}) {
      const Model model = parse_model(format, "d", dense(format, bytes, longest));
      EXPECT_LT(glm::distance(test::area_of(model), test::area_of(before)), 1e-6);
      EXPECT_EQ(model.groups().size(), before.groups().size());
      for (std::size_t face = 0; face < model.faces().n_rows(); ++face) {
        const auto loop = model.faces()[face];
        for (std::size_t i = 0; i < loop.size(); ++i) {
          EXPECT_LE(
              glm::distance(model.points()[static_cast<std::size_t>(loop[i])],
                            model.points()[static_cast<std::size_t>(loop[(i + 1) % loop.size()])]),
              longest * (1 + 1e-6));
        }
      }
    }
  }
}

TEST(DenseModelOfAnyFormat, of_a_damaged_file_is_made_or_refused) {
  for (const auto& [format, bytes] :
       {std::pair(ModelFormat::Off, kOff), std::pair(ModelFormat::Ply, kPly),
        std::pair(ModelFormat::Ply, binary_ply(false)), std::pair(ModelFormat::Stl, kStl)}) {
    for (std::size_t n = 0; n <= bytes.size(); ++n) {
      for (const std::string& damaged : {bytes.substr(0, n), std::string(bytes).erase(n, 1)}) {
        try {
          EXPECT_FALSE(dense(format, damaged, 0.8).empty());
        } catch (const Error&) {
        }
      }
    }
  }
}

}  // namespace
}  // namespace espalier
