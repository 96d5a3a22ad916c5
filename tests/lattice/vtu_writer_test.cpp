/// The layout of .vtu files; what VTK reads from them is the matter of tests/tools/vtu_test.py.

#include "lattice/io/vtu_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "lattice/core/error.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

TEST(VtkPointOrder, of_a_trilinear_cell_goes_round_the_bottom_and_then_round_the_top) {
  EXPECT_EQ(vtk_point_order({1, 1, 1}), (std::vector<std::int32_t>{0, 1, 3, 2, 4, 5, 7, 6}));
}

TEST(VtkPointOrder, of_a_triquadratic_cell_is_corners_edges_faces_inside) {
  EXPECT_EQ(vtk_point_order({2, 2, 2}),
            (std::vector<std::int32_t>{0, 2,  8,  6,  18, 20, 26, 24,         // corners
                                       1, 5,  7,  3,  19, 23, 25, 21,         // round w = 0, 1
                                       9, 11, 17, 15, 12, 14, 10, 16, 4, 22,  // along w, faces
                                       13}));
}

TEST(VtkPointOrder, names_every_point_once_in_any_degree) {
  for (int p = 1; p <= 5; ++p) {
    for (int q = 1; q <= 5; ++q) {
      for (int r = 1; r <= 5; ++r) {
        std::vector<std::int32_t> order = vtk_point_order({p, q, r});
        std::sort(order.begin(), order.end());
        std::vector<std::int32_t> all(static_cast<std::size_t>((p + 1) * (q + 1) * (r + 1)));
        std::iota(all.begin(), all.end(), 0);
        EXPECT_EQ(order, all) << p << q << r;
      }
    }
  }
}

/// How often a text occurs in another.
std::size_t n_occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++n;
  }
  return n;
}

TEST(VtuText, shares_the_points_of_neighbours) {
  const SubdivisionLattice lattice = test::prism(test::grid_section(2, 1), 1);
  const Volume volume = freeze_adaptive(lattice);
  ASSERT_EQ(volume.n_patches(), 2u);
  const std::string text = vtu_text(volume, volume.rest_points());
  EXPECT_EQ(n_occurrences(text, R"(<Piece NumberOfPoints="112" NumberOfCells="2">)"), 1u) << text;
}

TEST(VtuText, has_rational_weights_only_where_weights_are_given) {
  const Volume volume = freeze_uniform(test::tetrahedron(), 1);
  const std::string plain = vtu_text(volume, volume.rest_points());
  EXPECT_EQ(n_occurrences(plain, "PointData"), 0u);
  EXPECT_EQ(n_occurrences(plain, "RationalWeights"), 0u);
  const std::vector<double> weights(volume.n_points(), 2);
  const std::string rational = vtu_text(volume, volume.rest_points(), weights);
  EXPECT_EQ(n_occurrences(rational, R"(<PointData RationalWeights="RationalWeights">)"), 1u);
}

TEST(VtuText, has_polyhedra_only_where_cells_are_no_hexahedra) {
  const SubdivisionLattice box = test::prism(test::grid_section(2, 1), 1);
  EXPECT_EQ(n_occurrences(vtu_text(*box.complex, box.rest), "faceoffsets"), 0u);
  const SubdivisionLattice mixed = test::pyramid_on_cube();
  EXPECT_EQ(n_occurrences(vtu_text(*mixed.complex, mixed.rest), "faceoffsets"), 1u);
}

TEST(VtuText, refuses_points_and_weights_that_do_not_match) {
  const SubdivisionLattice lattice = test::tetrahedron();
  const Volume volume = freeze_uniform(lattice, 1);
  const auto points = volume.rest_points();
  EXPECT_THROW(static_cast<void>(vtu_text(volume, points.first(3))), ParameterError);
  EXPECT_THROW(static_cast<void>(vtu_text(*lattice.complex, points.first(3))), ParameterError);
  std::vector<double> weights(points.size(), 1);
  EXPECT_THROW(static_cast<void>(vtu_text(volume, points, std::span(weights).first(3))),
               ParameterError);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    weights[2] = bad;
    EXPECT_THROW(static_cast<void>(vtu_text(volume, points, weights)), ParameterError);
  }
}

TEST(VtuPath, is_known_in_any_case) {
  EXPECT_TRUE(is_vtu_path("a/b.vtu"));
  EXPECT_TRUE(is_vtu_path("B.VTU"));
  EXPECT_FALSE(is_vtu_path("vtu"));
  EXPECT_FALSE(is_vtu_path("a.vtu.json"));
}

}  // namespace
}  // namespace espalier
