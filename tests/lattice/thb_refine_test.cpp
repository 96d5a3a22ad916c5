#include "lattice/tensor/thb_refine.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

ThbLattice posed_lattice(int degree) {
  const int n = degree + 4;
  ThbLattice lattice = make_thb_lattice({n, n, n}, {degree, degree, degree}, {});
  lattice.pose = test::jittered(lattice.rest, 0.1, 1);
  return lattice;
}

glm::dvec3 value(const ThbLattice& lattice, const Volume& volume,
                 std::span<const glm::dvec3> points, const glm::dvec3& uvw) {
  const PatchPlace place = place_of(*lattice.hierarchy, lattice.hierarchy->leaves(), uvw);
  return volume.bezier(place.patch, points).value(place.uvw);
}

TEST(RefinedRound, moves_nothing) {
  for (const int degree : {1, 2, 3, 5}) {
    const ThbLattice before = posed_lattice(degree);
    ThbLattice after = before;
    for (int round = 0; round < 3; ++round) {
      after = refined_round(after, std::vector<glm::dvec3>{{0.3, 0.2, 0.7}, {0, 1, 0.5}});
    }
    EXPECT_EQ(after.hierarchy->n_levels(), 4);
    const Volume coarse = freeze(before);
    const Volume fine = freeze(after);
    const auto coarse_posed = coarse.points(before.pose);
    const auto fine_posed = fine.points(after.pose);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 uvw(unit(random), unit(random), unit(random));
      EXPECT_LT(glm::distance(value(before, coarse, coarse.rest_points(), uvw),
                              value(after, fine, fine.rest_points(), uvw)),
                1e-14);
      EXPECT_LT(glm::distance(value(before, coarse, coarse_posed, uvw),
                              value(after, fine, fine_posed, uvw)),
                1e-14);
    }
  }
}

TEST(RefinedRound, gives_the_place_a_function_of_the_new_level_wherever_it_is) {
  for (const int degree : {1, 2, 3, 4, 5}) {
    for (const glm::dvec3& uvw :
         {glm::dvec3(0.5, 0.45, 0.6), glm::dvec3(0, 0, 0), glm::dvec3(1, 0.3, 1)}) {
      ThbLattice lattice = posed_lattice(degree);
      for (int level = 1; level <= 3; ++level) {
        lattice = refined_round(lattice, std::vector<glm::dvec3>{uvw});
        const Volume volume = freeze(lattice);
        const auto& controls = lattice.hierarchy->controls();
        bool has_new = false;
        const PatchPlace place = place_of(*lattice.hierarchy, lattice.hierarchy->leaves(), uvw);
        for (const std::int32_t point : volume.block(place.patch)) {
          for (const std::int32_t c : volume.stencils()[static_cast<std::size_t>(point)].indices) {
            has_new |= controls[static_cast<std::size_t>(c)].level == level;
          }
        }
        EXPECT_TRUE(has_new) << degree << " " << level;
      }
    }
  }
}

TEST(CarriedOver, keeps_constants_and_zeros) {
  const ThbLattice before = posed_lattice(3);
  const ThbLattice after = refined_round(before, std::vector<glm::dvec3>{{0.5, 0.5, 0.5}});
  for (const double x : carried_over(before, after, std::vector<double>(before.rest.size(), 2.5))) {
    EXPECT_NEAR(x, 2.5, 1e-14);
  }
  for (const double x : carried_over(before, after, std::vector<double>(before.rest.size(), 0.0))) {
    EXPECT_EQ(x, 0);
  }
  // Those that stay keep their bits.
  std::vector<double> numbers;
  for (std::size_t i = 0; i < before.rest.size(); ++i) {
    numbers.push_back(0.1 * static_cast<double>(i));
  }
  const auto carried = carried_over(before, after, numbers);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (after.hierarchy->controls()[i] == before.hierarchy->controls()[k]) {
        EXPECT_EQ(carried[i], numbers[k]);
      }
    }
  }
  EXPECT_THROW((void)carried_over(before, after, std::vector<double>(3)), ParameterError);
}

}  // namespace
}  // namespace espalier
