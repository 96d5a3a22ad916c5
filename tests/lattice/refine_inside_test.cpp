/// Inside, refined lattices are products of known curves and surfaces.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "lattice/build/primitives.h"
#include "lattice/subdivision/refine.h"
#include "tests/support/families.h"
#include "tests/support/far_oracle.h"
#include "tests/support/refined_points.h"

namespace espalier {
namespace {

/// One refinement of a uniform cubic B-spline with natural ends: the phantom point 2 P0 − P1 before
/// the first keeps the first where it is.
template <class Point>
std::vector<Point> refine_cubic(const std::vector<Point>& p, const auto& combine) {
  std::vector<Point> refined;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i > 0) {
      refined.push_back(combine(p[i - 1], 0.5, p[i], 0.5, p[i], 0.0));
    }
    const bool is_end = i == 0 || i + 1 == p.size();
    refined.push_back(is_end ? p[i] : combine(p[i - 1], 0.125, p[i], 0.75, p[i + 1], 0.125));
  }
  return refined;
}

/// Points and vertices of a section at every step along a line.
struct Stack {
  std::vector<std::vector<glm::dvec3>> points;
  std::vector<std::vector<VertexId>> vertices;
};

std::vector<glm::dvec3> combine_rows(const std::vector<glm::dvec3>& a, double wa,
                                     const std::vector<glm::dvec3>& b, double wb,
                                     const std::vector<glm::dvec3>& c, double wc) {
  std::vector<glm::dvec3> sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum[i] = wa * a[i] + wb * b[i] + wc * c[i];
  }
  return sum;
}

/// The vertices of the refined stack: those of the section's elements at every old step, and those
/// of the prisms between two steps.
std::vector<std::vector<VertexId>> refine_vertices(const std::vector<std::vector<VertexId>>& coarse,
                                                   const CellComplex& complex,
                                                   const ParentMap& parents,
                                                   const test::FarOracle& oracle, int level,
                                                   std::size_t n_refined) {
  std::vector<std::vector<VertexId>> refined(2 * coarse.size() - 1,
                                             std::vector<VertexId>(n_refined));
  for (const test::FarOracle::Element& element : oracle.elements(level)) {
    for (std::size_t step = 0; step < refined.size(); ++step) {
      std::set<VertexId> corners;
      for (const int vertex : element.vertices) {
        corners.insert(coarse[step / 2][static_cast<std::size_t>(vertex)]);
        corners.insert(coarse[(step + 1) / 2][static_cast<std::size_t>(vertex)]);
      }
      const auto found = test::refined_point(complex, parents, {corners.begin(), corners.end()});
      EXPECT_TRUE(found.has_value());
      refined[step][static_cast<std::size_t>(element.refined_vertex)] = *found;
    }
  }
  return refined;
}

/// The largest distance, over three levels, between a prism over a section with arbitrary control
/// points and the product of OpenSubdiv's refinement across and the cubic's along.
double distance_to_product(const test::Section& section, Scheme scheme) {
  const int n_steps = 4;
  SubdivisionLattice lattice = test::prism(section, n_steps - 1, scheme);
  lattice.rest = test::jittered(std::move(lattice.rest), 0.3, 11);
  const std::size_t n = section.points.size();
  Stack stack;
  for (std::size_t step = 0; step < n_steps; ++step) {
    stack.points.emplace_back(lattice.rest.begin() + static_cast<std::ptrdiff_t>(step * n),
                              lattice.rest.begin() + static_cast<std::ptrdiff_t>((step + 1) * n));
    stack.vertices.emplace_back();
    for (std::size_t i = 0; i < n; ++i) {
      stack.vertices.back().push_back({static_cast<std::int32_t>(step * n + i)});
    }
  }
  const test::FarOracle oracle(static_cast<int>(n), section.faces, {}, 3, true);
  double largest = 0;
  const CellComplex* coarse = lattice.complex.get();
  std::vector<glm::dvec3> points = lattice.rest;
  const std::vector<Refinement> levels = refine(lattice, 3);
  for (int level = 0; level < 3; ++level) {
    const Refinement& refinement = levels[static_cast<std::size_t>(level)];
    for (std::vector<glm::dvec3>& row : stack.points) {
      row = oracle.interpolate(level + 1, row);
    }
    stack.points = refine_cubic(stack.points, combine_rows);
    stack.vertices = refine_vertices(stack.vertices, *coarse, refinement.parents, oracle, level,
                                     stack.points[0].size());
    points = refinement.stencils.apply(points);
    for (std::size_t step = 0; step < stack.points.size(); ++step) {
      for (std::size_t i = 0; i < stack.points[step].size(); ++i) {
        largest = std::max(
            largest, glm::distance(points[stack.vertices[step][i].index()], stack.points[step][i]));
      }
    }
    coarse = refinement.complex.get();
  }
  return largest;
}

TEST(RefineInside, of_a_grid_is_the_tensor_cubic_with_natural_ends) {
  for (const auto& [nx, ny] : {std::pair{1, 1}, std::pair{1, 3}, std::pair{3, 2}}) {
    for (const Scheme scheme : {Scheme::CatmullClark, Scheme::MacCrackenJoy}) {
      EXPECT_LT(distance_to_product(test::grid_section(nx, ny), scheme), 1e-13);
    }
  }
}

/// The tensor product along all three axes, without OpenSubdiv.
TEST(RefineInside, of_a_grid_refines_each_axis_as_a_natural_cubic) {
  SubdivisionLattice lattice = test::lattice_from(make_box({3, 1, 2}, {0, 0, 0}, {3, 1, 2}));
  lattice.rest = test::jittered(std::move(lattice.rest), 0.3, 5);
  const auto combine = [](const glm::dvec3& a, double wa, const glm::dvec3& b, double wb,
                          const glm::dvec3& c, double wc) { return wa * a + wb * b + wc * c; };
  // Axis by axis: lines of points along x, then y, then z.
  std::array<std::size_t, 3> n = {4, 2, 3};
  std::vector<glm::dvec3> points = lattice.rest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<std::size_t, 3> refined_n = n;
    refined_n[axis] = 2 * n[axis] - 1;
    std::vector<glm::dvec3> refined(refined_n[0] * refined_n[1] * refined_n[2]);
    for (std::size_t a = 0; a < n[(axis + 1) % 3]; ++a) {
      for (std::size_t b = 0; b < n[(axis + 2) % 3]; ++b) {
        const auto index = [&](std::size_t i, const std::array<std::size_t, 3>& size) {
          std::array<std::size_t, 3> at{};
          at[axis] = i;
          at[(axis + 1) % 3] = a;
          at[(axis + 2) % 3] = b;
          return at[0] + size[0] * (at[1] + size[1] * at[2]);
        };
        std::vector<glm::dvec3> line;
        for (std::size_t i = 0; i < n[axis]; ++i) {
          line.push_back(points[index(i, n)]);
        }
        line = refine_cubic(line, combine);
        for (std::size_t i = 0; i < line.size(); ++i) {
          refined[index(i, refined_n)] = line[i];
        }
      }
    }
    points = std::move(refined);
    n = refined_n;
  }
  const Refinement level = refine(*lattice.complex, lattice.sharpness, lattice.scheme);
  const std::vector<glm::dvec3> ours = level.stencils.apply(lattice.rest);
  for (std::size_t k = 0; k < n[2]; ++k) {
    for (std::size_t j = 0; j < n[1]; ++j) {
      for (std::size_t i = 0; i < n[0]; ++i) {
        std::set<VertexId> corners;
        for (std::size_t c = 0; c < 8; ++c) {
          corners.insert({static_cast<std::int32_t>(
              (i + c % 2) / 2 + 4 * ((j + c / 2 % 2) / 2 + 2 * ((k + c / 4) / 2)))});
        }
        const auto found =
            test::refined_point(*lattice.complex, level.parents, {corners.begin(), corners.end()});
        ASSERT_TRUE(found.has_value());
        EXPECT_LT(glm::distance(ours[found->index()], points[i + n[0] * (j + n[1] * k)]), 1e-14);
      }
    }
  }
}

TEST(RefineInside, of_an_extruded_lattice_is_catmull_clark_across_times_cubic_along) {
  for (const test::Section& section : test::irregular_sections()) {
    EXPECT_LT(distance_to_product(section, Scheme::CatmullClark), 1e-13) << section.name;
  }
}

TEST(RefineInside, of_an_extraordinary_line_is_no_product_under_the_paper_s_rules) {
  for (const int n : {3, 5, 6}) {
    EXPECT_GT(distance_to_product(test::flower_section(n), Scheme::MacCrackenJoy), 1e-3);
    EXPECT_GT(distance_to_product(test::wheel_section(n), Scheme::MacCrackenJoy), 1e-3);
  }
}

}  // namespace
}  // namespace espalier
