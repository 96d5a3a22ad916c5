/// Adaptive volumes against explicit refinement and its limits.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "lattice/build/primitives.h"
#include "lattice/core/box_tree.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/cell_class.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/subdivision/limit.h"
#include "lattice/subdivision/refine.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

/// Limit positions of a lattice refined three times, for two sets of control points.
struct Limits {
  std::vector<glm::dvec3> rest;
  std::vector<glm::dvec3> pose;
};

Limits limits_of(const SubdivisionLattice& lattice, std::span<const glm::dvec3> pose) {
  const SubdivisionLattice fine = [&] {
    SubdivisionLattice posed = lattice;
    posed.pose.assign(pose.begin(), pose.end());
    return refined(posed, 3);
  }();
  const Hexahedra hexahedra(*fine.complex);
  const Sharpness sharpness = with_touching_elements(*fine.complex, fine.sharpness);
  Limits limits;
  for (const VertexId vertex : fine.complex->vertices()) {
    const auto limit = limit_position(hexahedra, sharpness, fine.scheme, vertex);
    if (!limit) {
      continue;
    }
    glm::dvec3 rest(0);
    glm::dvec3 posed(0);
    for (const auto& [source, weight] : *limit) {
      rest += weight * fine.rest[source.index()];
      posed += weight * fine.pose[source.index()];
    }
    limits.rest.push_back(rest);
    limits.pose.push_back(posed);
  }
  return limits;
}

/// What comparing a volume with limits has shown.
struct Comparison {
  std::size_t n_found = 0;  ///< samples of exact patches that are limit points
  std::size_t n_exact = 0;  ///< exact patches
  std::size_t n_leaves = 0;
  double largest = 0;  ///< distance of a found sample from its limit point, posed
};

Comparison compare(const SubdivisionLattice& lattice) {
  const std::vector<glm::dvec3> pose = test::jittered(lattice.rest, 0.2, 23);
  const Volume volume = freeze_adaptive(lattice, {.tolerance = 1e-2});
  const Limits limits = limits_of(lattice, pose);
  std::vector<Box> boxes;
  for (const glm::dvec3& point : limits.rest) {
    boxes.push_back({point, point});
  }
  const BoxTree tree(std::move(boxes));
  const auto posed_points = volume.points(pose);
  Comparison result;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    if (volume.patch(i).is_leaf) {
      ++result.n_leaves;
      continue;
    }
    ++result.n_exact;
    const BezierPatch rest = volume.bezier(i, volume.rest_points());
    const BezierPatch posed = volume.bezier(i, posed_points);
    for (int c = 0; c < 27; ++c) {
      const glm::dvec3 uvw = glm::dvec3(c % 3, c / 3 % 3, c / 9) / 2.0;
      const glm::dvec3 at = rest.value(uvw);
      tree.visit_overlapping(Box{at, at}.grown(1e-11), [&](std::size_t found) {
        ++result.n_found;
        result.largest =
            std::max(result.largest, glm::distance(posed.value(uvw), limits.pose[found]));
      });
    }
  }
  return result;
}

TEST(FreezeAdaptive, makes_one_tricubic_patch_of_a_regular_cell_exactly) {
  for (const auto& cells : {std::array{1, 1, 1}, std::array{3, 1, 2}, std::array{4, 4, 4}}) {
    const SubdivisionLattice box = test::lattice_from(
        make_box(cells, {0, 0, 0}, {cells[0] + 0.0, cells[1] + 0.0, cells[2] + 0.0}));
    const Volume volume = freeze_adaptive(box);
    EXPECT_EQ(volume.n_patches(), box.complex->n_cells());
    EXPECT_EQ(volume.n_points(), box.complex->n_vertices());
    const Comparison found = compare(box);
    EXPECT_EQ(found.n_leaves, 0u);
    EXPECT_GE(found.n_found, 27 * found.n_exact);
    EXPECT_LT(found.largest, 1e-12);
  }
}

TEST(FreezeAdaptive, is_exact_over_extruded_lattices_away_from_the_leaves) {
  for (const test::Section& section : test::irregular_sections()) {
    const Comparison found = compare(test::prism(section, 3));
    EXPECT_GT(found.n_found, 27u * 12) << section.name;
    EXPECT_LT(found.largest, 1e-12) << section.name;
    EXPECT_LE(found.n_leaves, 3u * 2 * section.faces.n_rows() * 4) << section.name;
  }
}

TEST(FreezeAdaptive, is_exact_in_every_family_away_from_the_leaves) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Comparison found = compare(family.lattice);
    EXPECT_GT(found.n_found, 0u) << family.name;
    EXPECT_LT(found.largest, 1e-12) << family.name;
  }
}

/// Patches and bytes for 1e-3, 1e-5, 1e-7 and 1e-9.
std::array<std::vector<double>, 2> sizes_of(const SubdivisionLattice& lattice,
                                            double gradient_factor) {
  std::array<std::vector<double>, 2> sizes;
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const Volume volume = freeze_adaptive(
        lattice,
        {.tolerance = tolerance, .gradient_tolerance = std::min(1.0, gradient_factor * tolerance)});
    sizes[0].push_back(static_cast<double>(volume.n_patches()));
    sizes[1].push_back(static_cast<double>(volume.bytes()));
  }
  return sizes;
}

TEST(FreezeAdaptive, grows_linearly_with_the_digits_of_places_on_lines) {
  for (const auto& sizes : sizes_of(test::prism(test::flower_section(5), 1), 1e9)) {
    const double step = (sizes[3] - sizes[0]) / 3;
    EXPECT_GT(step, 0);
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_NEAR(sizes[i] - sizes[i - 1], step, 0.35 * step);
    }
  }
}

TEST(FreezeAdaptive, grows_linearly_with_the_digits_of_derivatives_until_round_off_ends_it) {
  for (const auto& sizes : sizes_of(test::prism(test::flower_section(5), 1), 100)) {
    const double step = sizes[1] - sizes[0];
    EXPECT_GT(step, 0);
    EXPECT_NEAR(sizes[2] - sizes[1], step, 0.35 * step);
    EXPECT_GT(sizes[3] - sizes[2], 0);
    EXPECT_LT(sizes[3] - sizes[2], step);
  }
}

/// Where the inner vertices of a lattice that are not regular converge to.
std::map<VertexId, glm::dvec3> irregular_limits(const SubdivisionLattice& lattice) {
  const Hexahedra hexahedra(*lattice.complex);
  const Sharpness sharpness = with_touching_elements(*lattice.complex, lattice.sharpness);
  const CellClassifier classifier(hexahedra, sharpness, lattice.scheme);
  std::map<VertexId, glm::dvec3> limits;
  for (const VertexId vertex : lattice.complex->vertices()) {
    if (lattice.complex->is_boundary(vertex) || classifier.is_regular(vertex)) {
      continue;
    }
    const auto limit = limit_position(hexahedra, sharpness, lattice.scheme, vertex);
    EXPECT_TRUE(limit.has_value());
    glm::dvec3& sum = limits[vertex];
    for (const auto& [source, weight] : *limit) {
      sum += weight * lattice.rest[source.index()];
    }
  }
  return limits;
}

TEST(LimitPosition, is_the_same_at_all_levels_at_nodes_and_other_cells) {
  for (SubdivisionLattice lattice :
       {test::six_tetrahedra(), test::pyramid_on_cube(),
        test::prism(test::flower_section(5), 2, Scheme::MacCrackenJoy)}) {
    lattice.rest = test::jittered(std::move(lattice.rest), 0.1, 4);
    const SubdivisionLattice coarse = refined(lattice, 1);
    const SubdivisionLattice fine = refined(coarse, 1);
    const SubdivisionLattice finest = refined(fine, 1);
    const auto from_coarse = irregular_limits(coarse);
    const auto from_fine = irregular_limits(fine);
    EXPECT_FALSE(from_coarse.empty());
    for (const auto& [vertex, limit] : from_coarse) {  // vertex points keep their numbers
      EXPECT_LT(glm::distance(limit, from_fine.at(vertex)), 1e-14);
      EXPECT_LT(glm::distance(limit, finest.rest[vertex.index()]), 0.02);
    }
  }
}

TEST(LimitPosition, of_a_cell_point_is_that_of_the_refined_vertex) {
  const SubdivisionLattice lattice = refined(test::pyramid_on_cube(), 1);
  const SubdivisionLattice fine = refined(lattice, 1);
  const Sharpness sharpness = with_touching_elements(*lattice.complex, lattice.sharpness);
  const auto limits = irregular_limits(fine);
  const auto first_cell_point = static_cast<std::int32_t>(
      lattice.complex->n_vertices() + lattice.complex->n_edges() + lattice.complex->n_faces());
  std::size_t n_compared = 0;
  for (const CellId cell : lattice.complex->cells()) {
    const auto found = limits.find(VertexId{first_cell_point + cell.value});
    if (found == limits.end()) {
      continue;
    }
    ++n_compared;
    glm::dvec3 sum(0);
    const auto limit =
        limits_of_cell_points(*lattice.complex, sharpness, lattice.scheme, std::array{cell});
    for (const auto& [source, weight] : limit.front()) {
      sum += weight * lattice.rest[source.index()];
    }
    EXPECT_LT(glm::distance(sum, found->second), 1e-14);
  }
  EXPECT_GT(n_compared, 0u);
}

TEST(FreezeAdaptive, reproduces_affine_maps_and_rests_at_rest) {
  for (const test::NamedLattice& family : test::lattice_families()) {
    const Volume volume = freeze_adaptive(family.lattice, {.tolerance = 1e-2});
    std::vector<glm::dvec3> moved = family.lattice.rest;
    for (glm::dvec3& point : moved) {
      point = point * 2.0 + glm::dvec3(1, 2, 3);
    }
    const auto points = volume.points(moved);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LT(glm::distance(points[i], volume.rest_points()[i] * 2.0 + glm::dvec3(1, 2, 3)),
                1e-13)
          << family.name;
    }
    for (const glm::dvec3& move : volume.displacements(family.lattice.rest)) {
      EXPECT_EQ(move, glm::dvec3(0));
    }
  }
}

TEST(CellClassifier, tells_regular_line_and_other_cells_apart) {
  using Kind = CellClass::Kind;
  const auto count = [](const SubdivisionLattice& lattice) {
    const Hexahedra hexahedra(*lattice.complex);
    const CellClassifier classifier(hexahedra, lattice.sharpness, lattice.scheme);
    std::map<Kind, int> kinds;
    for (const CellId cell : lattice.complex->cells()) {
      ++kinds[classifier.classify(cell).kind];
    }
    return kinds;
  };
  using Counts = std::map<Kind, int>;
  EXPECT_EQ(count(test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1}))),
            (Counts{{Kind::Regular, 8}}));
  EXPECT_EQ(count(test::prism(test::flower_section(5), 2)), (Counts{{Kind::Line, 30}}));
  EXPECT_EQ(count(test::prism(test::flower_section(5), 2, Scheme::MacCrackenJoy)),
            (Counts{{Kind::Other, 30}}));
  EXPECT_EQ(count(test::prism(test::wheel_section(5), 2)), (Counts{{Kind::Other, 10}}));
  EXPECT_EQ(count(test::plus_of_cubes())[Kind::Other], 7);
  // Eight hexahedra and six edges, but with 3, 3, 4, 4, 5 and 5 faces: no regular vertex.
  SubdivisionLattice creased = test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1}));
  creased.sharpness.edges[creased.complex->find_edge(VertexId{4}, VertexId{1})] = 0.5f;
  EXPECT_EQ(count(creased)[Kind::Other], 4);
}

TEST(FreezeAdaptive, ends_where_the_weights_would_be_too_many_and_says_how_exact_it_is) {
  const SubdivisionLattice lattice = test::pyramid_on_cube();
  const Volume asked = freeze_adaptive(lattice, {.tolerance = 1e-3});
  EXPECT_EQ(asked.freeze_error(), 0);
  const Volume reached = freeze_adaptive(lattice, {.tolerance = 1e-3, .most_weights = 2000});
  EXPECT_LT(reached.n_patches(), asked.n_patches());
  EXPECT_LT(reached.stencils().n_weights(), 20000u);
  EXPECT_GT(reached.freeze_error(), 2e-3);
  EXPECT_LT(reached.freeze_error(), 0.3);
}

TEST(FreezeAdaptive, refuses_options_out_of_range) {
  const SubdivisionLattice box = test::lattice_from(make_box({1, 1, 1}, {0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW((void)freeze_adaptive(box, {.tolerance = 0}), ParameterError);
  EXPECT_THROW((void)freeze_adaptive(box, {.tolerance = NAN}), ParameterError);
  EXPECT_THROW((void)freeze_adaptive(box, {.most_levels = 9}), ParameterError);
}

}  // namespace
}  // namespace espalier
