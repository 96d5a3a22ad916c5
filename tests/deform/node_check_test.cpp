/// NodeCheck finds vertices round which refined cells fold.

#include "deform/fit/node_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lattice/build/cells.h"
#include "lattice/build/primitives.h"
#include "lattice/subdivision/edit.h"
#include "lattice/subdivision/refine.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// A cube of eight cells without one of them.
SubdivisionLattice seven_cubes() {
  const SubdivisionLattice cube = test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {2, 2, 2}));
  return edited_lattice(cube, delete_cells(mesh_of(cube), std::vector<std::int32_t>{7}));
}

std::size_t index_of(const SubdivisionLattice& lattice, const glm::dvec3& point) {
  return static_cast<std::size_t>(std::find(lattice.rest.begin(), lattice.rest.end(), point) -
                                  lattice.rest.begin());
}

TEST(NodeCheck, finds_no_fold_in_cubes_however_they_are_placed) {
  const SubdivisionLattice lattice = seven_cubes();
  const NodeCheck check(lattice);
  for (const double size : {1e-8, 1.0, 1e8}) {
    std::vector<glm::dvec3> rest;
    for (const glm::dvec3& p : lattice.rest) {
      rest.push_back(size * glm::dvec3(p.x + 0.3 * p.y, p.y - 0.2 * p.z, p.z + 0.1 * p.x + 5));
    }
    const std::vector<char> folded = check.folded(rest);
    EXPECT_EQ(folded, std::vector<char>(lattice.rest.size(), 0)) << size;
  }
}

TEST(NodeCheck, finds_a_vertex_that_is_pulled_through_its_cells) {
  const SubdivisionLattice lattice = seven_cubes();
  const NodeCheck check(lattice);
  const std::size_t middle = index_of(lattice, {1, 1, 1});
  std::vector<glm::dvec3> rest = lattice.rest;
  rest[middle] = {-3, -3, -3};
  EXPECT_EQ(check.folded(rest)[middle], 1);
  rest[middle] = {0.9, 0.9, 0.9};
  EXPECT_EQ(check.folded(rest)[middle], 0);
}

TEST(NodeCheck, finds_what_refined_cells_show) {
  // The refined lattice's own vertices round the middle are what the rule makes of the coarse ones.
  SubdivisionLattice lattice = seven_cubes();
  const std::size_t middle = index_of(lattice, {1, 1, 1});
  const NodeCheck coarse(lattice);
  for (const double at : {1.0, 0.5, 0.0, -0.5, -1.0, -3.0}) {
    lattice.rest[middle] = glm::dvec3(at);
    const SubdivisionLattice fine = refined(lattice, 1);
    const NodeCheck check(fine);
    // Vertex points keep their numbers; the coarse check looks at one level more.
    EXPECT_GE(coarse.folded(lattice.rest)[middle], check.folded(fine.rest)[middle]) << at;
  }
}

}  // namespace
}  // namespace espalier
