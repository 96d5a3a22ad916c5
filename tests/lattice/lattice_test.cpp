#include "lattice/io/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

std::vector<Lattice> lattices_of_all_types() {
  const TensorAxis bezier = TensorAxis::make(3, 2, Ends::Open);
  const TensorAxis ring = TensorAxis::make(5, 3, Ends::Periodic);
  const ThbLattice root = make_thb_lattice({3, 3, 3}, {1, 1, 1}, {});
  return {test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1})),
          make_tensor_lattice(TensorKind::Bezier, {bezier, bezier, bezier}, {}),
          make_tensor_lattice(TensorKind::BSpline, {ring, bezier, TensorAxis()}, {}),
          make_tensor_lattice(TensorKind::Nurbs, {bezier, bezier, bezier}, {}),
          with_cells(root, 1, cells_of_box(*root.hierarchy, 1, glm::dvec3(0), glm::dvec3(0.5)))};
}

TEST(Lattice, of_every_type_has_points_a_net_and_a_volume) {
  const std::vector<std::string> types = {"subdivision", "bezier", "bspline", "nurbs", "thb"};
  // A grid of 3 × 3 × 3; a ring of 5 by 3; of the hierarchy the coarse grid without the corner that
  // the fine one replaces, and 2 × 2 × 2 fine ones.
  const std::vector<std::size_t> n_edges = {54, 54, 5 * 3 + 5 * 2, 54, 54 - 3 + 12};
  const std::vector<Lattice> lattices = lattices_of_all_types();
  for (std::size_t i = 0; i < lattices.size(); ++i) {
    const Lattice& lattice = lattices[i];
    EXPECT_EQ(lattice.type(), types[i]);
    const Volume volume = lattice.freeze();
    EXPECT_TRUE(std::equal(volume.rest_controls().begin(), volume.rest_controls().end(),
                           lattice.rest_points().begin(), lattice.rest_points().end()));
    EXPECT_TRUE(std::equal(lattice.rest_points().begin(), lattice.rest_points().end(),
                           lattice.posed_points().begin(), lattice.posed_points().end()));
    EXPECT_EQ(lattice.net().size(), n_edges[i]) << types[i];
    for (const auto& [a, b] : lattice.net()) {
      EXPECT_NE(a, b);
      EXPECT_LT(static_cast<std::size_t>(std::max(a, b)), volume.n_controls());
    }
  }
}

TEST(Lattice, freezes_a_subdivision_lattice_as_it_is_told_to) {
  const Lattice lattice = lattices_of_all_types()[0];
  EXPECT_EQ(lattice.freeze().degree(0), (std::array<int, 3>{3, 3, 3}));
  EXPECT_EQ(lattice.freeze({.adaptive = {}, .uniform_levels = 1}).n_patches(), 64u);
}

TEST(Lattice, of_every_type_is_what_its_file_holds) {
  const std::string path = testing::TempDir() + "/lattice_of_any_type.json";
  for (const Lattice& lattice : lattices_of_all_types()) {
    write_any_lattice(path, lattice);
    const Lattice read = read_any_lattice(path);
    EXPECT_EQ(read.type(), lattice.type());
    EXPECT_TRUE(std::equal(read.rest_points().begin(), read.rest_points().end(),
                           lattice.rest_points().begin(), lattice.rest_points().end()));
    EXPECT_EQ(read.net(), lattice.net());
  }
  std::filesystem::remove(path);
}

TEST(Lattice, only_json_holds_all_types) {
  for (const Lattice& lattice : lattices_of_all_types()) {
    if (lattice.as<SubdivisionLattice>() == nullptr) {
      EXPECT_THROW(write_any_lattice("a.ovm", lattice), FileError);
      EXPECT_THROW(write_any_lattice("a.txt", lattice), FileError);
    }
  }
}

}  // namespace
}  // namespace espalier
