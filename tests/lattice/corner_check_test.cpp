#include "lattice/topology/corner_check.h"

#include <gtest/gtest.h>

#include "lattice/build/primitives.h"

namespace espalier {
namespace {

TEST(CornerCheck, finds_no_cell_inverted_in_grids_and_wedges) {
  const CellMesh box = make_box({2, 3, 1}, glm::dvec3(0), glm::dvec3(1));
  EXPECT_EQ(count_cells_inverted_at_corners(CellComplex(box.cells), box.points), 0u);
  const CellMesh bar = make_cylinder({});
  EXPECT_EQ(count_cells_inverted_at_corners(CellComplex(bar.cells), bar.points), 0u);
}

TEST(CornerCheck, counts_the_cells_at_a_vertex_pushed_through_their_far_sides) {
  CellMesh box = make_box({2, 2, 2}, glm::dvec3(0), glm::dvec3(2));
  const CellComplex complex(box.cells);
  box.points[0] = glm::dvec3(0.9);  // of one cell, short of where its three faces fold
  EXPECT_EQ(count_cells_inverted_at_corners(complex, box.points), 1u);
  box.points[0] = glm::dvec3(0);
  box.points[13] = glm::dvec3(-0.5);  // the middle, of eight: away from the last
  EXPECT_EQ(count_cells_inverted_at_corners(complex, box.points), 7u);
}

}  // namespace
}  // namespace espalier
