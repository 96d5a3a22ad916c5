#include "lattice/volume/patch_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "lattice/build/primitives.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/tensor/thb_lattice.h"
#include "lattice/volume/point_locator.h"
#include "tests/support/families.h"
#include "tests/support/places.h"

namespace espalier {
namespace {

struct NamedVolume {
  std::string name;
  Volume volume;
};

OrientedBox turned_box() {
  OrientedBox box;
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  box.axes = glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1) * glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c);
  box.half_sizes = {0.5, 2, 0.25};
  box.center = {3, -4, 5};
  return box;
}

ThbLattice nested_thb() {
  ThbLattice thb = make_thb_lattice({7, 7, 7}, {2, 2, 2}, turned_box());
  thb = with_cells(thb, 1, cells_of_box(*thb.hierarchy, 1, glm::dvec3(0), glm::dvec3(0.6)));
  return with_cells(thb, 2, cells_of_box(*thb.hierarchy, 2, glm::dvec3(0), glm::dvec3(0.4)));
}

/// Volumes whose patches are boxes in a grid: aligned, turned, oblique, far from the origin, of
/// uneven knots, of several levels, trilinear.
std::vector<NamedVolume> grids() {
  const TensorAxis cubic = TensorAxis::make(8, 3, Ends::Open);
  const TensorAxis quadratic = TensorAxis::make(5, 2, Ends::Uniform);
  const TensorAxis uneven = with_knots(cubic, std::vector<double>{0.01, 0.02, 2.5, 2.75}).axis;
  std::vector<NamedVolume> all;
  const auto lattice = [&](const OrientedBox& box) {
    return make_tensor_lattice(TensorKind::BSpline, {cubic, uneven, quadratic}, box,
                               BoxFilling::Volume);
  };
  all.push_back({"aligned", freeze(lattice({}))});
  all.push_back({"turned", freeze(lattice(turned_box()))});
  TensorLattice oblique = lattice({});
  const glm::dmat3 A(1.2, 0.1, 0.3, -0.2, 0.9, 0.1, 0.0, 0.4, 1.1);
  for (glm::dvec3& point : oblique.rest) {
    point = A * point + glm::dvec3(3, 4, 5);
  }
  all.push_back({"oblique", freeze(oblique)});
  TensorLattice far = lattice({});
  for (glm::dvec3& point : far.rest) {
    point += glm::dvec3(1e5, -2e5, 0);
  }
  all.push_back({"far", freeze(far)});
  all.push_back({"thb", freeze(nested_thb())});
  all.push_back({"trilinear",
                 freeze_uniform(test::lattice_from(make_box({3, 2, 2}, {0, 0, 0}, {3, 2, 2})), 1)});
  return all;
}

/// Inside, on faces, edges and corners, as far from them as it is closed and somewhat more, and
/// outside.
std::vector<glm::dvec3> probes(const Volume& volume) {
  std::vector<glm::dvec3> points = test::points_inside(volume, 4000, 21);
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(-1, 1);
  const std::size_t n = points.size();
  for (const double step : {1e-15, 0.5e-9, 1e-9, 2e-9, 5e-9, 1e-7, 0.1}) {
    for (std::size_t i = 0; i < n; i += 4) {
      points.push_back(points[i] + step * volume.diagonal() *
                                       glm::dvec3(unit(random), unit(random), unit(random)));
    }
  }
  return points;
}

/// The largest coordinate, which round-off is relative to.
double largest_coordinate(const Volume& volume) {
  double largest = 0;
  for (const glm::dvec3& point : volume.rest_points()) {
    largest = std::max({largest, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  }
  return largest;
}

PatchGrid grid_of(const Volume& volume) {
  const double margin = 2e-9 * volume.diagonal() + 1e-14 * largest_coordinate(volume);
  return {RestPatches(volume, margin), margin};
}

TEST(PatchGrid, gives_the_same_places_as_the_tree_bit_for_bit) {
  for (const auto& [name, volume] : grids()) {
    const std::vector<glm::dvec3> points = probes(volume);
    const auto by_grid = PointLocator(volume).locate(points);
    const auto by_tree = PointLocator(volume, PatchSearch::Tree).locate(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(by_grid[i].status, by_tree[i].status) << name << i;
      ASSERT_EQ(by_grid[i].patch, by_tree[i].patch) << name << i;
      ASSERT_EQ(by_grid[i].uvw, by_tree[i].uvw) << name << i;
      ASSERT_EQ(by_grid[i].n_steps, by_tree[i].n_steps) << name << i;
    }
  }
}

TEST(PointLocator, holds_points_by_patch_as_it_locates_them) {
  for (const auto& [name, volume] : grids()) {
    const std::vector<glm::dvec3> once = probes(volume);
    std::vector<glm::dvec3> points = once;
    while (points.size() < 35000) {  // more than are looked at together
      points.insert(points.end(), once.begin(), once.begin() + 5000);
    }
    for (const PatchSearch search : {PatchSearch::Quickest, PatchSearch::Tree}) {
      const PointLocator locator(volume, search);
      const std::vector<Location> located = locator.locate(points);
      const HeldPoints held = locator.hold(points);
      ASSERT_EQ(held.status.size(), points.size());
      std::size_t n_held = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(held.status[i], located[i].status) << name << i;
        n_held += located[i].patch >= 0 ? 1 : 0;
      }
      ASSERT_EQ(held.points.size(), n_held);
      for (std::size_t k = 0; k < n_held; ++k) {
        const auto i = static_cast<std::size_t>(held.points[k]);
        ASSERT_EQ(held.patches[k], located[i].patch) << name << i;
        ASSERT_EQ(held.uvw[k], located[i].uvw) << name << i;
        ASSERT_TRUE(k == 0 || held.patches[k - 1] < held.patches[k] ||
                    (held.patches[k - 1] == held.patches[k] && held.points[k - 1] < held.points[k]))
            << name << k;
      }
    }
  }
}

TEST(PatchGrid, finds_what_is_inside_patches_and_nothing_at_their_faces) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(1e-4, 1 - 1e-4);
  for (const auto& [name, volume] : grids()) {
    const PatchGrid grid = grid_of(volume);
    ASSERT_FALSE(grid.is_empty()) << name;
    std::size_t n_found = 0;
    for (std::size_t i = 0; i < volume.n_patches(); ++i) {
      const BezierPatch patch = volume.bezier(i, volume.rest_points());
      const glm::dvec3 uvw(unit(random), unit(random), unit(random));
      const auto place = grid.find(patch.value(uvw));
      if (place) {
        ++n_found;
        EXPECT_EQ(place->patch, static_cast<std::int32_t>(i)) << name;
        EXPECT_LT(glm::distance(place->uvw, uvw), 1e-12 * (1 + largest_coordinate(volume))) << name;
      }
      EXPECT_FALSE(grid.find(patch.value({0, uvw.y, uvw.z}))) << name;
      EXPECT_FALSE(grid.find(patch.value({uvw.x, 1, uvw.z}))) << name;
      EXPECT_FALSE(grid.find(patch.value({uvw.x, uvw.y, 1 - 1e-12}))) << name;
    }
    EXPECT_EQ(n_found, volume.n_patches()) << name;
  }
}

TEST(PatchGrid, is_empty_where_patches_are_bent_or_stand_askew) {
  const SubdivisionLattice flower = test::prism(test::flower_section(5), 2);
  EXPECT_TRUE(grid_of(freeze_adaptive(flower)).is_empty());
  TensorLattice bent =
      make_tensor_lattice(TensorKind::Bezier,
                          {TensorAxis::make(3, 2, Ends::Open), TensorAxis::make(3, 2, Ends::Open),
                           TensorAxis::make(3, 2, Ends::Open)},
                          {});
  EXPECT_FALSE(grid_of(freeze(bent)).is_empty());
  bent.rest[13].x += 1e-6;
  EXPECT_TRUE(grid_of(freeze(bent)).is_empty());
}

TEST(PatchGrid, finds_nothing_where_boxes_overlap) {
  // Two boxes, the second over half of the first: x from 0 to 2 and from 1 to 3.
  VolumeTables tables;
  tables.extractions = {bezier_extraction(1)};
  std::vector<glm::dvec3> points;
  for (int box = 0; box < 2; ++box) {
    std::vector<std::int32_t> block;
    for (int i = 0; i < 8; ++i) {
      block.push_back(static_cast<std::int32_t>(points.size()));
      points.emplace_back(box + 2 * (i % 2), i / 2 % 2, i / 4);
    }
    tables.blocks.push_back(block);
    tables.patches.emplace_back();
  }
  tables.stencils = StencilTable::build(
      points.size(), points.size(),
      [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1); });
  const Volume volume(std::move(tables), points);
  const PatchGrid grid = grid_of(volume);
  ASSERT_TRUE(grid.find({0.5, 0.5, 0.5}));
  EXPECT_EQ(grid.find({0.5, 0.5, 0.5})->patch, 0);
  EXPECT_FALSE(grid.find({1.5, 0.5, 0.5}));
  ASSERT_TRUE(grid.find({2.5, 0.5, 0.5}));
  EXPECT_EQ(grid.find({2.5, 0.5, 0.5})->patch, 1);
  EXPECT_EQ(PointLocator(volume).locate({1.5, 0.5, 0.5}).patch, 0);
}

TEST(IntervalTable, finds_every_interval_of_lengths_from_1_to_1e_minus_9) {
  std::vector<double> bounds = {-3};
  for (int i = 0; i < 40; ++i) {
    bounds.push_back(bounds.back() + std::pow(10.0, -(i % 10)));
  }
  const IntervalTable table(bounds, 1e-12);
  for (std::size_t i = 0; i < table.n_intervals(); ++i) {
    const double length = bounds[i + 1] - bounds[i];
    for (const double t : {0.01, 0.5, 0.99}) {
      EXPECT_EQ(table.find(bounds[i] + t * length), static_cast<std::int32_t>(i));
    }
    EXPECT_EQ(table.find(bounds[i]), -1);
    EXPECT_EQ(table.find(bounds[i + 1] - 1e-13), -1);
  }
  EXPECT_EQ(table.find(-3.1), -1);
  EXPECT_EQ(table.find(1e300), -1);
  EXPECT_EQ(table.find(NAN), -1);
}

}  // namespace
}  // namespace espalier
