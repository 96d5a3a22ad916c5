#include "deform/embed/thb_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/evaluate/displace.h"
#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// Of 4 × 4 × 4 cells on the unit cube, at rest bent and posed at random.
ThbLattice bent_box() {
  ThbLattice lattice = make_thb_lattice({7, 7, 7}, {3, 3, 3}, {});
  for (glm::dvec3& p : lattice.rest) {
    p.x += 0.1 * p.y * p.y;
  }
  lattice.pose = test::jittered(lattice.rest, 0.1, 4);
  return lattice;
}

std::vector<glm::dvec3> moved(const ThbLattice& lattice, const std::vector<glm::dvec3>& points) {
  const Volume volume = freeze(lattice);
  return point_displacements(volume, embed(volume, points),
                             volume.displacements(lattice.posed_points()));
}

TEST(ThbRegion, under_points_holds_them_on_every_level_and_moves_nothing) {
  const ThbLattice before = bent_box();
  const std::vector<glm::dvec3> picked = {{0.3, 0.6, 0.53}, {0.35, 0.61, 0.55}, {0.4, 0.7, 0.52}};
  std::vector<glm::dvec3> all = picked;
  for (int i = 0; i < 100; ++i) {
    all.emplace_back(0.2 + 0.006 * i, 0.01 * i, 0.5);
  }
  const std::vector<glm::dvec3> expected = moved(before, all);
  for (const int n_rings : {0, 1, 2}) {
    const ThbLattice after = refined_under(before, picked, 3, n_rings);
    ASSERT_EQ(after.hierarchy->n_levels(), 4);
    for (int level = 1; level <= 3; ++level) {
      const auto cells = cells_holding(*after.hierarchy, level, places_of_points(after, picked));
      EXPECT_FALSE(cells.empty());
      for (const GridIndex& cell :
           with_rings(cells, after.hierarchy->n_cells(level - 1), n_rings)) {
        EXPECT_TRUE(after.hierarchy->is_in_domain(level, {2 * cell.i, 2 * cell.j, 2 * cell.k}));
      }
    }
    EXPECT_EQ(after.hierarchy->n_controls_by_level()[1] > 0, n_rings > 0);
    const std::vector<glm::dvec3> found = moved(after, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_LT(glm::distance(found[i], expected[i]), 1e-13);
    }
  }
}

TEST(ThbRegion, adds_to_what_is_refined_and_the_lattice_before_undoes_it) {
  const ThbLattice before = bent_box();
  const ThbLattice once = refined_under(before, std::vector<glm::dvec3>{{0.3, 0.6, 0.5}}, 1, 1);
  const ThbLattice twice = refined_under(once, std::vector<glm::dvec3>{{0.9, 0.6, 0.1}}, 1, 1);
  const auto first = once.hierarchy->domain(1);
  const auto both = twice.hierarchy->domain(1);
  EXPECT_GT(both.size(), first.size());
  EXPECT_TRUE(std::includes(both.begin(), both.end(), first.begin(), first.end()));
  EXPECT_EQ(before.hierarchy->n_levels(), 1);  // still what it was
  EXPECT_EQ(before.rest.size(), 343u);
}

TEST(ThbRegion, rings_end_at_the_grid) {
  EXPECT_EQ(with_rings(std::vector<GridIndex>{{0, 1, 3}}, {4, 2, 4}, 1).size(), 2u * 2 * 2);
  EXPECT_EQ(with_rings(std::vector<GridIndex>{{0, 0, 0}, {1, 0, 0}}, {4, 4, 4}, 0),
            (std::vector<GridIndex>{{0, 0, 0}, {1, 0, 0}}));
}

TEST(ThbRegion, names_what_cannot_be) {
  const ThbLattice lattice = bent_box();
  const std::vector<glm::dvec3> inside = {{0.5, 0.5, 0.5}};
  EXPECT_THROW((void)refined_under(lattice, inside, 0), ParameterError);
  EXPECT_THROW((void)refined_under(lattice, inside, kMostThbLevels), ParameterError);
  EXPECT_THROW((void)refined_under(lattice, inside, 1, -1), ParameterError);
  EXPECT_THROW((void)refined_under(lattice, inside, 1, 17), ParameterError);
  EXPECT_THROW((void)refined_under(lattice, std::vector<glm::dvec3>{{7, 7, 7}}, 1), ParameterError);
  EXPECT_THROW((void)refined_under(lattice, {}, 1), ParameterError);
}

TEST(ThbRegion, that_would_be_huge_is_refused_before_it_grows) {
  const ThbLattice lattice = make_thb_lattice({52, 52, 52}, {1, 1, 1}, {});
  std::vector<glm::dvec3> points;  // 16 rings round them cover all 51 × 51 × 51 cells
  for (int i = 0; i < 27; ++i) {
    points.emplace_back((i % 3 + 0.5) / 3, (i / 3 % 3 + 0.5) / 3, (i / 9 + 0.5) / 3);
  }
  try {
    (void)refined_under(lattice, points, 1, 16);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(),
                 "level 1 would refine 132651 cells, at most 131072 are refined at once: take "
                 "fewer rings or levels");
  }
}

}  // namespace
}  // namespace espalier
