#include "deform/model/dense_model.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "deform/model/model_file.h"
#include "deform/model/obj.h"
#include "deform/model/polygon_cuts.h"
#include "deform/scene/densify.h"
#include "lattice/core/error.h"
#include "tests/deform/odd_obj_files.h"
#include "tests/deform/surfaces.h"
#include "tests/support/spline_volume.h"

namespace espalier {
namespace {

std::string dense(const std::string& bytes, double longest,
                  DensifyMethod method = DensifyMethod::Midpoint) {
  return std::string(dense_model(parse_obj("m.obj", bytes), method, longest, "d.obj").bytes());
}

TEST(DenseModel, stands_in_the_models_own_file) {
  const std::string before =
      "# mine\r\nmtllib a.mtl\r\nv 0 0 0 1 0 0\r\nv 2 0 0 0 1 0\r\nv 0 1 0 0 0 1\r\n"
      "v 1 -0.5 0 0 0 0\r\nvt 0 0\r\nvt 1 0\r\nvt 0.5 1\r\nvn 0 0 1\r\ng left  # x\r\n"
      "usemtl red\r\ns 1\r\n";
  EXPECT_EQ(dense(before + "\tf  1/1/1 2/2/1 3/3/1   # the one\r\ng right\r\nf 1 2 4\r\nl 1 -1", 2),
            before +
                "v 1 0.5 0 0 0.5 0.5\r\nvt 0.75 0.5\r\n"
                "\tf  2/2/1 5/4/1 1/1/1\r\nf 5/4/1 3/3/1 1/1/1   # the one\r\n"
                "g right\r\nf 1 2 4\r\nl 1 4");
}

TEST(DenseModel, numbers_elements_anew_that_stand_after_the_first_face) {
  const std::string text =
      "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"
      "o b\nv 0 0 5\nv 1 0 5\nv 0 1 5\nvt 1 1\nvn 0 0 1\nf -3/-1/1 -2/2/1 6/2/1\nl 4 -1\nf 1 2 6\n";
  const Model before = parse_obj("m.obj", text);
  const Model after = parse_obj("m.obj", dense(text, 1.2));
  EXPECT_LT(glm::distance(test::area_of(before), test::area_of(after)), 1e-12);
  ASSERT_EQ(after.groups().size(), 2u);
  EXPECT_EQ(after.groups()[0].ranges, (std::vector<FaceRange>{{0, 2}}));
  EXPECT_EQ(after.groups()[1].name, "b");
  EXPECT_GT(after.groups()[1].ranges[0].end, 4);
  const std::string bytes(after.bytes());
  const std::size_t line = bytes.find("\nl ") + 3;
  int first = 0;
  int last = 0;
  ASSERT_EQ(std::sscanf(bytes.c_str() + line, "%d %d", &first, &last), 2);
  EXPECT_EQ(after.points()[static_cast<std::size_t>(first - 1)], glm::dvec3(0, 0, 5));
  EXPECT_EQ(after.points()[static_cast<std::size_t>(last - 1)], glm::dvec3(0, 1, 5));
  for (const PointNormal& pair : after.pairs()) {
    EXPECT_EQ(after.normals()[static_cast<std::size_t>(pair.normal)], glm::dvec3(0, 0, 1));
  }
}

TEST(DenseModel, is_the_model_itself_where_its_edges_are_short) {
  const Model model = parse_obj("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(dense_model(model, DensifyMethod::Loop, 1.5, "d.obj").bytes().data(),
            model.bytes().data());
}

TEST(DenseModel, moves_old_points_in_their_places_by_smooth_methods) {
  const std::string octahedron =
      "v 1 0 0\nv 0 1 0\nv 0 0 1 # top\nf 1 2 3\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n"
      "f 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n";
  const std::string bytes = dense(octahedron, 1.2, DensifyMethod::Loop);
  EXPECT_NE(bytes.find("v 0.515625 0 0\nv 0 0.515625 0\nv 0 0 0.515625 # top\n"),
            std::string::npos);
  EXPECT_NE(bytes.find("v -0.515625 0 0\nv 0 -0.515625 0\nv 0 0 -0.515625\n"), std::string::npos);
  EXPECT_EQ(parse_obj("d.obj", bytes).faces().n_rows(), 32u);
}

TEST(DenseModel, of_odd_files_reads_back_with_the_same_surface) {
  for (const OddObjFile& file : odd_obj_files()) {
    const Model before = parse_obj("m.obj", file.bytes);
    for (const double longest : {0.4, 0.7}) {
      std::string bytes;
      try {
        bytes = dense(file.bytes, longest);
      } catch (const ParameterError&) {
        continue;  // without faces, or with free-form surfaces
      }
      const Model after = parse_obj("d.obj", bytes);
      const double size = 1 + glm::length(test::area_of(before));
      EXPECT_LT(glm::distance(test::area_of(before), test::area_of(after)), 1e-5 * size)
          << file.what;
      EXPECT_EQ(after.groups().size(), before.groups().size()) << file.what;
    }
  }
}

TEST(DenseModel, of_a_damaged_file_is_made_or_refused) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\nf 1/1/1 2//1 3/1\nf 3/-1 2 -3\n";
  for (std::size_t n = 0; n <= text.size(); ++n) {
    try {
      EXPECT_FALSE(dense(text.substr(0, n), 0.3).empty());
    } catch (const Error&) {
    }
  }
}

TEST(DenseModel, names_what_it_does_not_take) {
  const auto error_of = [](const Model& model) -> std::string {
    try {
      (void)dense_model(model, DensifyMethod::Midpoint, 0.1, "d.obj");
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of(parse_obj("m.obj", "v 0 0 0\n")), "densify: m.obj has no faces");
  EXPECT_EQ(error_of(parse_obj("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncurv 0 1 1 2\n")),
            "densify: m.obj has free-form curves or surfaces (line 5), only polygons are refined");
}

TEST(FinestSpacing, is_that_of_the_control_points_that_move_the_model) {
  TensorLattice lattice =
      make_tensor_lattice(TensorKind::BSpline,
                          {TensorAxis::from_knots(1, {0, 0, 1, 2, 3, 3.5, 4, 4}),
                           TensorAxis::make(2, 1, Ends::Open), TensorAxis::make(2, 1, Ends::Open)},
                          {glm::dvec3(4, 4, 4), glm::dmat3(1.0), glm::dvec3(4, 4, 4)});
  const Volume volume = freeze(lattice);
  const auto spacing = [&](const glm::dvec3& point) {
    return finest_spacing(Lattice(lattice), volume, embed(volume, std::vector{point}));
  };
  EXPECT_NEAR(spacing({1, 1, 1}), 2, 1e-12);    // of 8 over knots 0, 1, 2, 3, 3.5, 4
  EXPECT_NEAR(spacing({7.5, 1, 1}), 1, 1e-12);  // one of the last two spans
  EXPECT_THROW((void)spacing({20, 20, 20}), ParameterError);
}

TEST(ParseDensify, takes_a_method_with_or_without_a_length) {
  EXPECT_EQ(parse_densify("loop").method, DensifyMethod::Loop);
  EXPECT_EQ(parse_densify("loop").length, 0);
  EXPECT_EQ(parse_densify("catmull-clark:0.25").length, 0.25);
  for (const char* bad : {"", "loop:", "loop:-1", "loop:nan", "loop:inf", "more", "midpoint:0"}) {
    EXPECT_THROW((void)parse_densify(bad), ParameterError) << bad;
  }
}

}  // namespace
}  // namespace espalier
